#pragma once
// The beam watched while it is aligned, and kept for the tests that follow.

#include "acquisition/capture/beam_alignment.hpp"
#include "acquisition/live/station_interface.hpp"
#include "acquisition/measurement/cnc_answer.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/record/alignment_record.hpp"
#include "drivers/sample.hpp"

#include <optional>
#include <string>

namespace axiscal {

class LatestTests;

/// Loop-bound.
class BeamWatch {
public:
    /// @param tests  while one of them is open nobody steers the beam
    BeamWatch(const CncContext& context, const LatestTests& tests);

    /// Of what measures the axis.
    void take(const Sample& sample);
    [[nodiscard]] bool running() const { return beam_.running(); }
    [[nodiscard]] AlignmentView view() const;
    /// @errors why it is refused, with the way out.
    Result<void> carry_out(const AlignmentOrder& order);
    /// The last one kept, where it is of the laser that is there now. One that is still going on is
    /// kept first.
    std::optional<AlignmentRecord> for_run();

private:
    Result<void> begin();
    Result<void> keep(std::optional<double> spot_offset_mm);
    [[nodiscard]] AlignmentRecord so_far() const;
    [[nodiscard]] std::string serial() const;
    /// The latest strength that the laser told, if it is no more than 2 s old.
    [[nodiscard]] std::optional<Sample> strength_told() const;

    CncContext context_;
    const LatestTests& tests_;
    BeamAlignment beam_;
};

} // namespace axiscal
