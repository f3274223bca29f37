#include "analysis/drift/resting_axis.hpp"

#include "analysis/air/air_refraction.hpp"
#include "analysis/compensation/thermal_compensation.hpp"
#include "analysis/rotary/rotary_position.hpp"

#include <cmath>

namespace axiscal {

RestingAxis::RestingAxis(const RunRecord& run, const DriftSetup& setup)
    : run_{run}
    , environment_{run}
    , place_{setup.place}
    , from_datum_{(setup.place - run.plan.datum) * static_cast<double>(run.laser.sign)}
    , of_bar_{setup.of_bar}
    , cosine_{cosine_factor_of(run.laser)} {}

Result<Length> RestingAxis::coordinate(const EnvironmentReading& reading) {
    if (of_bar_) return metre(reading.value);
    if (run_.rotary) return by_table(*run_.rotary, reading);
    AXISCAL_TRY(const Temperature material, environment_.material_at(reading.at, "drift"));
    AXISCAL_TRY(const Length length, run_.scale ? by_scale(reading) : by_laser(reading));
    const Length at_20C =
        displacement_at_20C(length, run_.material.coefficient, material, run_.material.form);
    return at_20C * static_cast<double>(run_.laser.sign);
}

Result<double> RestingAxis::refractivity_at(MonotonicTime at) const {
    AXISCAL_TRY(const AirState air, environment_.air_at(at, "drift"));
    AXISCAL_TRY(const Refractivity index, refractivity_of(run_.air.formula, air));
    return index.n_minus_1;
}

Result<Length> RestingAxis::by_laser(const EnvironmentReading& reading) {
    AXISCAL_TRY(const double n_minus_1, refractivity_at(reading.at));
    if (!first_m_) first_m_ = reading.value, n0_minus_1_ = n_minus_1;
    const Length vacuum = from_datum_ * (1 + n0_minus_1_) + metre(reading.value - *first_m_);
    return displacement_in_air(vacuum, n_minus_1, n0_minus_1_, run_.laser.dead_path) * cosine_;
}

/// As if the scale had been zeroed at the datum: (D_0 / (1 + s_0) + V - V_0) (1 + s).
Result<Length> RestingAxis::by_scale(const EnvironmentReading& reading) {
    AXISCAL_TRY(const Temperature scale, environment_.scale_at(reading.at, "drift"));
    const Expansion alpha = run_.scale->coefficient;
    if (!first_m_) {
        first_m_ = reading.value;
        at_first_ = from_datum_ / displacement_by_scale(metre(1), alpha, scale).in(metre);
    }
    const Length counted = at_first_ + metre(reading.value - *first_m_);
    return displacement_by_scale(counted, alpha, scale);
}

/// As if the reflectors had been square to the beam with the table at its position 0, and the table
/// stood at the position nearest to the place of rest: what is left is the rest.
Result<Length> RestingAxis::by_table(const RotarySetup& rotary, const EnvironmentReading& reading) {
    AXISCAL_TRY(const double n_minus_1, refractivity_at(reading.at));
    if (!first_m_) {
        first_m_ = reading.value;
        const int position = artefact_index(rotary, run_.plan.datum, place_);
        const double at_first_deg = (place_ - run_.plan.datum).in(mm)-position * rotary.step_deg;
        at_first_ = rotary.arm * std::sin(degree(at_first_deg).in(radian)) * (1 + n_minus_1) *
                    static_cast<double>(run_.laser.sign);
    }
    const Length displacement = at_first_ + metre(reading.value - *first_m_);
    AXISCAL_TRY(const double rest, rest_deg(rotary, run_.laser.sign, displacement, n_minus_1));
    return mm(rest);
}

} // namespace axiscal
