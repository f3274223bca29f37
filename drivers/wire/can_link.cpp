// Source: Linux, Documentation/networking/can.rst (raw sockets, filters, error frames, time
// stamps), <linux/can/error.h>; socket(7) for SO_TIMESTAMPNS and SO_RXQ_OVFL. Kernel 6.1.
#include "drivers/wire/can_link.hpp"

#include "drivers/wire/can_interface.hpp"
#include "drivers/wire/deadline_watch.hpp"

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/use_awaitable.hpp>

#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>
#include <utility>

namespace axiscal {
namespace {

/// At most so many frames a turn of the loop, so that a busy bus takes its turn like others.
constexpr std::size_t batch = 64;
/// The kernel clamps it to net.core.rmem_max; half a second of a 1 kHz stream even then.
constexpr int receive_buffer = 1 << 20;
/// Older than this a stamp was made before the computer's wall clock was set. A computer that stood
/// still finds frames that waited for seconds, with right stamps.
constexpr Duration oldest_stamp = std::chrono::minutes{1};
/// The controller's queue is full while the bus is stuck; then it is asked again.
constexpr Duration queue_pause = std::chrono::milliseconds{10};

/// What the kernel says beside one frame.
struct Beside {
    std::optional<std::int64_t> utc_ns; ///< of arrival
    std::optional<std::uint32_t> dropped;
};

Beside read_beside(msghdr& message) {
    Beside beside;
    for (cmsghdr* one = CMSG_FIRSTHDR(&message); one != nullptr; one = CMSG_NXTHDR(&message, one)) {
        if (one->cmsg_level != SOL_SOCKET) continue;
        if (one->cmsg_type == SCM_TIMESTAMPNS) {
            timespec stamp{};
            std::memcpy(&stamp, CMSG_DATA(one), sizeof stamp);
            beside.utc_ns = std::int64_t{stamp.tv_sec} * 1'000'000'000 + stamp.tv_nsec;
        }
        if (one->cmsg_type == SO_RXQ_OVFL) {
            std::uint32_t dropped = 0;
            std::memcpy(&dropped, CMSG_DATA(one), sizeof dropped);
            beside.dropped = dropped;
        }
    }
    return beside;
}

CanFrame frame_of(const can_frame& raw) {
    CanFrame frame;
    frame.extended = (raw.can_id & CAN_EFF_FLAG) != 0;
    frame.remote = (raw.can_id & CAN_RTR_FLAG) != 0;
    frame.id = raw.can_id & (frame.extended ? CAN_EFF_MASK : CAN_SFF_MASK);
    frame.length = std::min<std::size_t>(raw.can_dlc, frame.data.size());
    std::memcpy(frame.data.data(), raw.data, frame.length);
    return frame;
}

can_frame raw_of(const CanFrame& frame) {
    can_frame raw{};
    raw.can_id =
        frame.id | (frame.extended ? CAN_EFF_FLAG : 0U) | (frame.remote ? CAN_RTR_FLAG : 0U);
    raw.can_dlc = static_cast<std::uint8_t>(frame.bytes().size());
    std::memcpy(raw.data, frame.data.data(), raw.can_dlc);
    return raw;
}

class SocketCanLink final : public CanLink {
public:
    SocketCanLink(Scheduler& scheduler, int descriptor, std::string interface)
        : scheduler_{scheduler}
        , interface_{std::move(interface)}
        , descriptor_{scheduler.executor(), descriptor}
        , reading_{scheduler, [this] { descriptor_.cancel(); }} {
        lay_out_buffers();
    }
    Result<void> hear(const std::vector<std::uint32_t>& ids) override;
    Task<Result<std::vector<TimedCanFrame>>> read_some(MonotonicTime deadline) override;
    Task<Result<void>> send(CanFrame frame, MonotonicTime deadline) override;
    [[nodiscard]] std::uint64_t bus_errors() const override { return bus_errors_; }

private:
    void lay_out_buffers();
    Task<boost::system::error_code> readable();
    Result<std::vector<TimedCanFrame>> drain();
    void take_error_frame(const can_frame& raw);
    [[nodiscard]] MonotonicTime
    time_of(const Beside& beside, MonotonicTime read_at, const ClockTie& tie) const;
    [[nodiscard]] Error closed(int error_number) const;

