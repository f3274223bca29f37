#include "wire/can/can_bus.hpp"

#include "simulated_machine.hpp"
#include "wire/can/can_instruments.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <numbers>
#include <poll.h>
#include <pthread.h>
#include <sched.h>
#include <sstream>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>

namespace axiscal::simulate {

namespace {

constexpr double longest_look_s = 0.02;

Result<int> open_socket(const std::string& interface) {
    const int handle = ::socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC | SOCK_NONBLOCK, CAN_RAW);
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = static_cast<int>(::if_nametoindex(interface.c_str()));
    const auto* place = reinterpret_cast<const sockaddr*>(&address);
    const bool bound =
        handle >= 0 && address.can_ifindex != 0 && ::bind(handle, place, sizeof address) == 0;
    if (bound) return handle;
    const std::error_code cause{errno, std::generic_category()};
    if (handle >= 0) ::close(handle);
    return fail(Fault::io, "no CAN interface " + interface, cause);
}

/// A device does not wait for this computer: where it is allowed, its thread comes before all
/// others and its pages stay.
void be_prompt() {
    sched_param urgent{};
    urgent.sched_priority = ::sched_get_priority_min(SCHED_FIFO);
    ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &urgent);
    ::mlockall(MCL_CURRENT | MCL_FUTURE);
}

} // namespace

CanBus::~CanBus() {
    if (thread_.joinable()) {
        thread_.request_stop();
        thread_.join();
    }
    if (socket_ >= 0) ::close(socket_);
}

Result<CanBus::Device> CanBus::make_device(const UsbWish& wish, const UsbWorld& world) {
    AXISCAL_TRY(const double node, wish.number("node", wish.kind == "cantrans" ? "125" : "127"));
    if (!(node >= 1 && node <= 127)) return fail(Fault::bad_request, "node is 1 to 127");
    AXISCAL_TRY(const double mm, wish.number("mm", "0"));
    AXISCAL_TRY(const double swing_mm, wish.number("swing_mm", "0"));
    AXISCAL_TRY(const double period_s, wish.number("period_s", "10"));
    AXISCAL_TRY(const double offset_k, wish.number("offset_k", "0"));
    Device device{wish.text("called", wish.kind), wish.kind, nullptr,
                  std::make_shared<std::atomic<bool>>(false)};
    auto faulty = [flag = device.faulty](double) { return flag->load() ? 1 : 0; };
    const int number_of_node = static_cast<int>(node);
    if (wish.kind == "cantrans") {
        auto celsius = [thermal = world.scenario.thermal, offset_k](double seconds) {
            return material_at(thermal, seconds).in_celsius() + offset_k;
        };
        device.node = make_cantrans(number_of_node, {celsius, faulty});
        return device;
    }
    if (wish.kind != "temposonics")
        return fail(Fault::bad_request,
                    "\"" + wish.kind + "\" is no CAN device: cantrans, temposonics");
    TemposonicsWorld seen;
    seen.metres = [mm, swing_mm, period_s](double seconds) {
        return 1e-3 * (mm + swing_mm * std::sin(2 * std::numbers::pi * seconds / period_s));
    };
    seen.area = faulty;
    device.node = make_temposonics(number_of_node, seen);
    return device;
}

Result<std::unique_ptr<CanBus>> CanBus::open(const std::string& interface,
                                             const std::vector<std::string>& wishes,
                                             const UsbWorld& world) {
    auto bus = std::make_unique<CanBus>();
    bus->clock_ = world.clock;
    for (const std::string& text : wishes) {
        AXISCAL_TRY(const UsbWish wish, parse_usb_wish(text));
        AXISCAL_TRY(Device device, bus->make_device(wish, world));
        device.node->power_on(bus->clock_.now_s());
        bus->devices_.push_back(std::move(device));
    }
    AXISCAL_TRY(bus->socket_, open_socket(interface));
    bus->thread_ =
        std::jthread{[owner = bus.get()](const std::stop_token& stop) { owner->live(stop); }};
    return bus;
}

void CanBus::send(const std::vector<CanMessage>& frames) {
    for (const CanMessage& frame : frames) {
        can_frame raw{};
        raw.can_id = frame.id;
        raw.can_dlc = static_cast<std::uint8_t>(std::min<std::size_t>(8, frame.data.size()));
        std::copy_n(frame.data.begin(), raw.can_dlc, raw.data);
        // A bus that is down takes nothing; the devices go on.
        if (::write(socket_, &raw, sizeof raw) != sizeof raw) ++refused_;
    }
}

/// As they leave a device whose program is broken: a wire cannot do that, for each frame has a CRC.
std::vector<CanMessage> CanBus::spoilt(const Device& device, std::vector<CanMessage> frames) {
    for (CanMessage& frame : frames) {
        frame.data.resize(std::min(frame.data.size(), device.longest));
        for (std::uint8_t& byte : frame.data)
            byte ^= device.mask;
    }
    return frames;
}

