#pragma once
// What a captured reading says of the axis: where it stands, how it came there, and what people are
// shown of it. One rule for each way of measuring an axis; whoever asks knows none of them. Pure.

#include "analysis/quantity/result.hpp"
#include "analysis/record/run_record.hpp"

#include <memory>
#include <string>

namespace axiscal {

class ReadingRule {
public:
    ReadingRule() = default;
    virtual ~ReadingRule() = default;
    ReadingRule(const ReadingRule&) = delete;
    ReadingRule& operator=(const ReadingRule&) = delete;

    /// Coordinate of the axis by this reading, when it ought to stand at `target`. `reading` in
    /// vacuum wavelengths, sign as counted; `scale_minus_1` as EnvironmentNow has it.
    /// @errors Fault::outside_window for a reading that no place near the target gives.
    [[nodiscard]] virtual Result<Length> position_of(const DatumRecord& datum,
                                                     Length reading,
                                                     double scale_minus_1,
                                                     Length target) const = 0;
    /// 1 where the reading rises with the coordinate, else -1.
    [[nodiscard]] virtual int sign() const = 0;
    /// The least change of the reading that a way of the axis gives.
    [[nodiscard]] virtual Length least_reading_of_way(Length way) const = 0;
    /// The way of the axis that a small change of the reading shows.
    [[nodiscard]] virtual Length way_of_reading(Length change) const = 0;
    /// A reading shows where the axis stands, wherever that is, so that the first targets tell a
    /// wrong sign, unit, scale or datum (first_targets.hpp). Else only near the target.
    [[nodiscard]] virtual bool sees_every_place() const = 0;
    /// What else may stand `beside` the target by so much, as the end of a sentence; or nothing.
    [[nodiscard]] virtual std::string hint(Length beside) const = 0;
    /// A reading shows where the axis stands, if only near the target. Else the claim of the CNC is
    /// the position, and people are shown no other.
    [[nodiscard]] virtual bool shows_place() const { return true; }
    /// What people are shown of a reading at `target`. @param position  that position_of() gave
    [[nodiscard]] virtual Length deviation_of(const DatumRecord& /*datum*/,
                                              Length /*reading*/,
                                              Length position,
                                              Length target) const {
        return position - target;
    }
};

/// A laser or a scale along a linear axis: live_position().
std::shared_ptr<const ReadingRule> along_the_axis(LaserSetup laser);

/// A rotary axis against an indexing table or a polygon: rotary_position().
/// @param sign  LaserSetup::sign
std::shared_ptr<const ReadingRule> against_artefact(RotarySetup setup, int sign);

/// The one of these two by which the positions of this run are read.
std::shared_ptr<const ReadingRule> positions_of(const RunRecord& header);

} // namespace axiscal
