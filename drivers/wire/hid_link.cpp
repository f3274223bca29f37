#include "drivers/wire/hid_link.hpp"

#include "drivers/loop/asio_scheduler.hpp"
#include "drivers/wire/hid_place.hpp"

#include <hidapi/hidapi.h>

#include <algorithm>
#include <filesystem>

namespace axiscal {
namespace {

constexpr std::size_t longest_report = 64; ///< of full speed
/// A read looks this often whether it is still wanted.
constexpr Duration read_slice = std::chrono::milliseconds{100};

/// hidapi keeps the text of its last error for the whole process: enumerating and opening are not
/// made for two threads at once.
std::mutex& hidapi_lock() {
    static std::mutex lock;
    return lock;
}

/// The socket of a HID node. hidapi over hidraw: "/dev/hidraw3", whose folder in sysfs lies below
/// the device's, and where there is no USB is the port itself (list_hid); over libusb: "1-2.4:1.1".
std::string port_of(const std::string& path) {
    std::error_code error;
    const std::filesystem::path node{path};
    if (node.parent_path() != "/dev") return path.substr(0, path.find(':'));
    const auto folder = std::filesystem::canonical(
        "/sys/class/hidraw/" + node.filename().string() + "/device", error);
    // .../usb1/1-2/1-2.4/1-2.4:1.1/0003:413D:2107.0005
    if (!std::filesystem::exists(folder.parent_path() / "bInterfaceNumber", error))
        return folder.filename().string();
    const std::string interface = folder.parent_path().filename().string();
    return interface.substr(0, interface.find(':'));
}

class HidHandle {
public:
    static Result<std::shared_ptr<HidHandle>> open(const UsbPlace& place);
    HidHandle(hid_device* device, UsbPlace place, UsbEntry entry)
        : device_{device}
        , place_{std::move(place)}
        , entry_{std::move(entry)} {}
    ~HidHandle() { ::hid_close(device_); }
    HidHandle(const HidHandle&) = delete;
    HidHandle& operator=(const HidHandle&) = delete;

