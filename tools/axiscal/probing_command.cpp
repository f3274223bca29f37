#include "tools/axiscal/probing_command.hpp"

#include "acquisition/documents/evaluate.hpp"
#include "acquisition/measurement/run_header.hpp"
#include "acquisition/runfile/digest.hpp"
#include "acquisition/runfile/durable_file.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "acquisition/station/station_loader.hpp"
#include "analysis/probing/probing_case.hpp"
#include "analysis/quantity/valid_text.hpp"
#include "config/json_text.hpp"
#include "config/version.hpp"
#include "drivers/loop/asio_scheduler.hpp"
#include "tools/axiscal/complaint.hpp"
#include "tools/axiscal/exit_code.hpp"

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <iterator>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

Result<std::string> text_of_file(const std::string& path) {
    std::ifstream file{path, std::ios::binary};
    if (!file) return fail(Fault::io, "cannot read " + path);
    return std::string{std::istreambuf_iterator<char>{file}, {}};
}

int write_program(const ProbingOrder& order, bool json) {
    const auto text = write_probing_linuxcnc(order.plan, order.log);
    if (!text) return complain(text.error());
    if (const auto written = replace_synced(order.program, *text); !written)
        return complain(written.error());
    const int touches = 3 * (order.plan.references + order.plan.touches);
    if (json)
        std::cout << json_text(Json{{"file", order.program},
                                    {"log", order.log},
                                    {"touches", touches},
                                    {"plan", probing_id(order.plan)}})
                  << "\n";
    else
        std::cout
            << order.program << ": 3 touches that set the zero, then " << touches << " into "
            << order.log
            << ".\n  Set a rough zero of G54 at the corner of the block, load and start it; then: "
               "axiscal probing record --program "
            << order.program << " --log " << order.log << "\n";
    return exit_ok;
}

/// The two clocks of this PC, read together.
ClockTie tie_now() {
    ClockTie tie;
    tie.before = monotonic_now();
    tie.utc_ns =
        std::chrono::nanoseconds{std::chrono::system_clock::now().time_since_epoch()}.count();
    tie.after = monotonic_now();
    return tie;
}

/// What the station file states of machine and place; the laser has no part in this test.
RunRecord header_of(const StationConfig& config, const ProbingOrder& order) {
    RunRecord run;
    run.opened = tie_now();
    run.run_id = run_id_of(config.station, "probing", run.opened.utc_ns);
    run.software_version = software_version();
    run.station = config.station;
    run.station_config = config.text;
    run.config_hash = sha256_hex(config.text);
    run.kind = TestKind::probing;
    if (config.tolerances) run.tolerances = limits_of_kind(*config.tolerances, run.kind, false);
    run.statements = config.statements;
    run.statements.certificate_number.clear(); // no certificate: the station's numbers are not its
    if (!order.operator_name.empty())
        run.statements.operator_name = valid_text(order.operator_name);
    run.laser.instrument = "none";
    return run;
}

/// @returns the path of the closed run file.
Result<std::string> make_run_file(const StationConfig& config, const ProbingOrder& order) {
    AXISCAL_TRY(const std::string program, text_of_file(order.program));
    AXISCAL_TRY(const ProbingPlan plan, read_probing_id(program));
    AXISCAL_TRY(const std::string log, text_of_file(order.log));
    AXISCAL_TRY(ProbingRecord record, read_probing_log(plan, log));
    record.probe = valid_text(order.probe);
    record.signal_path = valid_text(order.signal_path);
    if (const auto results = evaluate_probing_delay(case_of(record)); !results)
        return tl::unexpected<Error>(results.error());
    const RunRecord header = header_of(config, order);
    RunAttachments attachments;
    attachments.setup = std::move(record);
    std::string path = order.out + "/" + header.run_id + std::string{run_file_ending};
    AXISCAL_TRY(RunFileWriter writer, RunFileWriter::create(path, header, attachments));
    AXISCAL_CHECK(writer.close(true, "", tie_now()));
    return path;
}

std::string text_of(const ProbingResult& document) {
    std::string text;
    for (const ProbingDelay& result : document.results) {
        char line[160];
        std::snprintf(line, sizeof line, "%-8s %3zu touches  %8.4f mm  %7.3f ms",
                      result.symbol.c_str(), result.touches, result.variation_mm,
                      result.variation_ms);
        text += line;
        if (result.period_ms) {
            std::snprintf(line, sizeof line, "  saw-tooth of %.3f ms", *result.period_ms);
            text += line;
        }
        text += "\n";
    }
    return text;
}

int record(const ProbingOrder& order, bool json) {
    const auto station = load_station(order.config);
    if (!station) {
        for (const Refusal& refusal : station.error())
            std::cerr << refusal.describe() << "\n";
        return exit_refused;
    }
    const auto path = make_run_file(station->config, order);
    if (!path) return complain(path.error());
    const Issue unsigned_one;
    const auto result = evaluate_run_file(*path, &unsigned_one);
    if (!result) return complain(result.error());
    if (json)
        std::cout << json_text(Json{{"file", *path}, {"result", json_of(*result)}}) << "\n";
    else
        std::cout << text_of(std::get<ProbingResult>(*result)) << "Run file " << *path
                  << "; 'axiscal export' makes its papers.\n";
    return exit_ok;
}

} // namespace

int command_probing(const ProbingOrder& order, bool json) {
    return order.action == "record" ? record(order, json) : write_program(order, json);
}

} // namespace axiscal
