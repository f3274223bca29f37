#include "acquisition/documents/straightness/straightness_wording.hpp"

#include "acquisition/documents/pdf/wording.hpp"

namespace axiscal {

std::string reference_on_paper(LineReference reference) {
    switch (reference) {
    case LineReference::end_points: return "line through the end points";
    case LineReference::least_squares: return "least squares line";
    case LineReference::minimum_zone: break;
    }
    return "minimum zone";
}

std::string straightness_name_on_paper(std::string_view key) {
    constexpr std::string_view prefix = "straightness_", up = "_forward", down = "_backward";
    if (key.starts_with(prefix)) key.remove_prefix(prefix.size());
    std::string arrow;
    if (key.ends_with(up)) arrow = " ↑";
    if (key.ends_with(down)) arrow = " ↓";
    if (!arrow.empty()) key.remove_suffix(arrow == " ↑" ? up.size() : down.size());
    if (key == "B_mean") return "B\u0304";
    std::string name{key};
    for (char& letter : name)
        if (letter == '_') letter = ' ';
    return name + arrow;
}

int straightness_decimals(const StraightnessResult& result) {
    return length_decimals(result.mean().found.straightness_um(main_reference));
}

std::string straightness_on_paper(const StraightnessResult& result, LineReference reference) {
    const int decimals = straightness_decimals(result);
    const StraightnessUncertainty& known = uncertainty_against(result.mean(), reference);
    const std::string value = fixed(known.straightness_um, decimals) + " µm";
    if (!known.expanded_um) return value + ", U not evaluated";
    return value + " ± " + fixed_up(*known.expanded_um, decimals) + " µm";
}

std::string straightness_subject(const StraightnessResult& result) {
    const StraightnessSetup& setup = result.setup();
    if (setup.method == StraightnessMethod::angle_steps)
        return "Straightness of the line on which a foot of " + as_stated(setup.base.in(mm)) +
               " mm stood, along axis " + stated(result.run.statements.axis) + ", direction " +
               stated(setup.across);
    return "Straightness error of the motion of axis " + stated(result.run.statements.axis) +
           " in direction " + stated(setup.across);
}

std::string straightness_sentence(const StraightnessResult& result) {
    const StraightnessBudget& budget = result.mean().budget;
    const bool known = uncertainty_against(result.mean(), main_reference).expanded_um.has_value();
    return straightness_subject(result) +
           ", ISO 230-1:2012, reference: " + reference_on_paper(main_reference) + ": " +
           straightness_on_paper(result, main_reference) +
           (known ? " (k = " + fixed(budget.coverage, 0) + ")" : "") + ". By the " +
           reference_on_paper(LineReference::end_points) + " " +
           straightness_on_paper(result, LineReference::end_points) + ", by the " +
           reference_on_paper(LineReference::minimum_zone) + " " +
           straightness_on_paper(result, LineReference::minimum_zone) + ".";
}

} // namespace axiscal
