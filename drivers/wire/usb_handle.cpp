#include "drivers/wire/usb_handle.hpp"

#include "drivers/loop/asio_scheduler.hpp"

#include <libusb-1.0/libusb.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <unistd.h>

namespace axiscal {
namespace {

/// libusb takes 0 for "for ever": a deadline that has passed still means one millisecond.
unsigned milliseconds_to(MonotonicTime deadline) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline - monotonic_now()).count();
    return static_cast<unsigned>(std::clamp<std::int64_t>(left, 1, 60'000));
}

Fault fault_of(int code) {
    switch (code) {
    case LIBUSB_ERROR_TIMEOUT: return Fault::link_timeout;
    case LIBUSB_ERROR_PIPE: return Fault::refused;
    case LIBUSB_ERROR_OVERFLOW: return Fault::bad_frame;
    case LIBUSB_ERROR_BUSY: return Fault::busy;
    default: return Fault::io;
    }
}

const char* sentence_of(int code) {
    switch (code) {
    case LIBUSB_ERROR_TIMEOUT: return "does not answer";
    case LIBUSB_ERROR_PIPE: return "refuses the transfer (STALL)";
    case LIBUSB_ERROR_OVERFLOW: return "sends more than was asked for";
    case LIBUSB_ERROR_BUSY: return "is in use by another program";
    default: return ::libusb_strerror(code);
    }
}

std::string node_of(const UsbEntry& entry) {
    char path[40];
    std::snprintf(path, sizeof path, "/dev/bus/usb/%03d/%03d", entry.bus, entry.address);
    return path;
}

unsigned char* raw(std::vector<std::byte>& bytes) {
    return reinterpret_cast<unsigned char*>(bytes.data());
}

TimedBytes arrived(std::vector<std::byte> bytes, int count) {
    bytes.resize(static_cast<std::size_t>(count));
    return {std::move(bytes), monotonic_now()};
}

} // namespace

Result<std::shared_ptr<UsbHandle>> UsbHandle::open(const UsbPlace& place) {
    AXISCAL_TRY(UsbEntry entry, choose_usb(place, list_usb()));
    auto handle = std::make_shared<UsbHandle>(place, std::move(entry));
    AXISCAL_CHECK(handle->open_node());
    return handle;
}

Result<void> UsbHandle::open_node() {
    const std::string path = node_of(entry_);
    node_ = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
    if (node_ < 0) {
        const std::error_code cause{errno, std::generic_category()};
        return fail(Fault::io,
                    "cannot open " + path + " of " + entry_.describe() +
                        "; are the udev rules installed, and this user in the group axiscal?",
                    cause);
    }
    ::libusb_set_option(nullptr, LIBUSB_OPTION_NO_DEVICE_DISCOVERY);
    int code = ::libusb_init(&context_);
    if (code == 0) code = ::libusb_wrap_sys_device(context_, node_, &handle_);
    if (code == 0) code = ::libusb_claim_interface(handle_, place_.interface);
    if (code != 0) return failed(code, 0);
    claimed_ = place_.interface;
    return {};
}

UsbHandle::~UsbHandle() {
    if (claimed_ >= 0) ::libusb_release_interface(handle_, claimed_);
    if (handle_) ::libusb_close(handle_);
    if (context_) ::libusb_exit(context_);
    if (node_ >= 0) ::close(node_);
}

/// What the driver uses and the device did not tell the kernel of; empty where it did. The kernel's
/// refusal of an endpoint is an I/O error of libusb's, as others are: only the descriptors tell.
std::string UsbHandle::missing_part(int code, int endpoint) const {
    if (handle_ == nullptr) return {};
    if (endpoint == 0)
        return code == LIBUSB_ERROR_NOT_FOUND ? "interface " + std::to_string(place_.interface)
                                              : std::string{};
    const auto address = static_cast<unsigned char>(endpoint);
    if (code != LIBUSB_ERROR_IO ||
        ::libusb_get_max_packet_size(::libusb_get_device(handle_), address) >= 0)
        return {};
    char text[20];
    std::snprintf(text, sizeof text, "endpoint 0x%02x", unsigned{address});
    return text;
}

/// A bulk endpoint that answered with STALL stays so until it is told to go on (USB 2.0, 9.4.5).
tl::unexpected<Error> UsbHandle::failed(int code, int endpoint) {
    if (code == LIBUSB_ERROR_PIPE && endpoint != 0)
        ::libusb_clear_halt(handle_, static_cast<unsigned char>(endpoint));
    const Fault fault = fault_of(code);
    const bool gone = code == LIBUSB_ERROR_NO_DEVICE || (fault == Fault::io && !is_plugged(entry_));
    if (gone) return place_.absence();
    const std::string missing = missing_part(code, endpoint);
    if (!missing.empty())
        return fail(fault, entry_.describe() + " shows no " + missing +
                               ": its descriptors are damaged, or it is another device");
    return fail(fault, entry_.describe() + " " + sentence_of(code));
}

Result<TimedBytes> UsbHandle::control_in(const UsbRequest& request, MonotonicTime deadline) {
    std::vector<std::byte> bytes(static_cast<std::size_t>(request.length));
    const int got = ::libusb_control_transfer(
        handle_, static_cast<std::uint8_t>(request.request_type),
        static_cast<std::uint8_t>(request.request), static_cast<std::uint16_t>(request.value),
        static_cast<std::uint16_t>(request.index), raw(bytes),
        static_cast<std::uint16_t>(request.length), milliseconds_to(deadline));
    if (got < 0) return failed(got, 0);
    return arrived(std::move(bytes), got);
}

Result<void>
UsbHandle::bulk_out(int endpoint, std::vector<std::byte> bytes, MonotonicTime deadline) {
    int sent = 0;
    const int code =
        ::libusb_bulk_transfer(handle_, static_cast<unsigned char>(endpoint), raw(bytes),
                               static_cast<int>(bytes.size()), &sent, milliseconds_to(deadline));
    if (code != 0) return failed(code, endpoint);
    return {};
}

Result<TimedBytes> UsbHandle::bulk_in(int endpoint, std::size_t longest, MonotonicTime deadline) {
    std::vector<std::byte> bytes(longest);
    int got = 0;
    const int code =
        ::libusb_bulk_transfer(handle_, static_cast<unsigned char>(endpoint), raw(bytes),
                               static_cast<int>(longest), &got, milliseconds_to(deadline));
    // What came before the deadline did come.
    if (code != 0 && !(code == LIBUSB_ERROR_TIMEOUT && got > 0)) return failed(code, endpoint);
    return arrived(std::move(bytes), got);
}

} // namespace axiscal
