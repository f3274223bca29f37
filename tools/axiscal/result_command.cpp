// `axiscal result`: the figures of one run, for somebody who has just measured it.
#include "acquisition/documents/evaluate.hpp"
#include "acquisition/documents/positioning/certificate_json.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "config/json_text.hpp"
#include "config/tolerance_file.hpp"
#include "tools/axiscal/cases/tolerances_member.hpp"
#include "tools/axiscal/exit_code.hpp"
#include "tools/axiscal/find_run.hpp"
#include "tools/axiscal/offline_commands.hpp"
#include "tools/axiscal/result_text.hpp"

#include <fstream>
#include <iostream>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

/// Another kind of test has other figures.
Result<void> check_positioning(const RunSummary& run) {
    if (run.kind == TestKind::positioning) return {};
    return fail(Fault::refused, run.run_id + " is a " + std::string{name_of(run.kind)} +
                                    " test, which has no E, A, R, B and M: 'axiscal analyze " +
                                    run.path + "' gives its figures");
}

/// Limits of a file take the place of those of the run.
Result<void> take_limits(const ResultRequest& request, Certificate& made) {
    if (request.tolerances.empty()) return {};
    if (request.tolerances.ends_with(".toml")) {
        AXISCAL_TRY(ToleranceRecord set,
                    load_tolerances(request.tolerances, made.run.plan.axis_kind));
        const bool turns = made.run.plan.axis_kind == AxisKind::rotary;
        const auto own = limits_of_kind(set, TestKind::positioning, turns);
        if (!own)
            return fail(Fault::bad_configuration,
                        request.tolerances + " has no limit of a positioning run: A, E, M, R or B");
        made.conformity = conformity_of(made, own, request.travel);
        return {};
    }
    std::ifstream file{request.tolerances};
    if (!file) return fail(Fault::io, "cannot read " + request.tolerances);
    const auto member = nlohmann::json::parse(file, nullptr, false);
    if (!member.is_object())
        return fail(Fault::bad_case, request.tolerances + " is no set of limits in JSON");
    const bool rotary = made.run.plan.axis_kind == AxisKind::rotary;
    const std::string unit = rotary ? "deg" : "mm";
    AXISCAL_TRY(ToleranceSet set, tolerance_set_of(member, {made.run.statements.axis,
                                                            made.run.plan.axis_kind, unit, unit}));
    made.conformity = conformity_of(made, std::move(set), request.travel);
    return {};
}

std::string about(const Certificate& certificate) {
    const Statements& said = certificate.run.statements;
    const auto or_unstated = [](const std::string& text) {
        return text.empty() ? std::string{"not stated"} : text;
    };
    if (const auto& imported = certificate.run.imported)
        return "Axis " + or_unstated(said.axis) + ", machine " + or_unstated(said.machine) +
               ", imported from " + imported->file + ", measured " +
               or_unstated(imported->measured);
    return "Axis " + or_unstated(said.axis) + ", machine " + or_unstated(said.machine) +
           ", measured from " + certificate.started_utc + " to " + certificate.finished_utc;
}

Result<void> print_result(const ResultRequest& request, bool json) {
    AXISCAL_TRY(const std::string path, find_run(request.run, request.station_file));
    AXISCAL_TRY(const RunSummary run, summarize_run_file(path));
    AXISCAL_CHECK(check_positioning(run));
    AXISCAL_TRY(TestResult result, evaluate_run_file(path));
    auto& certificate = std::get<Certificate>(result); // check_positioning() has seen the kind
    AXISCAL_CHECK(take_limits(request, certificate));
    const Json summary = result_summary(certificate_to_json(certificate));
    std::cout << (json ? json_text(summary) + "\n" : result_text(summary, about(certificate)))
              << std::flush;
    return {};
}

} // namespace

int command_result(const ResultRequest& request, bool json) {
    if (const auto printed = print_result(request, json); !printed) {
        std::cerr << describe(printed.error()) << "\n";
        return exit_refused;
    }
    return exit_ok;
}

} // namespace axiscal
