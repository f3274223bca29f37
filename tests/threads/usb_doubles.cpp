#include "tests/threads/usb_doubles.hpp"

#include "drivers/loop/asio_scheduler.hpp"
#include "drivers/wire/usb_handle.hpp"

#include <hidapi/hidapi.h>

#include <algorithm>
#include <array>
#include <deque>
#include <string>
#include <string_view>
#include <thread>

namespace axiscal::testing {
namespace {

std::array<SeenByDevice, 3> all_seen;
int packets_left = 0, next_number = 0; // of the U6; its link's thread alone
int hidapi_calls = 0;                  // hidapi's own state of the process

UsbEntry device(int nth, std::uint16_t vendor, std::uint16_t product) {
    UsbEntry entry;
    entry.vendor = vendor;
    entry.product = product;
    entry.bus = 1;
    entry.address = nth;
    entry.port = "1-" + std::to_string(nth);
    return entry;
}

std::vector<std::byte> numbered_packet() {
    const int number = next_number++;
    return {static_cast<std::byte>(number & 0xFF), static_cast<std::byte>(number >> 8)};
}

} // namespace

SeenByDevice& seen_at(std::string_view port) {
    return all_seen.at(static_cast<std::size_t>(port.back() - '1'));
}

} // namespace axiscal::testing

namespace axiscal {

using testing::seen_at;

// --- in place of drivers/wire/usb_place.cpp ---

std::string UsbEntry::describe() const {
    return "the USB device at " + port;
}
std::string UsbPlace::describe() const {
    return "USB port " + port;
}
tl::unexpected<Error> UsbPlace::absence() const {
    return fail(Fault::link_closed, "no " + describe() + " is plugged in");
}
bool is_plugged(const UsbEntry& /*entry*/) {
    return true;
}
std::vector<UsbEntry> list_usb(const std::string& /*sysfs*/) {
    return {testing::device(1, 0x0CD5, 0x0006), testing::device(2, 0x413D, 0x2107),
            testing::device(3, 0x413D, 0x2107)};
}
Result<UsbEntry> choose_usb(const UsbPlace& place, const std::vector<UsbEntry>& plugged) {
    const auto found = std::ranges::find(plugged, place.port, &UsbEntry::port);
    if (found == plugged.end()) return place.absence();
    return *found;
}

// --- in place of drivers/wire/usb_handle.cpp ---

Result<std::shared_ptr<UsbHandle>> UsbHandle::open(const UsbPlace& place) {
    AXISCAL_TRY(UsbEntry entry, choose_usb(place, list_usb()));
    seen_at(entry.port).call();
    ++seen_at(entry.port).opened;
    return std::make_shared<UsbHandle>(place, std::move(entry));
}

UsbHandle::~UsbHandle() {
    seen_at(entry_.port).call();
    ++seen_at(entry_.port).closed;
}

Result<TimedBytes> UsbHandle::control_in(const UsbRequest& request, MonotonicTime /*deadline*/) {
    seen_at(entry_.port).call();
    testing::packets_left = testing::packets_of_a_stream;
    return TimedBytes{{static_cast<std::byte>(request.value)}, monotonic_now()};
}

Result<void> UsbHandle::bulk_out(int /*endpoint*/,
                                 std::vector<std::byte> /*bytes*/,
                                 MonotonicTime /*deadline*/) {
    seen_at(entry_.port).call();
    return {};
}

Result<TimedBytes>
UsbHandle::bulk_in(int /*endpoint*/, std::size_t /*longest*/, MonotonicTime deadline) {
    seen_at(entry_.port).call();
    if (testing::packets_left > 0) {
        --testing::packets_left;
        return TimedBytes{testing::numbered_packet(), monotonic_now()};
    }
    // A silent device holds its thread until the deadline: that is what it stands for.
    std::this_thread::sleep_for(deadline - monotonic_now());
    return fail(Fault::link_timeout, entry_.describe() + " does not answer");
}

} // namespace axiscal

// --- in place of hidapi: a stick answers each report with the same one ---

struct hid_device_ {
    std::string port;
    std::deque<unsigned char> answers;
};

extern "C" {

int hid_init() {
    ++axiscal::testing::hidapi_calls;
    return 0;
}

hid_device_info* hid_enumerate(unsigned short /*vendor*/, unsigned short /*product*/) {
    ++axiscal::testing::hidapi_calls;
    static char paths[2][8] = {"1-2:1.1", "1-3:1.1"};
    static hid_device_info list[2];
    list[0].path = paths[0];
    list[1].path = paths[1];
    list[0].interface_number = list[1].interface_number = 1;
    list[0].next = &list[1];
    list[1].next = nullptr;
    return list;
}

void hid_free_enumeration(hid_device_info* /*list*/) {
    ++axiscal::testing::hidapi_calls;
}

hid_device* hid_open_path(const char* path) {
    ++axiscal::testing::hidapi_calls;
    const std::string port = std::string{path}.substr(0, 3);
    axiscal::testing::seen_at(port).call();
    ++axiscal::testing::seen_at(port).opened;
    return new hid_device_{port, {}};
}

void hid_close(hid_device* device) {
    axiscal::testing::seen_at(device->port).call();
    ++axiscal::testing::seen_at(device->port).closed;
    delete device;
}

int hid_write(hid_device* device, const unsigned char* data, size_t length) {
    axiscal::testing::seen_at(device->port).call();
    device->answers.push_back(data[1]); // behind the number of the report
    return static_cast<int>(length);
}

int hid_read_timeout(hid_device* device, unsigned char* data, size_t /*length*/, int milliseconds) {
    axiscal::testing::seen_at(device->port).call();
    if (device->answers.empty()) {
        std::this_thread::sleep_for(std::chrono::milliseconds{milliseconds});
        return 0;
    }
    data[0] = device->answers.front();
    device->answers.pop_front();
    return 1;
}
}
