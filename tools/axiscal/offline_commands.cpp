#include "tools/axiscal/offline_commands.hpp"

#include "acquisition/documents/evaluate.hpp"
#include "acquisition/measurement/measurement_kind.hpp"
#include "acquisition/program/circular_program.hpp"
#include "acquisition/program/part_program.hpp"
#include "acquisition/run/cycle_plan.hpp"
#include "acquisition/run/resume.hpp"
#include "acquisition/run/retake_plan.hpp"
#include "acquisition/runfile/durable_file.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "acquisition/station/station_loader.hpp"
#include "analysis/quantity/counted.hpp"
#include "config/json_text.hpp"
#include "tools/axiscal/analyze_case.hpp"
#include "tools/axiscal/cases/case_table.hpp"
#include "tools/axiscal/complaint.hpp"
#include "tools/axiscal/exit_code.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <random>
#include <utility>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view sqlite_magic{"SQLite format 3\0", 16};

/// In large pieces: a file of a million points is 40 MB.
std::string rest_of(std::istream& stream) {
    std::string text, piece(std::size_t{1} << 16, '\0');
    do {
        stream.read(piece.data(), static_cast<std::streamsize>(piece.size()));
        text.append(piece, 0, static_cast<std::size_t>(stream.gcount()));
    } while (stream);
    return text;
}

Result<std::string> read_all(const std::string& path) {
    if (path == "-") return rest_of(std::cin);
    std::ifstream file{path, std::ios::binary};
    if (!file || std::filesystem::is_directory(path)) return fail(Fault::io, "cannot read " + path);
    return rest_of(file);
}

bool is_run_file(const std::string& path) {
    std::ifstream file{path, std::ios::binary};
    std::string head(sqlite_magic.size(), '\0');
    return file.read(head.data(), static_cast<std::streamsize>(head.size())) &&
           head == sqlite_magic;
}

int analyze_run(const std::string& path) {
    const auto result = evaluate_run_file(path);
    if (!result) return complain(result.error());
    std::cout << json_text_of(*result);
    return exit_ok;
}

/// Nothing: as [cycle] says.
std::optional<DrivenPlan> driven_plan(const StationConfig& config, TestKind kind) {
    const MeasurementKind& row = kind_row(kind);
    return row.driven == nullptr ? std::nullopt : row.driven(config);
}

/// Of a pass of the axis, which bears no name of a kind, nothing.
std::optional<DrivenPlan> driven_plan(const StationConfig& config, const RunPlan& plan) {
    const auto kind = kind_named(plan.pass);
    return kind ? driven_plan(config, *kind) : std::nullopt;
}

ProgramOrder order_of(const StationConfig& config, RunPlan plan) {
    ProgramOrder order;
    order.plan = std::move(plan);
    order.axis = config.axis.program_axis;
    order.feed = config.cycle.feed;
    order.dwell = config.cycle.dwell;
    order.shape = config.trigger.shape;
    order.answer_limit = config.trigger.cnc_timeout;
    order.capture_timeout = config.capture.timeout;
    if (config.axis.angle) order.rotary = config.axis.angle->setup;
    if (order.shape == TriggerShape::dwell)
        order.least_halt = config.trigger.minimum_halt + config.capture.window;
    if (const auto driven = driven_plan(config, order.plan)) {
        order.feed = driven->feed;
        order.dwell = driven->dwell;
    }
    return order;
}

/// As `axiscal export` does: a folder that is named is wanted.
Result<void> make_folder(const std::string& path) {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (!error || std::filesystem::is_directory(path)) return {};
    return fail(Fault::io, "cannot make the folder " + path + " of --out", error);
}

Result<std::string> write_program(const StationConfig& config,
                                  const RunPlan& plan,
                                  const ProgramDialect& dialect,
                                  const ProgramRequest& request) {
    ProgramOrder order = order_of(config, plan);
    order.datum_by_cnc = request.datum_by_cnc;
    AXISCAL_TRY(const std::string text, dialect.write(order));
    const std::string path = request.out_directory + "/" + config.axis.program_axis + "-" +
                             plan.pass + std::string{dialect.extension};
    AXISCAL_CHECK(replace_synced(path, text));
    return path;
}

/// The points that are left to be taken again; requests count on from the run's last one.
int write_retake_program(const ProgramRequest& request, const StationConfig& config, bool json) {
    auto contents = read_run_file_contents(request.run_file);
    if (!contents) return complain(contents.error());
    auto left = points_to_take_again(contents->run, contents->revisions);
    if (left.empty())
        return std::cerr << request.run_file
                         << ": nothing is to be taken again; 'axiscal retake' asks for it\n",
               exit_refused;
    const auto dialect = find_dialect(request.dialect.empty() ? "linuxcnc" : request.dialect);
    if (!dialect) return std::cerr << dialect.error().detail << "\n", exit_usage;
    ProgramOrder order = order_of(config, contents->run.plan);
    order.plan.points = std::move(left);
    order.last_request = last_durable_request(contents->run).sequence;
    order.retakes = true;
    const auto text = dialect->write(order);
    if (!text) return complain(text.error());
    const std::string path = request.out_directory + "/" + config.axis.program_axis + "-retake-" +
                             std::to_string(contents->revisions.retakes.back().number) +
                             std::string{dialect->extension};
    if (const auto written = replace_synced(path, *text); !written)
        return complain(written.error());
    if (json)
        std::cout << json_text(Json{{"programs",
                                     {{{"file", path},
                                       {"points", order.plan.points.size()},
                                       {"last_request", order.last_request}}}}})
                  << "\n";
    else
        std::cout << path << ": " << counted(static_cast<long>(order.plan.points.size()), "point")
                  << " to be taken again; load and start it, the station is armed\n";
    return exit_ok;
}

