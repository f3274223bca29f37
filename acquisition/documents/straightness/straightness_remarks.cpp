#include "acquisition/documents/straightness/straightness_remarks.hpp"

#include "acquisition/documents/csv_text.hpp"
#include "analysis/record/preflight_remarks.hpp"
#include "analysis/record/run_clock.hpp"

#include <utility>

namespace axiscal {
namespace {

std::string remark_on_mirror(const StraightnessSetup& setup) {
    const std::string words = "The mirror's form is part of the result";
    return setup.uncertainty.mirror_limit_um_per_m2 ? words + "; its limit stands in the budget."
                                                    : words + ", and no limit of it is stated.";
}

/// Two runs are parted on no paper yet: nobody may take this one for their mean.
std::string remark_on_turned_mirror(const StraightnessSetup& setup) {
    std::string words = "The mirror stood ";
    words += setup.mirror == MirrorPosition::reversed ? "turned by 180 degrees" : "as at first";
    if (!setup.reversal_of.empty())
        words += "; run " + setup.reversal_of + " has the other position";
    return words + ". This is the result of one position alone.";
}

void remark_on_wollaston(const StraightnessSetup& setup, std::vector<std::string>& remarks) {
    remarks.push_back(remark_on_mirror(setup));
    if (setup.mirror == MirrorPosition::reversed || !setup.reversal_of.empty())
        remarks.push_back(remark_on_turned_mirror(setup));
    remarks.emplace_back("The refractive index of the air is taken as 1.000271: what it may be "
                         "wrong by is far below the uncertainty of the factor.");
    remarks.emplace_back("In no budget: the roll of the prism, which mixes in the motion in the "
                         "other plane, and pitch and yaw of the axis with the distance of the "
                         "optics from the functional point.");
}

void remark_on_method(const StraightnessSetup& setup, std::vector<std::string>& remarks) {
    remarks.emplace_back("Positions by the control of the machine: a reading across the axis shows "
                         "neither where the axis stood nor from which side it came.");
    if (setup.method == StraightnessMethod::wollaston)
        remark_on_wollaston(setup, remarks);
    else
        remarks.push_back("Straightness of the line on which a foot of " +
                          csv_number(setup.base.in(mm)) +
                          " mm stood; it is not that of the motion of the axis.");
    remarks.emplace_back("No reading is compensated for the expansion of the axis: a deviation "
                         "across it does not grow with it, and its own expansion is below 1e-4 of "
                         "itself.");
}

void remark_on_set_aside(const RunRevisions& revisions, std::vector<std::string>& remarks) {
    if (!revisions.superseded.empty())
        remarks.push_back(
            "Readings replaced by new ones: " + std::to_string(revisions.superseded.size()) +
            ". The replaced ones stay in the run file; no figure uses them.");
    if (!revisions.exclusions.empty())
        remarks.push_back(
            "Readings excluded: " + std::to_string(revisions.exclusions.size()) +
            ". They enter no figure; the budget takes the smallest number of readings "
            "of a target and direction.");
    for (const ExclusionRecord& exclusion : revisions.exclusions)
        remarks.push_back("Step " + std::to_string(exclusion.step + 1) +
                          " was excluded: " + exclusion.reason);
}

} // namespace

std::vector<std::string> remarks_on_straightness(const StraightnessResult& result,
                                                 Duration clock_off) {
    const RunRecord& run = result.run;
    std::vector<std::string> remarks = remarks_on_completeness(run, result.completeness);
    remark_on_method(result.setup(), remarks);
    if (!run.plan.remark.empty()) remarks.push_back(run.plan.remark);
    if (!result.attachments.eve_source.empty())
        remarks.push_back("E_VE is the range of the drift test " + result.attachments.eve_source +
                          ".");
    if (std::string remark = remark_on_clock(clock_off); !remark.empty())
        remarks.push_back(std::move(remark));
    remark_on_set_aside(result.revisions, remarks);
    remark_on_preflight(result.revisions.preflight, remarks);
    return remarks;
}

std::vector<std::string> missing_terms_of(const StraightnessResult& result) {
    std::vector<std::string> words;
    for (const std::string& term : result.mean().budget.not_stated) {
        if (term == "factor") words.emplace_back("the uncertainty of the factor of the optics");
        if (term == "mirror") words.emplace_back("a limit of the mirror's form");
        if (term == "angle") words.emplace_back("the uncertainty of an angle");
        if (term == "base") words.emplace_back("the uncertainty of the base of the foot");
        if (term == "resolution") words.emplace_back("the least step of a reading");
        if (term == "environment") words.emplace_back("E_VE of a drift test with these optics");
    }
    return words;
}

} // namespace axiscal
