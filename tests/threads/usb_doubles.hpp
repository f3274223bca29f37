#pragma once
// One U6 and two TEMPer sticks that are always plugged in and answer at once: what stands behind
// the threads of USB and HID links in place of sysfs, libusb and hidapi. Nothing here is locked:
// what the links promise about their threads is what keeps it whole.

#include <set>
#include <string_view>
#include <thread>

namespace axiscal::testing {

/// What one device saw. Touched by its link's thread alone; a test reads it once that has ended.
struct SeenByDevice {
    int opened = 0, closed = 0, calls = 0;
    std::set<std::thread::id> threads;
    void call() {
        ++calls;
        threads.insert(std::this_thread::get_id());
    }
};

/// By USB port: "1-1" the U6, "1-2" and "1-3" the sticks.
SeenByDevice& seen_at(std::string_view port);

/// The U6 gives so many packets, numbered in two bytes, each time a stream begins, then nothing.
inline constexpr int packets_of_a_stream = 300;

} // namespace axiscal::testing