    Result<TimedBytes> read(const WorkThread& thread, MonotonicTime deadline);
    Result<void> write(const std::vector<std::byte>& report);

private:
    /// hidapi does not say why a call failed.
    [[nodiscard]] tl::unexpected<Error> failed() const {
        if (!is_hid_plugged(entry_)) return place_.absence();
        return fail(Fault::refused, entry_.describe() + " refuses its reports");
    }
    hid_device* device_;
    UsbPlace place_;
    UsbEntry entry_;
};

/// The path of the wanted interface of the device in this socket.
/// @param interface  -1: the last one that is served.
std::string hid_path(const UsbEntry& entry, int interface) {
    hid_device_info* const all = ::hid_enumerate(entry.vendor, entry.product);
    std::string path;
    int best = -2; // hidapi's number is -1 where there are no interfaces
    for (const hid_device_info* one = all; one; one = one->next) {
        if (port_of(one->path) != entry.port) continue;
        const bool right =
            interface < 0 ? one->interface_number > best : one->interface_number == interface;
        if (!right) continue;
        best = one->interface_number;
        path = one->path;
    }
    ::hid_free_enumeration(all);
    return path;
}

Result<std::shared_ptr<HidHandle>> HidHandle::open(const UsbPlace& place) {
    AXISCAL_TRY(const UsbEntry entry, choose_usb(place, list_hid()));
    const std::lock_guard lock{hidapi_lock()};
    if (::hid_init() != 0) return fail(Fault::io, "hidapi does not start");
    // Not the last that is served: before it stands a keyboard, which is not to be written to.
    const int interface = place.interface >= 0 ? place.interface : last_hid_interface(entry.port);
    const std::string path = hid_path(entry, interface);
    const std::string name = entry.describe();
    const std::string which = interface < 0 ? "" : " " + std::to_string(interface);
    if (path.empty())
        return fail(Fault::io, name + " has no HID interface" + which + " that the kernel serves");
    hid_device* const device = ::hid_open_path(path.c_str());
    if (!device)
        return fail(Fault::io,
                    "cannot open " + path + " of " + name +
                        "; are the udev rules installed, and this user in the group axiscal?");
    return std::make_shared<HidHandle>(device, place, entry);
}

Result<TimedBytes> HidHandle::read(const WorkThread& thread, MonotonicTime deadline) {
    std::vector<std::byte> report(longest_report);
    auto* const bytes = reinterpret_cast<unsigned char*>(report.data());
    do {
        const Duration left = std::clamp(deadline - monotonic_now(), Duration{}, read_slice);
        const auto span = std::chrono::ceil<std::chrono::milliseconds>(left);
        const int got =
            ::hid_read_timeout(device_, bytes, report.size(), static_cast<int>(span.count()));
        if (got < 0) return failed();
        if (got == 0) continue;
        report.resize(static_cast<std::size_t>(got));
        return TimedBytes{std::move(report), monotonic_now()};
    } while (monotonic_now() < deadline && !thread.wanted());
    return fail(Fault::link_timeout, device_hangs);
}

/// The kernel itself bounds this by five seconds (USB_CTRL_SET_TIMEOUT).
Result<void> HidHandle::write(const std::vector<std::byte>& report) {
    std::vector<unsigned char> bytes{0}; // number of the report: there is none
    for (const std::byte byte : report)
        bytes.push_back(std::to_integer<unsigned char>(byte));
    if (::hid_write(device_, bytes.data(), bytes.size()) < 0) return failed();
    return {};
}

class HidLink final : public ByteLink {
public:
    HidLink(Scheduler& scheduler,
            std::shared_ptr<WorkThread> thread,
            std::shared_ptr<HidHandle> handle)
        : scheduler_{scheduler}
        , thread_{std::move(thread)}
        , handle_{std::move(handle)} {}
    /// The handle is closed on its thread.
    ~HidLink() override {
        thread_->finish([handle = std::move(handle_)]() mutable { handle.reset(); });
    }
    HidLink(const HidLink&) = delete;
    HidLink& operator=(const HidLink&) = delete;

    Task<Result<TimedBytes>> read_some(MonotonicTime deadline) override {
        // The thread outlives its jobs; a job that held it would have it join itself.
        std::function<Result<TimedBytes>()> job = [thread = thread_.get(), handle = handle_,
                                                   deadline] {
            return handle->read(*thread, deadline);
        };
        return on_thread<TimedBytes>(thread_, scheduler_, std::move(job), deadline);
    }
    Task<Result<void>> write_all(std::vector<std::byte> bytes, MonotonicTime deadline) override {
        std::function<Result<void>()> job = [handle = handle_, bytes = std::move(bytes)] {
            return handle->write(bytes);
        };
        return on_thread<void>(thread_, scheduler_, std::move(job), deadline);
    }

private:
    Scheduler& scheduler_;
    std::shared_ptr<WorkThread> thread_;
    std::shared_ptr<HidHandle> handle_; ///< used on the thread only
};

} // namespace

Task<Result<std::unique_ptr<ByteLink>>>
open_hid(Scheduler& scheduler, WorkThreads& threads, UsbPlace place, MonotonicTime deadline) {
    auto thread = threads.start(place.describe());
    if (!thread) co_return tl::unexpected<Error>(thread.error());
    std::function<Result<std::shared_ptr<HidHandle>>()> job = [place = std::move(place)] {
        return HidHandle::open(place);
    };
    auto opened = co_await on_thread<std::shared_ptr<HidHandle>>(*thread, scheduler, std::move(job),
                                                                 deadline);
    if (!opened) {
        (*thread)->finish();
        co_return tl::unexpected<Error>(opened.error());
    }
    co_return std::make_unique<HidLink>(scheduler, *std::move(thread), *std::move(opened));
}

} // namespace axiscal
