#include "acquisition/capture/beam_alignment.hpp"

#include "acquisition/capture/wording.hpp"

#include <algorithm>
#include <utility>

namespace axiscal {

void BeamAlignment::begin(Length travel, Length spread_limit, const ClockTie& now) {
    watch_.emplace(travel, spread_limit);
    since_utc_ns_ = now.utc_ns;
    placed_at_ = now.after;
}

void BeamAlignment::take(const Sample& sample, const std::optional<Sample>& strength) {
    if (!watch_) return;
    if (!strength || strength->at <= placed_at_) return watch_->take(sample, std::nullopt);
    placed_at_ = strength->at;
    watch_->take(sample, strength->value());
}

AlignmentRecord BeamAlignment::so_far(const std::string& laser,
                                      const std::string& serial,
                                      std::int64_t utc_ns) const {
    AlignmentRecord record = watch_->record();
    record.began_utc_ns = since_utc_ns_;
    record.ended_utc_ns = utc_ns;
    record.instrument = laser;
    record.serial = serial;
    return record;
}

Result<void> BeamAlignment::keep(AlignmentRecord record, std::optional<double> spot_offset_mm) {
    if (record.readings == 0)
        return fail(Fault::beam_lost, "the laser gave no good reading since the alignment began");
    const Length needed = std::min(AlignmentWatch::least_distance, record.travel / 2);
    if (record.reached < needed)
        return fail(Fault::refused,
                    "the axis was seen over " + in_mm(record.reached) +
                        " only: a beam is judged along its way; move the axis over " +
                        in_mm(needed) + " or more and keep the alignment then");
    if (spot_offset_mm) record.spot_offset = mm(*spot_offset_mm);
    kept_ = std::move(record);
    watch_.reset();
    return {};
}

} // namespace axiscal
