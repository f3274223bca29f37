#include "straightness_optics.hpp"

#include <cmath>

namespace axiscal::simulate {
namespace {

constexpr std::uint64_t other_noise = 0x5354524149474854; // any number: another seed

} // namespace

double slope_through_square_um_per_m(const SquarenessScenario& squareness) {
    constexpr double um_per_m = 1e-6;
    const double error = squareness.square_um_per_m * um_per_m;
    return std::tan((squareness.square_turned ? -error : error) -
                    std::atan(squareness.first_um_per_m * um_per_m) -
                    squareness.axes_um_per_m * um_per_m) /
           um_per_m;
}

Scenario scenario_across(const Scenario& scenario) {
    Scenario across = scenario;
    across.errors = scenario.straightness.value_or(StraightnessScenario{}).across;
    if (scenario.squareness)
        across.errors.linear_um_per_m += slope_through_square_um_per_m(*scenario.squareness);
    across.thermal.expansion_um_per_m_k = 0;
    across.seed ^= other_noise;
    return across;
}

StraightnessOptics::StraightnessOptics(const Scenario& scenario)
    : optics_{scenario.straightness.value_or(StraightnessScenario{})}
    , across_{scenario_across(scenario)}
    , mirror_{optics_.mirror} {}

double StraightnessOptics::cycles(double drive_mm, double seconds, std::uint64_t sample) {
    const double deviation_mm = across_.slide_mm(drive_mm, seconds, sample) - drive_mm;
    const double form_mm = mirror_.pitch_um(drive_mm) * 1e-3;
    const double seen_mm = deviation_mm + (optics_.mirror_reversed ? -form_mm : form_mm);
    return across_.cycles_of_displacement(seen_mm / optics_.factor, seconds);
}

} // namespace axiscal::simulate
