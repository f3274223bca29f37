// When was record n taken? Steps of the input: how many records one read brought (1 to 32), how
// many are missing before them, and the time since the last read in two bytes of 10 us. The first
// byte chooses period and frame.

#include "drivers/clock/device_clock.hpp"
#include "tests/fuzz/judge.hpp"

#include <span>

using namespace axiscal;

namespace {

using std::chrono::microseconds, std::chrono::milliseconds;

void judge(const PlacedTime& placed, MonotonicTime read_at) {
    constexpr Duration rounding = microseconds{1};
    fuzz::require(placed.at <= read_at + rounding, "no record was taken after it arrived");
    fuzz::require(placed.uncertainty >= Duration{} && placed.uncertainty < std::chrono::hours{1},
                  "an uncertainty is one");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    constexpr Duration periods[] = {microseconds{20}, microseconds{500}, milliseconds{1},
                                    milliseconds{4}};
    DeviceClock clock{(data[0] & 4U) != 0 ? milliseconds{1} : milliseconds{0}};
    const Duration period = periods[data[0] & 3U];
    std::uint64_t number = 0;
    MonotonicTime read_at{std::chrono::hours{1}};
    for (std::span rest{data + 1, size - 1}; rest.size() >= 4; rest = rest.subspan(4)) {
        const int count = 1 + rest[0] % 32;
        number += rest[1];
        read_at += microseconds{10} * (256 * rest[2] + rest[3]);
        if (rest[0] >= 0xF0) clock.restart();
        for (int behind = count - 1; behind >= 0; --behind)
            judge(clock.place(++number, read_at, period, behind), read_at);
    }
    return 0;
}
