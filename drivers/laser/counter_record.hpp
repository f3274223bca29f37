#pragma once
// Records of the kernel's counter character device. Pure. Sections: see laser_counter.cpp.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace axiscal {

/// One record of <linux/counter.h>, struct counter_event. [event]
struct CounterRecord {
    std::int64_t at_ns = 0; ///< the kernel's monotonic clock when the event came
    std::uint64_t value = 0;
    std::uint8_t component_type = 0, scope = 0, parent = 0, component = 0, event = 0, channel = 0;
    std::uint8_t status = 0; ///< 0, or the errno with which the kernel could not read the value
};

inline constexpr std::size_t counter_record_bytes = 24;

/// Collects bytes as they come; a pipe may cut a record in two, the device itself never does.
class CounterFramer {
public:
    /// Whole records, in order.
    std::vector<CounterRecord> feed(std::span<const std::byte> bytes);

private:
    std::vector<std::byte> partial_;
};

/// Makes one long number of a register of `bits` bits that wraps both ways: the nearest of the
/// possible ways counts, so the axis must move less than half the register between two records.
class CountUnwrapper {
public:
    /// @param bits  8 to 64.
    explicit CountUnwrapper(int bits)
        : bits_{bits} {}
    /// The first value is taken with its sign, as a register below zero shows it.
    std::int64_t unwrap(std::uint64_t value);

private:
    [[nodiscard]] std::int64_t sign_extended(std::uint64_t value) const;
    int bits_;
    std::optional<std::int64_t> total_;
    std::uint64_t last_ = 0;
};

} // namespace axiscal
