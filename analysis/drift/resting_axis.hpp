#pragma once
// The coordinate of an axis that rests, or the reading of a ballbar, from what measures it. Pure.

#include "analysis/compensation/environment_history.hpp"
#include "analysis/record/run_attachments.hpp"
#include "analysis/record/run_record.hpp"

#include <optional>

namespace axiscal {

/// Carries the readings of one drift test to what a run would give: of a linear axis to 20 degC, of
/// a rotary one to an angle; those of a ballbar, which a circle takes as they are, stay so. The
/// record outlives it.
class RestingAxis {
public:
    RestingAxis(const RunRecord& run, const DriftSetup& setup);

    /// Change of the coordinate against some fixed place, one millimetre for one degree on a rotary
    /// axis; the first call fixes where the axis stands.
    /// @errors Fault::environment_stale without fresh air or material; what refractivity_of() and
    /// rest_deg() say.
    Result<Length> coordinate(const EnvironmentReading& reading);

private:
    Result<Length> by_laser(const EnvironmentReading& reading);
    Result<Length> by_scale(const EnvironmentReading& reading);
    Result<Length> by_table(const RotarySetup& rotary, const EnvironmentReading& reading);
    [[nodiscard]] Result<double> refractivity_at(MonotonicTime at) const;

    const RunRecord& run_;
    EnvironmentHistory environment_;
    Length place_, from_datum_, at_first_;
    bool of_bar_;
    double cosine_;
    std::optional<double> first_m_;
    double n0_minus_1_ = 0;
};

} // namespace axiscal
