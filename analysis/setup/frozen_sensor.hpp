#pragma once
// An air sensor that repeats its last reading: it answers, and its figures do not change although
// air does. Pure.

#include "analysis/drift/drift.hpp"
#include "analysis/record/run_record.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace axiscal {

/// One quantity of an instrument over time, in stored_unit_of(kind) and in seconds.
struct SensorTrack {
    ChannelKind kind = ChannelKind::temperature;
    DriftSeries readings;
    /// Its last digit is that of the instrument: no correction was added.
    bool as_sent = true;
};

struct FrozenSpan {
    double begin_s = 0, end_s = 0; ///< first and last reading without a change
};

/// The longest span of ten minutes or more, with ten readings at least, in which no quantity of one
/// instrument changed by a single digit. It is told where a temperature among them is resolved to
/// 0.02 K or a pressure to 5 Pa: in ten minutes the air of a shop changes by more than that. A
/// resolution is the smallest change that was seen, and before the first change the last digit of
/// what was sent; where neither is known nothing is told.
std::optional<FrozenSpan> find_frozen_span(std::span<const SensorTrack> instrument);

/// What a channel showed while the points were taken, in seconds from the first one. The run has a
/// point.
DriftSeries readings_within(const RunRecord& run, int channel);

/// The tracks of the air of each instrument of a run, in the order of its channels, from the first
/// point to the last.
struct AirInstrument {
    std::string name;
    std::vector<SensorTrack> tracks;
};
std::vector<AirInstrument> air_instruments_of(const RunRecord& run);

} // namespace axiscal