/// What the bus brings until then.
void CanBus::look(double until_s) {
    const double wait_s = std::clamp(until_s - clock_.now_s(), 0.0, longest_look_s);
    pollfd watched{socket_, POLLIN, 0};
    const timespec patience{0, static_cast<long>(wait_s * 1e9)};
    if (::ppoll(&watched, 1, &patience, nullptr) <= 0) return;
    const std::lock_guard lock{mutex_};
    can_frame raw{};
    for (int i = 0; i < 256 && ::read(socket_, &raw, sizeof raw) == sizeof raw; ++i) {
        if ((raw.can_id & (CAN_EFF_FLAG | CAN_ERR_FLAG)) != 0) continue;
        const bool remote = (raw.can_id & CAN_RTR_FLAG) != 0;
        const int bytes = remote ? 0 : std::min<int>(8, raw.can_dlc);
        const CanMessage frame{raw.can_id & CAN_SFF_MASK, {raw.data, raw.data + bytes}, remote};
        for (Device& device : devices_)
            send(spoilt(device, device.node->take(frame, clock_.now_s())));
    }
}

/// Frames of strangers: other devices' PDOs, some with long identifiers, all with eight bytes.
void CanBus::flood(double now_s) {
    if (flood_hz_ <= 0) return;
    flooded_until_s_ = std::max(flooded_until_s_, now_s - 0.1);
    for (; flooded_until_s_ < now_s; flooded_until_s_ += 1 / flood_hz_) {
        const auto which = static_cast<std::uint32_t>(foreign_++ % 64);
        const std::uint32_t id =
            which % 4 == 3 ? CAN_EFF_FLAG | (0x18FEF500U + which) : 0x200 + which;
        send({{id, {1, 2, 3, 4, 5, 6, 7, 8}}});
    }
}

void CanBus::live(const std::stop_token& stop) {
    be_prompt();
    while (!stop.stop_requested()) {
        double due_s = clock_.now_s() + longest_look_s;
        {
            const std::lock_guard lock{mutex_};
            const double now_s = clock_.now_s();
            for (Device& device : devices_) {
                send(spoilt(device, device.node->advance(now_s)));
                due_s = std::min(due_s, device.node->next_due_s());
            }
            flood(now_s);
            if (flood_hz_ > 0) due_s = std::min(due_s, now_s + 1e-3);
        }
        look(due_s);
    }
}

/// What it measures becomes invalid: status bit 0 and an emergency (0x5030, as JUMO tells it).
void CanBus::fault(Device& device, bool begins) {
    *device.faulty = begins;
    const CanNode::Bytes cause{0, 1};
    device.node->tell_emergency(begins ? 0x5030 : 0, begins ? 1 : 0, cause);
}

Result<void> CanBus::spoil(Device& device, std::istream& arguments) {
    std::string how;
    int number = 0;
    arguments >> how >> number;
    const bool cuts = how == "cut" && number >= 0 && number < 8;
    const bool corrupts = how == "corrupt" && number >= 1 && number <= 255;
    if (!cuts && !corrupts && how != "none")
        return fail(Fault::bad_request,
                    "spoil needs cut 0 to 7, corrupt 1 to 255, or none, not \"" + how + "\"");
    device.longest = cuts ? static_cast<std::size_t>(number) : 8;
    device.mask = corrupts ? static_cast<std::uint8_t>(number) : std::uint8_t{0};
    return {};
}

Result<void> CanBus::obey(const std::string& word, std::istream& arguments) {
    std::string name;
    arguments >> name;
    const std::lock_guard lock{mutex_};
    if (word == "flood") {
        if (std::istringstream{name} >> flood_hz_) return {};
        return fail(Fault::bad_request, "flood needs frames a second, not \"" + name + "\"");
    }
    const auto found = std::find_if(devices_.begin(), devices_.end(),
                                    [&](const Device& device) { return device.called == name; });
    if (found == devices_.end())
        return fail(Fault::not_found, "no device is called \"" + name + "\"");
    if (word == "off") return found->node->power_off(), Result<void>{};
    if (word == "on" || word == "reset")
        return found->node->power_on(clock_.now_s()), Result<void>{};
    if (word == "spoil") return spoil(*found, arguments);
    if (word == "fault" || word == "mend") return fault(*found, word == "fault"), Result<void>{};
    return fail(Fault::bad_request, "\"" + word + "\" is no command");
}

nlohmann::json CanBus::status() {
    const std::lock_guard lock{mutex_};
    nlohmann::json devices = nlohmann::json::object();
    for (const Device& device : devices_)
        devices[device.called] = {{"node", device.node->number()},
                                  {"pdos", device.node->pdos_sent()},
                                  {"skipped", device.node->pdos_skipped()}};
    return {{"ready", true}, {"devices", devices}, {"foreign", foreign_}, {"refused", refused_}};
}

nlohmann::json CanBus::command(const std::string& line) {
    std::istringstream arguments{line};
    std::string word;
    arguments >> word;
    if (word == "status") return status();
    if (word == "quit") return ended_ = true, nlohmann::json{{"ok", true}};
    const auto done = obey(word, arguments);
    if (done) return {{"ok", true}};
    return {{"ok", false}, {"error", describe(done.error())}};
}

} // namespace axiscal::simulate
