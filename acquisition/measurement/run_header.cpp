#include "acquisition/measurement/run_header.hpp"

#include "acquisition/runfile/run_file.hpp"
#include "acquisition/runfile/run_store.hpp"
#include "analysis/quantity/valid_text.hpp"
#include "config/measure.hpp"
#include "config/number_pattern.hpp"
#include "config/version.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <utility>

namespace axiscal {
namespace {

using Field = std::string Statements::*;

constexpr std::array<std::pair<std::string_view, Field>, 13> statement_fields{{
    {"certificate_number", &Statements::certificate_number},
    {"customer", &Statements::customer},
    {"place", &Statements::place},
    {"operator", &Statements::operator_name},
    {"approver", &Statements::approver},
    {"procedure", &Statements::procedure},
    {"state", &Statements::state},
    {"warm_up", &Statements::warm_up},
    {"offsets", &Statements::offsets},
    {"idle_axes", &Statements::idle_axes},
    {"sensor_note", &Statements::sensor_note},
    {"next_due", &Statements::next_due},
    {"control_compensation", &Statements::control_compensation},
}};

LaserSetup laser_of(const RunHeaderParts& parts) {
    const AxisConfig& axis = parts.config.axis;
    LaserSetup laser;
    laser.sign = axis.sign;
    if (!parts.roles.laser) { // a polygon's autocollimator, empty where its readings are typed
        if (axis.angle) laser.instrument = axis.angle->autocollimator.instrument;
        return laser;
    }
    laser.instrument = axis.laser.instrument;
    if (axis.scale) return laser; // which has no beam
    laser.dead_path = axis.dead_path;
    laser.beam_walk = axis.beam_walk;
    laser.beam_walk_travel = axis.beam_walk_travel;
    const int seat =
        parts.supervisor.channels()[static_cast<std::size_t>(*parts.roles.laser)].instrument;
    if (const auto optics = parts.supervisor.instrument(seat).optics()) {
        laser.vacuum_wavelength = optics->vacuum_wavelength;
        laser.optical_fold = optics->optical_fold;
    }
    return laser;
}

std::optional<ScaleSetup> scale_of(const RunHeaderParts& parts) {
    const auto& stated = parts.config.axis.scale;
    if (!stated || !parts.roles.laser) return std::nullopt;
    ScaleSetup scale = stated->setup;
    const int seat =
        parts.supervisor.channels()[static_cast<std::size_t>(*parts.roles.laser)].instrument;
    scale.resolution = parts.supervisor.instrument(seat).resolution().value_or(Length{});
    scale.channels = parts.roles.scale;
    return scale;
}

/// Those of this kind of test, in the unit of its figures.
std::optional<ToleranceRecord> tolerances_of(const StationConfig& config, TestKind kind) {
    if (!config.tolerances) return std::nullopt;
    return limits_of_kind(*config.tolerances, kind, config.cycle.axis_kind == AxisKind::rotary);
}

/// What the device says of itself, completed by what the station file states.
InstrumentRecord instrument_of(const InstrumentConfig& config, const Identity& identity) {
    return {.name = config.name,
            .driver = config.driver,
            .maker = identity.maker,
            .model = identity.model,
            .serial = identity.serial.empty() ? config.serial : identity.serial,
            .firmware = identity.firmware,
            .certificate_number = config.certificate_number,
            .calibrated_on = config.calibrated_on,
            .due_on = config.due_on};
}

std::vector<ChannelRecord> channels_of(const RunHeaderParts& parts) {
    std::vector<ChannelRecord> records;
    std::vector<int> ids = parts.roles.environment();
    if (parts.roles.laser) ids.push_back(*parts.roles.laser);
    for (const int id : parts.further_channels)
        if (std::ranges::find(ids, id) == ids.end()) ids.push_back(id);
    std::ranges::sort(ids);
    for (const int id : ids) {
        const StationChannel& channel = parts.supervisor.channels()[static_cast<std::size_t>(id)];
        records.push_back({.id = id,
                           .name = channel.shown,
                           .instrument = channel.instrument_name,
                           .place = channel.place,
                           .kind = channel.kind,
                           .medium = channel.medium,
                           .correction = channel.correction});
    }
    return records;
}

} // namespace

std::vector<ChannelCalibration> calibrations_of(const Supervisor& supervisor,
                                                const std::vector<ChannelRecord>& recorded) {
    std::vector<ChannelCalibration> calibrations;
    calibrations.reserve(recorded.size());
    for (const ChannelRecord& record : recorded) {
        const StationChannel& channel = supervisor.channels()[static_cast<std::size_t>(record.id)];
        if (channel.certified()) calibrations.push_back(channel.calibration);
    }
    return calibrations;
}

namespace {

std::vector<std::string> statement_names() {
    std::vector<std::string> names{"run_out"};
    for (const auto& [name, field] : statement_fields)
        names.emplace_back(name);
    return names;
}

} // namespace

std::string run_id_of(const std::string& station,
                      const std::string& axis,
                      std::int64_t utc_ns,
                      int of_this_second) {
    const std::string further = of_this_second > 1 ? "-" + std::to_string(of_this_second) : "";
    return id_of_name(station, "station", longest_station_part) + "-" + instant_in_name(utc_ns) +
           further + "-" + id_of_name(axis, "axis", longest_axis_part);
}

namespace {

bool is_borne(const std::string& state_directory, const std::string& id) {
    const std::filesystem::path here{state_directory};
    std::error_code ignored;
    return std::filesystem::exists(here / "runs" / (id + std::string{run_file_ending}), ignored) ||
           std::filesystem::exists(here / "outbox" / id, ignored) ||
           std::filesystem::exists(here / "outbox" / ("." + id + ".staging"), ignored) ||
           std::filesystem::exists(here / "published" / id, ignored);
}

} // namespace

std::string free_run_id(const StationConfig& config,
                        const std::string& axis,
                        std::int64_t utc_ns,
                        const std::string& ending) {
    for (int k = 1;; ++k) {
        std::string id = run_id_of(config.station, axis, utc_ns, k) + ending;
        if (!is_borne(config.state_directory, id)) return id;
    }
}

std::string taken_up_text(const RunRecord& run) {
    const std::string ours = software_version();
    const bool same = run.software_version == ours;
    return "Version " + ours + " goes on" +
           (same ? "" : "; version " + run.software_version + " opened the run") + ". ";
}

Result<RunRecord> make_run_header(const RunHeaderParts& parts, const ArmRequest& request) {
    const StationConfig& config = parts.config;
    RunRecord run;
    run.run_id = free_run_id(config, config.axis.name, parts.opened.utc_ns);
    run.software_version = software_version();
    run.station = config.station;
    run.station_config = config.text;
    run.config_hash = parts.config_hash;
    run.boot_id = parts.boot_id;
    run.opened = parts.opened;
    run.kind = parts.kind;
    run.plan = parts.plan;
    run.laser = laser_of(parts);
    run.material = config.axis.material;
    run.air = config.axis.air;
    if (config.axis.angle) run.rotary = config.axis.angle->setup;
    run.scale = scale_of(parts);
    run.uncertainty = config.uncertainty;
    run.tolerances = tolerances_of(config, parts.kind);
    run.statements = config.statements;
    if (run.statements.axis.empty()) run.statements.axis = config.axis.name;
    for (const auto& [key, value] : request.statements) {
        if (run.rotary && key == "run_out") {
            run.rotary->run_out = value;
            continue;
        }
        const auto field =
            std::ranges::find(statement_fields, key, &std::pair<std::string_view, Field>::first);
        if (field == statement_fields.end())
            return refuse(Fault::bad_request, "statements." + key,
                          "is not a statement" + did_you_mean(key, statement_names()));
        run.statements.*(field->second) = value;
    }
    if (std::string mistake = mistake_in_number(run.statements.certificate_number);
        !mistake.empty())
        return refuse(Fault::bad_request, "statements.certificate_number", std::move(mistake));
    for (std::size_t i = 0; i < config.instruments.size(); ++i)
        run.instruments.push_back(
            instrument_of(config.instruments[i], parts.supervisor.identity(static_cast<int>(i))));
    if (config.axis.angle) run.instruments.push_back(config.axis.angle->artefact);
    run.channels = channels_of(parts);
    run.calibrations = calibrations_of(parts.supervisor, run.channels);
    return run;
}

Result<RunRecord>
make_header_without_axis(RunHeaderParts parts, const std::string& name, const ArmRequest& request) {
    parts.plan = {};
    parts.plan.approaches = 0;
    parts.plan.bidirectional = false;
    AXISCAL_TRY(RunRecord header, make_run_header(parts, request));
    header.run_id = free_run_id(parts.config, name, parts.opened.utc_ns);
    header.uncertainty.reset(); // it speaks of the linear axis
    return header;
}

} // namespace axiscal
