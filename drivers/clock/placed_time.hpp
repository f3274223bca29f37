#pragma once
// When was a reading taken, and how well is that known? Pure.

#include "drivers/sample.hpp"

namespace axiscal {

/// An instant with its standard uncertainty u(t): the truth lies within +-2 u(t) of `at` for 95 %
/// of the records and more.
struct PlacedTime {
    MonotonicTime at{};
    Duration uncertainty{};
};

/// A reading that was asked for: taken after its request began to be sent and before its answer was
/// read, and nothing tells when. Rectangular: the middle, with u(t) = half of the time between /
/// sqrt(3). A host that stalls makes u(t) larger, never wrong. What the instrument averages or
/// keeps from before it was asked is its own lag and not in it.
/// @param answered  by the answer to this request; earlier than `asked` counts as `asked`. u(t) is
///                  1 ns at the least: 0 would be one that is not stated
PlacedTime placed_between(MonotonicTime asked, MonotonicTime answered);

/// A reading that was at most `oldest` old at `end`, and keeps that time: u(t) = oldest / sqrt(3)
/// is the root mean square of a rectangular age. For what sends by itself, whose age nobody tells.
PlacedTime placed_at_end(MonotonicTime end, Duration oldest);

/// Good with a value, absent without. Both have the time and its u(t).
Sample sample_at(int channel, const PlacedTime& placed, std::optional<double> value);

} // namespace axiscal