/// Beside the cycle of the axis, of each kind of test that the station file has.
void add_plans_of_kinds(const StationConfig& config, std::vector<RunPlan>& passes) {
    for (const TestKind kind : all_test_kinds)
        if (auto driven = driven_plan(config, kind)) passes.push_back(std::move(driven->plan));
}

/// Beside the linear cycle, where the station file has a circular test.
Result<std::string> write_circles(const StationConfig& config, const std::string& folder) {
    const CircularPlan& plan = config.circular->setup.plan;
    const CircularOrder order{plan, config.trigger.shape, config.trigger.cnc_timeout};
    const std::string path = folder + "/" + std::string{name_of(plan.plane)} + "-circular.ngc";
    AXISCAL_CHECK(replace_synced(path, write_circular_linuxcnc(order)));
    return path;
}

Json plan_json(const RunPlan& plan, const std::string& path) {
    Json targets = Json::array();
    for (const Length target : plan.targets)
        targets.push_back(target.in(mm));
    return {{"file", path},
            {"pass", plan.pass},
            {"seed", plan.seed ? Json(*plan.seed) : Json(nullptr)},
            {"datum_mm", plan.datum.in(mm)},
            {"points", plan.points.size()},
            {"approaches", plan.approaches},
            {"targets_mm", std::move(targets)}};
}

void tell_program(const RunPlan& plan, const std::string& path) {
    const char* unit = plan.axis_kind == AxisKind::rotary ? " deg" : " mm";
    std::cout << path << ": " << counted(static_cast<long>(plan.points.size()), "point") << " on "
              << counted(static_cast<long>(plan.targets.size()), "target") << ", datum at "
              << plan.datum.in(mm) << unit << "\n";
    if (!plan.remark.empty()) std::cout << "  " << plan.remark << "\n";
}

/// Where to arm stands in the order in which the program needs it.
std::string way_to_arm(TriggerShape shape, bool datum_by_cnc, const std::string& path) {
    const std::string program = "--program " + path;
    if (shape == TriggerShape::dwell)
        return "it waits for nobody: drive the axis to its datum, then axiscal arm " + program +
               ", then load and start it";
    if (datum_by_cnc)
        return "load and start it; before or after: axiscal arm --datum-by-cnc " + program;
    return "load and start it; when the axis waits at its datum: axiscal arm " + program;
}

} // namespace

int command_analyze(const std::string& path) {
    if (path != "-" && is_run_file(path)) return analyze_run(path);
    const auto text = read_all(path);
    if (!text) return complain(text.error());
    const CaseAnswer answer = analyze_cases(*text);
    std::cout << answer.output << std::flush;
    if (!answer.error_line.empty()) std::cerr << answer.error_line << "\n";
    return answer.exit_code;
}

int command_case_new(const NewCaseOrder& order) {
    if (std::filesystem::exists(std::filesystem::symlink_status(order.path)))
        return std::cerr << order.path << " is there already: name another file\n", exit_refused;
    if (const auto written = replace_synced(order.path, table_template(order.kind)); !written)
        return complain(written.error());
    std::cout << order.path << " is written: fill it in, then: axiscal analyze " << order.path
              << "\n";
    return exit_ok;
}

int command_program(const ProgramRequest& request, bool json) {
    auto station = load_station(request.station_file);
    if (!station) return complain(station.error(), json);
    StationConfig& config = station->config;
    if (const auto made = make_folder(request.out_directory); !made) return complain(made.error());
    if (!request.run_file.empty()) return write_retake_program(request, config, json);
    if (request.seed) config.cycle.seed = request.seed;
    std::random_device entropy;
    std::vector<RunPlan> passes;
    if (!config.circles_alone()) {
        auto planned = plan_passes(config.cycle, entropy());
        if (!planned) return complain(planned.error());
        passes = *std::move(planned);
    }
    add_plans_of_kinds(config, passes);
    const auto dialect = find_dialect(request.dialect.empty() ? "linuxcnc" : request.dialect);
    if (!dialect) return std::cerr << dialect.error().detail << "\n", exit_usage;
    if (passes.empty() && dialect->name != "linuxcnc")
        return std::cerr << "circles are written for LinuxCNC only: --dialect linuxcnc\n",
               exit_refused;
    Json list = Json::array();
    for (const RunPlan& plan : passes) {
        const auto path = write_program(config, plan, *dialect, request);
        if (!path) return complain(path.error());
        list.push_back(plan_json(plan, *path));
        if (json) continue;
        tell_program(plan, *path);
        std::cout << "  " << way_to_arm(config.trigger.shape, request.datum_by_cnc, *path) << "\n";
    }
    if (config.circular && dialect->name == "linuxcnc") {
        const auto path = write_circles(config, request.out_directory);
        if (!path) return complain(path.error());
        const auto circles = planned_circles(config.circular->setup.plan).size();
        list.push_back({{"file", *path}, {"pass", "circular"}, {"circles", circles}});
        if (!json)
            std::cout << *path << ": " << counted(static_cast<long>(circles), "circle")
                      << "; when the machine waits at rest: axiscal arm --pass circular\n";
    }
    if (json) std::cout << json_text(Json{{"programs", std::move(list)}}) << "\n";
    return exit_ok;
}

} // namespace axiscal