    Scheduler& scheduler_;
    std::string interface_;
    boost::asio::posix::stream_descriptor descriptor_;
    DeadlineWatch reading_;
    std::array<can_frame, batch> frames_{};
    std::array<iovec, batch> places_{};
    std::array<std::array<char, 128>, batch> beside_{}; ///< room for both control messages
    std::array<mmsghdr, batch> messages_{};
    std::uint64_t dropped_ = 0, bus_errors_ = 0;
    std::uint32_t dropped_word_ = 0; ///< as the kernel counts, in 32 bits
    std::optional<Error> then_;      ///< told after the frames that came before it
};

void SocketCanLink::lay_out_buffers() {
    for (std::size_t i = 0; i < batch; ++i) {
        places_[i] = {&frames_[i], sizeof frames_[i]};
        messages_[i].msg_hdr.msg_iov = &places_[i];
        messages_[i].msg_hdr.msg_iovlen = 1;
        messages_[i].msg_hdr.msg_control = beside_[i].data();
    }
}

Result<void> SocketCanLink::hear(const std::vector<std::uint32_t>& ids) {
    std::vector<can_filter> filters;
    filters.reserve(ids.size());
    for (const std::uint32_t id : ids)
        filters.push_back({id, CAN_SFF_MASK | CAN_EFF_FLAG | CAN_RTR_FLAG});
    const auto size = static_cast<socklen_t>(filters.size() * sizeof(can_filter));
    const int done = ::setsockopt(descriptor_.native_handle(), SOL_CAN_RAW, CAN_RAW_FILTER,
                                  filters.data(), size);
    // The socketpair of a test has no filters.
    if (done != 0 && errno != EOPNOTSUPP && errno != ENOPROTOOPT)
        return tl::unexpected<Error>(closed(errno));
    return {};
}

Error SocketCanLink::closed(int error_number) const {
    const CanState state = can_state(interface_);
    if (state != CanState::up) return can_absence(interface_, state);
    return {Fault::link_closed,
            "the CAN interface " + interface_ + " fails",
            std::error_code{error_number, std::generic_category()},
            {}};
}

/// The kernel stamps by the wall clock, which is tied to the monotonic one at each reading.
MonotonicTime
SocketCanLink::time_of(const Beside& beside, MonotonicTime read_at, const ClockTie& tie) const {
    if (!beside.utc_ns) return read_at;
    const Duration age{tie.utc_ns - *beside.utc_ns};
    const bool believed = age >= Duration::zero() && age < oldest_stamp;
    return believed ? tie.before + tie.width() / 2 - age : read_at;
}

void SocketCanLink::take_error_frame(const can_frame& raw) {
    if ((raw.can_id & CAN_ERR_BUSOFF) != 0) then_ = can_absence(interface_, CanState::bus_off);
    if ((raw.can_id & CAN_ERR_RESTARTED) == 0) ++bus_errors_;
}

Result<std::vector<TimedCanFrame>> SocketCanLink::drain() {
    for (std::size_t i = 0; i < batch; ++i)
        messages_[i].msg_hdr.msg_controllen = beside_[i].size();
    const int handle = descriptor_.native_handle();
    const int count = ::recvmmsg(handle, messages_.data(), batch, MSG_DONTWAIT, nullptr);
    const int error_number = errno;
    if (count == 0) return tl::unexpected<Error>(closed(0));
    std::vector<TimedCanFrame> arrived;
    if (count < 0) {
        if (error_number == EAGAIN || error_number == EINTR) return arrived;
        return tl::unexpected<Error>(closed(error_number));
    }
    const ClockTie tie = scheduler_.clock_tie();
    const auto frames = static_cast<std::size_t>(count);
    arrived.reserve(frames);
    for (std::size_t i = 0; i < frames; ++i) {
        if (messages_[i].msg_len == 0) then_ = closed(0); // the other end of a socketpair is gone
        if (messages_[i].msg_len != sizeof(can_frame)) continue;
        const Beside beside = read_beside(messages_[i].msg_hdr);
        // The kernel's word counts up and begins again.
        if (beside.dropped)
            dropped_ += *beside.dropped - std::exchange(dropped_word_, *beside.dropped);
        if ((frames_[i].can_id & CAN_ERR_FLAG) != 0)
            take_error_frame(frames_[i]);
        else
            arrived.push_back({frame_of(frames_[i]), time_of(beside, tie.after, tie), dropped_});
    }
    return arrived;
}

Task<boost::system::error_code> SocketCanLink::readable() {
    const auto [error] =
        co_await descriptor_.async_wait(boost::asio::posix::descriptor_base::wait_read,
                                        boost::asio::as_tuple(boost::asio::use_awaitable));
    co_return error;
}

Task<Result<std::vector<TimedCanFrame>>> SocketCanLink::read_some(MonotonicTime deadline) {
    for (;;) {
        if (then_) co_return tl::unexpected<Error>(*std::exchange(then_, std::nullopt));
        reading_.begin(deadline);
        const auto error = co_await readable();
        const bool late = reading_.end();
        if (error && !late) co_return fail(Fault::link_closed, interface_, error);
        auto arrived = drain();
        if (!arrived || !arrived->empty()) co_return arrived;
        if (late && !then_) co_return fail(Fault::link_timeout, "nothing came on " + interface_);
    }
}

Task<Result<void>> SocketCanLink::send(CanFrame frame, MonotonicTime deadline) {
    const can_frame raw = raw_of(frame);
    for (;;) {
        const ssize_t sent =
            ::send(descriptor_.native_handle(), &raw, sizeof raw, MSG_NOSIGNAL | MSG_DONTWAIT);
        if (sent == sizeof raw) co_return Result<void>{};
        const int error_number = errno;
        const bool full = error_number == ENOBUFS || error_number == EAGAIN;
        if (!full && error_number != EINTR) co_return tl::unexpected<Error>(closed(error_number));
        if (scheduler_.now() >= deadline)
            co_return fail(Fault::link_timeout,
                           interface_ + " does not get rid of its frames: is anything else on the "
                                        "bus, with the same bit rate?");
        co_await scheduler_.sleep_for(queue_pause);
    }
}

void set_option(int handle, int level, int name, int value) {
    // Each of them only adds to what is known of a frame: without it the link works.
    ::setsockopt(handle, level, name, &value, sizeof value);
}

void set_options(int handle) {
    set_option(handle, SOL_SOCKET, SO_RCVBUF, receive_buffer);
    set_option(handle, SOL_SOCKET, SO_TIMESTAMPNS, 1);
    set_option(handle, SOL_SOCKET, SO_RXQ_OVFL, 1);
    set_option(handle, SOL_CAN_RAW, CAN_RAW_ERR_FILTER,
               static_cast<int>(CAN_ERR_BUSOFF | CAN_ERR_CRTL | CAN_ERR_RESTARTED));
}

/// @errors of open_socketcan; the caller closes the handle.
Result<void> bind_to(int handle, const std::string& interface) {
    const CanState state = can_state(interface);
    if (state != CanState::up) return tl::unexpected<Error>(can_absence(interface, state));
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = static_cast<int>(::if_nametoindex(interface.c_str()));
    // Index 0 would be every CAN interface there is.
    const auto* place = reinterpret_cast<const sockaddr*>(&address);
    if (address.can_ifindex == 0 || ::bind(handle, place, sizeof address) != 0)
        return tl::unexpected<Error>(can_absence(interface, CanState::missing));
    return {};
}

} // namespace

std::unique_ptr<CanLink>
can_link_over(Scheduler& scheduler, int descriptor, const std::string& interface) {
    ::fcntl(descriptor, F_SETFL, O_NONBLOCK);
    set_options(descriptor);
    return std::make_unique<SocketCanLink>(scheduler, descriptor, interface);
}

Result<std::unique_ptr<CanLink>> open_socketcan(Scheduler& scheduler,
                                                const std::string& interface) {
    const int handle = ::socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC | SOCK_NONBLOCK, CAN_RAW);
    if (handle < 0)
        return fail(Fault::link_closed,
                    "this computer has no CAN for " + interface + ": modprobe can_raw",
                    std::error_code{errno, std::generic_category()});
    auto link = can_link_over(scheduler, handle, interface);
    if (const auto heard = link->hear({}); !heard) return tl::unexpected<Error>(heard.error());
    if (const auto bound = bind_to(handle, interface); !bound)
        return tl::unexpected<Error>(bound.error());
    return link;
}

} // namespace axiscal
