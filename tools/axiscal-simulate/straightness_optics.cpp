#include "straightness_optics.hpp"

namespace axiscal::simulate {
namespace {

constexpr std::uint64_t other_noise = 0x5354524149474854; // any number: another seed

} // namespace

Scenario scenario_across(const Scenario& scenario) {
    Scenario across = scenario;
    across.errors = scenario.straightness.value_or(StraightnessScenario{}).across;
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
