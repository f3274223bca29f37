#include "acquisition/documents/straightness/across_remarks.hpp"

#include "analysis/record/preflight_remarks.hpp"
#include "analysis/record/run_clock.hpp"

#include <utility>

namespace axiscal {
namespace {

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

void remark_on_course(const AcrossRun& one, Duration clock_off, std::vector<std::string>& remarks) {
    if (!one.run.plan.remark.empty()) remarks.push_back(one.run.plan.remark);
    if (!one.attachments.eve_source.empty())
        remarks.push_back("E_VE is the range of the drift test " + one.attachments.eve_source +
                          ".");
    if (std::string remark = remark_on_clock(clock_off); !remark.empty())
        remarks.push_back(std::move(remark));
    remark_on_set_aside(one.revisions, remarks);
    remark_on_preflight(one.revisions.preflight, remarks);
}

std::vector<std::string> terms_in_words(const std::vector<std::string>& not_stated) {
    std::vector<std::string> words;
    for (const std::string& term : not_stated) {
        if (term == "factor") words.emplace_back("the uncertainty of the factor of the optics");
        if (term == "mirror") words.emplace_back("a limit of the mirror's form");
        if (term == "square") words.emplace_back("the uncertainty of the error of the square");
        if (term == "mount") words.emplace_back("how far mirror and square may have turned");
        if (term == "angle") words.emplace_back("the uncertainty of an angle");
        if (term == "base") words.emplace_back("the uncertainty of the base of the foot");
        if (term == "resolution") words.emplace_back("the least step of a reading");
        if (term == "environment") words.emplace_back("E_VE of a drift test with these optics");
    }
    return words;
}

} // namespace axiscal
