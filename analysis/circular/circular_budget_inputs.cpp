#include "analysis/circular/circular_budget_inputs.hpp"

#include <utility>

namespace axiscal {
namespace {

/// Key of the station file.
std::string key_of(const std::string& term) {
    if (term == "device") return "circular.uncertainty.device_width";
    if (term == "calibration") return "ballbar.length_U";
    if (term == "environment") return "circular.uncertainty.eve";
    if (term == "centre") return "circular.uncertainty.centre_width";
    if (term == "repeatability") return "circular.uncertainty.repeatability";
    return "circular.uncertainty." + term + "_width"; // temperatures and expansions
}

BudgetInput input_of(const CircularContribution& term, const CircularCertificate& certificate) {
    const auto& stated = certificate.measured.stated;
    BudgetInput input;
    input.term = term.term;
    input.quantity = "standard uncertainty";
    input.unit = "um";
    input.value = term.u_mm * 1e3;
    input.origin = InputOrigin::typed;
    input.where = key_of(term.term);
    if (!term.source.empty()) {
        input.origin = InputOrigin::drift_test;
        input.where = term.source;
    } else if (term.term == "repeatability" && stated && !stated->repeatability_um) {
        input.origin = InputOrigin::readings;
        input.where = "the repeats of this test";
    }
    return input;
}

} // namespace

std::vector<BudgetInput> budget_inputs_of(const CircularCertificate& certificate) {
    std::vector<BudgetInput> inputs;
    if (!certificate.budget) return inputs;
    for (const CircularContribution& term : certificate.budget->contributions)
        inputs.push_back(input_of(term, certificate));
    for (const std::string& term : certificate.budget->not_stated) {
        BudgetInput missing;
        missing.term = term;
        missing.quantity = "standard uncertainty";
        missing.unit = "um";
        inputs.push_back(std::move(missing));
    }
    return inputs;
}

} // namespace axiscal
