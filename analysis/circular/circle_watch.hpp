#pragma once
// Looks on while a circle is driven, so that a station that was away knows before the next one
// whether this one was driven in its sight. Pure.

#include "analysis/record/circular_setup.hpp"

namespace axiscal {

/// One circle with feed-in and feed-out (StartMethod::feed_step).
class CircleWatch {
public:
    explicit CircleWatch(CircularSetup setup);
    /// The next reading, m. Readings out of the bar's range are left out: half of the feed-in, and
    /// some of the way on both sides of it, lies within.
    void see(double reading_m);
    /// A feed-in was seen, and a feed-out after it: begin and end of cut_circle().
    [[nodiscard]] bool whole() const { return stage_ == Stage::driven; }

private:
    enum class Stage : std::uint8_t { unknown, beside, within, driven };
    CircularSetup setup_;
    Stage stage_ = Stage::unknown;
};

} // namespace axiscal
