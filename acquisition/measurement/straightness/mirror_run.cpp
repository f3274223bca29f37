#include "acquisition/measurement/straightness/mirror_run.hpp"

#include "acquisition/journal/journal.hpp"
#include "acquisition/measurement/positioning/axis_facts.hpp"
#include "acquisition/runfile/complete_runs.hpp"
#include "analysis/straightness/recorded_line_of.hpp"

#include <cmath>
#include <utility>
#include <variant>

namespace axiscal {
namespace {

/// What parts the two runs beside the mirror; empty: nothing.
std::string difference_to(const RunFileContents& other,
                          const StraightnessSetup& theirs,
                          const StraightnessSetup& ours,
                          const RunPlan& plan) {
    constexpr double rounding = 1e-9;
    if (theirs.method != ours.method) return "another method";
    if (theirs.across != ours.across) return "another direction, " + theirs.across;
    if (std::fabs(theirs.factor / ours.factor - 1) > rounding) return "another factor";
    if (other.run.plan.targets != plan.targets) return "other targets";
    if (other.run.plan.bidirectional != plan.bidirectional) return "other directions";
    return {};
}

Result<void> check_other_mirror(const RunFileContents& other,
                                const StraightnessSetup& theirs,
                                const StraightnessSetup& ours,
                                const RunPlan& plan) {
    const std::string& id = other.run.run_id;
    const std::string differs = difference_to(other, theirs, ours, plan);
    if (!differs.empty())
        return refuse(Fault::bad_request, "reversal_of",
                      "names run " + id + ", which has " + differs +
                          ": take both runs by one plan and with the same optics");
    if (theirs.mirror != ours.mirror) return {};
    return refuse(Fault::bad_request, "reversal_of",
                  "names run " + id +
                      ", in which the mirror stood as it is said to stand now: turn it by 180 "
                      "degrees, or say how it stands by --option mirror=reversed or mirror=normal");
}

std::string wanted_mirror_run(const StraightnessConfig& config, const ArmRequest& request) {
    const auto said = request.options.find("reversal_of");
    return said == request.options.end() ? config.reversal_of : said->second;
}

} // namespace

Result<RecordedLine> line_of_other_mirror(const RunFileContents& other,
                                          const StraightnessSetup& setup,
                                          const RunPlan& plan) {
    const auto* const theirs = std::get_if<StraightnessSetup>(&other.attachments.setup);
    if (theirs == nullptr)
        return fail(Fault::bad_run_file, other.run.run_id + " holds no set-up of a straightness");
    AXISCAL_CHECK(check_other_mirror(other, *theirs, setup, plan));
    return recorded_line_of(other.run, other.revisions, *theirs);
}

Task<Result<std::optional<RecordedLine>>>
find_other_mirror(OrderContext context, const StraightnessSetup& setup, const ArmRequest& request) {
    const StraightnessConfig& config = *straightness_config_of(context.config);
    std::string which = wanted_mirror_run(config, request);
    if (which.empty()) co_return std::optional<RecordedLine>{};
    const std::string axis = drift_for_axis(context).of;
    WantedRun wanted{TestKind::straightness, std::move(which), axis, "straightness.reversal_of"};
    std::string folder = context.config.state_directory + "/runs";
    AXISCAL_CO_TRY(const RunFileContents other, co_await context.journal.find_complete_run(
                                                    std::move(folder), std::move(wanted)));
    AXISCAL_CO_TRY(RecordedLine line, line_of_other_mirror(other, setup, config.plan));
    co_return std::optional{std::move(line)};
}

} // namespace axiscal
