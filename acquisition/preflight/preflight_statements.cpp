// What is asked of a person: the coefficient of expansion, the state of the machine, the set-up.
#include "acquisition/preflight/preflight_checks.hpp"

#include "acquisition/capture/wording.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace axiscal::preflight_checks {
namespace {

/// F and D at 20 degC need the machine's coefficient; form alone does not.
PreflightRecord check_expansion_of_circles(const PreflightFacts& facts) {
    const CircularSetup& setup = facts.config.circular->setup;
    const double alpha_per_K = setup.machine_alpha_per_K.value_or(0);
    if (alpha_per_K <= 0)
        return warned("expansion", "The machine's coefficient of expansion is not stated: F and D "
                                   "stand as measured.");
    const std::string coefficient =
        plain_number(per_kelvin(alpha_per_K).in(um_per_m_kelvin), 2) + " um/(m*K)";
    if (setup.uncertainty.machine_alpha_width_per_K ||
        facts.config.axis.material.standard_uncertainty)
        return passed("expansion", "The coefficient " + coefficient + " has its uncertainty.");
    return failed("expansion", "The coefficient " + coefficient +
                                   " has no stated uncertainty. State "
                                   "circular.uncertainty.machine_expansion_width.");
}

} // namespace

PreflightRecord check_expansion(const PreflightFacts& facts) {
    if (facts.circular) return check_expansion_of_circles(facts);
    const auto& material = facts.config.axis.material;
    const bool width = facts.config.uncertainty && facts.config.uncertainty->expansion_width;
    const bool rotary = facts.config.cycle.axis_kind == AxisKind::rotary;
    const std::string coefficient =
        plain_number(material.coefficient.in(um_per_m_kelvin), 2) + " um/(m*K)";
    if (rotary) return passed("expansion", "A rotary axis has no length to expand.");
    if (material.coefficient.si() <= 0)
        return failed("expansion", "The coefficient of expansion is 0. Write the real one into "
                                   "axis.material.coefficient.");
    if (material.standard_uncertainty || width)
        return passed("expansion", "The coefficient " + coefficient + " has its uncertainty.");
    return failed("expansion", "The coefficient " + coefficient +
                                   " has no stated uncertainty. State "
                                   "axis.material.standard_uncertainty.");
}

PreflightRecord check_compensation(const PreflightFacts& facts) {
    constexpr std::array<std::string_view, 3> known{"as found", "raw", "as left"};
    const bool said = std::ranges::find(known, facts.state) != known.end();
    if (!said)
        return failed("compensation", "The state of the machine is " +
                                          (facts.state.empty() ? std::string{"not stated"}
                                                               : "\"" + facts.state + "\"") +
                                          ". Say \"as found\", \"raw\" or \"as left\" on the sheet "
                                          "that arms, or by axiscal arm "
                                          "--state-that state=\"as found\".");
    if (facts.control_compensation.empty())
        return failed("compensation",
                      "Which compensation of the control is active is not stated. Say it on the "
                      "sheet that arms, or by axiscal arm --state-that "
                      "control_compensation=\"none\".");
    return passed("compensation", "The machine is measured " + facts.state +
                                      "; compensation: " + facts.control_compensation + ".");
}

/// Asked for, for the eccentricity of the artefact over the axis shows in the readings; what is not
/// stated is printed as "not stated".
PreflightRecord check_run_out(const PreflightFacts& facts) {
    if (facts.run_out.empty())
        return warned("run_out", "The run-out of the set-up is not stated. Turn the axis under a "
                                 "dial gauge at the artefact's rim and say what it shows: axiscal "
                                 "arm --state-that run_out=\"8 um\".");
    return passed("run_out", "Run-out of the set-up: " + facts.run_out + ".");
}

bool states_no_dead_path(const PreflightFacts& facts) {
    const AxisConfig& axis = facts.config.axis;
    return !facts.circular && !axis.angle && !axis.scale && axis.dead_path <= Length{};
}

/// Optics that touch at the datum are rare, and a dead path that nobody measured is not.
PreflightRecord doubt_dead_path() {
    return warned("dead_path", "axis.dead_path is 0 mm, as if reflector and interferometer touched "
                               "at the datum. Measure the path between them there and write it "
                               "into axis.dead_path: what is missing moves with the air.");
}

} // namespace axiscal::preflight_checks
