#pragma once
// How often a channel sends, as it is seen. Pure but for its memory.

#include "drivers/sample.hpp"

#include <optional>

namespace axiscal {

/// Samples of the last one to two seconds over their time, rounded to three digits: a nominal rate,
/// not a calibration of the instrument's clock.
class SampleRate {
public:
    void take(const Sample& sample);
    [[nodiscard]] double hz() const; ///< 0 before the first second has passed

private:
    std::optional<MonotonicTime> began_;
    std::uint64_t n_ = 0; ///< since began_, without that one
    double last_hz_ = 0;
};

} // namespace axiscal
