// Source: Linux, Documentation/networking/can.rst and netdevice(7), rtnetlink(7),
// <linux/can/netlink.h>, kernel 6.1.
#include "drivers/wire/can_interface.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <linux/can/netlink.h>
#include <linux/rtnetlink.h>
#include <net/if.h>
#include <net/if_arp.h>
#include <optional>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

namespace axiscal {
namespace {

/// A descriptor for the length of a question.
class Asking {
public:
    Asking(int family, int kind, int protocol)
        : handle_{::socket(family, kind | SOCK_CLOEXEC, protocol)} {}
    ~Asking() {
        if (handle_ >= 0) ::close(handle_);
    }
    Asking(const Asking&) = delete;
    Asking& operator=(const Asking&) = delete;
    [[nodiscard]] int handle() const { return handle_; }

private:
    int handle_;
};

/// The attribute of this type in `length` bytes from `first`.
const rtattr* find_attribute(const rtattr* first, std::size_t length, int type) {
    auto rest = static_cast<int>(length);
    for (const rtattr* one = first; RTA_OK(one, rest); one = RTA_NEXT(one, rest))
        if ((one->rta_type & NLA_TYPE_MASK) == type) return one;
    return nullptr;
}

const rtattr* inside(const rtattr* outer, int type) {
    if (outer == nullptr) return nullptr;
    return find_attribute(static_cast<const rtattr*>(RTA_DATA(outer)), RTA_PAYLOAD(outer), type);
}

struct LinkQuestion {
    nlmsghdr header;
    ifinfomsg link;
};

/// enum can_state; empty where the driver tells none, or rtnetlink is closed to this process.
std::optional<std::uint32_t> controller_state(int index) {
    const Asking ask{AF_NETLINK, SOCK_RAW, NETLINK_ROUTE};
    LinkQuestion question{};
    question.header.nlmsg_len = sizeof question;
    question.header.nlmsg_type = RTM_GETLINK;
    question.header.nlmsg_flags = NLM_F_REQUEST;
    question.link.ifi_index = index;
    if (::send(ask.handle(), &question, sizeof question, 0) < 0) return std::nullopt;
    alignas(nlmsghdr) std::array<char, 16384> answer{};
    const ssize_t got = ::recv(ask.handle(), answer.data(), answer.size(), MSG_DONTWAIT);
    if (got < static_cast<ssize_t>(NLMSG_SPACE(sizeof(ifinfomsg)))) return std::nullopt;
    nlmsghdr header{};
    std::memcpy(&header, answer.data(), sizeof header);
    const std::size_t whole =
        std::min<std::size_t>(header.nlmsg_len, static_cast<std::size_t>(got));
    constexpr std::size_t begin = NLMSG_SPACE(sizeof(ifinfomsg));
    if (header.nlmsg_type != RTM_NEWLINK || whole < begin) return std::nullopt;
    const auto* first = reinterpret_cast<const rtattr*>(answer.data() + begin);
    const rtattr* state =
        inside(inside(find_attribute(first, whole - begin, IFLA_LINKINFO), IFLA_INFO_DATA),
               IFLA_CAN_STATE);
    std::uint32_t value = 0;
    if (state == nullptr || RTA_PAYLOAD(state) < sizeof value) return std::nullopt;
    std::memcpy(&value, RTA_DATA(state), sizeof value);
    return value;
}

} // namespace

CanState can_state(const std::string& interface) {
    const Asking ask{AF_UNIX, SOCK_DGRAM, 0};
    ifreq request{};
    if (interface.size() >= sizeof request.ifr_name) return CanState::missing;
    std::copy(interface.begin(), interface.end(), request.ifr_name);
    if (::ioctl(ask.handle(), SIOCGIFHWADDR, &request) != 0) return CanState::missing;
    if (request.ifr_hwaddr.sa_family != ARPHRD_CAN) return CanState::not_can;
    if (::ioctl(ask.handle(), SIOCGIFFLAGS, &request) != 0) return CanState::missing;
    const auto flags = static_cast<unsigned>(static_cast<unsigned short>(request.ifr_flags));
    if ((flags & IFF_UP) == 0) return CanState::down;
    if (::ioctl(ask.handle(), SIOCGIFINDEX, &request) != 0) return CanState::missing;
    // A controller that is off the bus has no carrier; some adapters tell it by their state only.
    const bool off = controller_state(request.ifr_ifindex) == CAN_STATE_BUS_OFF;
    return off || (flags & IFF_RUNNING) == 0 ? CanState::bus_off : CanState::up;
}

Error can_absence(const std::string& interface, CanState state) {
    switch (state) {
    case CanState::bus_off:
        return {Fault::link_closed,
                interface + " is bus-off: check cable, termination and bit rate; with restart-ms "
                            "set it comes back by itself, else set the link down and up",
                {},
                {}};
    case CanState::down:
        return {Fault::link_closed,
                interface + " is down: ip link set " + interface + " up type can bitrate ...",
                {},
                {}};
    case CanState::not_can:
        return {Fault::bad_configuration,
                interface + " is no CAN interface: ip -details link show type can",
                {},
                {}};
    case CanState::missing:
    case CanState::up: break;
    }
    return {Fault::link_closed,
            "there is no CAN interface " + interface +
                ": is the adapter plugged in? "
                "(ip -details link show type can)",
            {},
            {}};
}

} // namespace axiscal
