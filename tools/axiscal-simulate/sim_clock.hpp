#pragma once
#include <chrono>

namespace axiscal::simulate {

/// Seconds since the simulated world began; real time. Thread-safe.
class SimClock {
public:
    using Steady = std::chrono::steady_clock;
    [[nodiscard]] double now_s() const {
        return std::chrono::duration<double>(Steady::now() - start_).count();
    }
    [[nodiscard]] Steady::time_point at(double seconds) const {
        return start_ +
               std::chrono::duration_cast<Steady::duration>(std::chrono::duration<double>(seconds));
    }

private:
    Steady::time_point start_ = Steady::now();
};

} // namespace axiscal::simulate
