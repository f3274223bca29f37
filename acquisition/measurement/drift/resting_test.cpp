#include "acquisition/measurement/drift/resting_test.hpp"

#include "acquisition/capture/wording.hpp"
#include "acquisition/live/supervisor.hpp"
#include "analysis/record/circular_setup.hpp"
#include "analysis/record/rotary_setup.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace axiscal {
namespace {

Result<void> check_spans(const DriftRequest& request, const StationConfig& config) {
    if (request.interval <= Duration{} || request.duration < 2 * request.interval)
        return refuse(Fault::bad_request, "duration", "is shorter than two intervals");
    if (request.interval < config.capture.window)
        return refuse(Fault::bad_request, "interval",
                      "is shorter than capture.window, over which each reading is a mean");
    return {};
}

/// No test before the faces of a polygon: it is not watched between them.
Result<void> check_is_watched(const StationConfig& config, const StationRoles& roles) {
    if (roles.autocollimator)
        return fail(Fault::refused, "a drift test before a polygon is not supported, the "
                                    "autocollimator is read at the faces of a run alone: state "
                                    "uncertainty.eve, the range of its reading, by hand");
    if (config.axis.angle && config.axis.angle->setup.method == AngleMethod::polygon)
        return fail(Fault::refused, "an autocollimator whose readings are typed cannot be recorded "
                                    "against time: state uncertainty.eve by hand");
    return {};
}

/// Before its first second nothing is known of it; intervals are counted as missing then.
Result<void> check_rate_of_bar(const StationConfig& config, double rate_hz) {
    const double readings = rate_hz * seconds_of(config.capture.window);
    if (rate_hz == 0 || readings >= fewest_of_bar) return {};
    return fail(Fault::refused, "the ballbar (" + config.ballbar->instrument + ") sends " +
                                    plain_number(rate_hz, 1) +
                                    " readings a second: let it send at least two within each " +
                                    plain_number(seconds_of(config.capture.window), 3) +
                                    " s, over which each reading is a mean");
}

/// Every channel of the station, the one that is watched first. One that no run of it uses stands
/// without a medium: it must not count as air or material of the axis.
std::vector<ChannelRecord>
every_channel(const Supervisor& supervisor, int watched, const std::vector<int>& environment) {
    std::vector<ChannelRecord> records;
    for (const StationChannel& channel : supervisor.channels()) {
        ChannelRecord record{channel.id,   channel.shown,  channel.instrument_name, channel.place,
                             channel.kind, channel.medium, channel.correction};
        const bool used = channel.id == watched ||
                          std::ranges::find(environment, channel.id) != environment.end();
        if (!used) record.medium = Medium::none;
        records.push_back(std::move(record));
    }
    // clang 14 does not take the ranges' own.
    std::stable_partition(records.begin(), records.end(),
                          [watched](const ChannelRecord& record) { return record.id == watched; });
    return records;
}

ArmRequest statements_of(const DriftRequest& request) {
    ArmRequest statements;
    statements.statements = request.statements;
    return statements;
}

/// What the header of a drift test has that of a run has not, or the other way round.
void state_rest(RunRecord& header,
                const Supervisor& supervisor,
                const DriftRequest& request,
                std::vector<ChannelRecord> channels) {
    // No certificate: a number of the station file is none of it.
    if (!request.statements.contains("certificate_number"))
        header.statements.certificate_number.clear();
    header.channels = std::move(channels);
    header.calibrations = calibrations_of(supervisor, header.channels);
}

} // namespace

Result<DriftSetup> drift_setup_of(const StationConfig& config,
                                  const StationRoles& roles,
                                  const DriftRequest& request,
                                  const RunPlan& plan) {
    AXISCAL_CHECK(check_is_watched(config, roles));
    AXISCAL_CHECK(check_spans(request, config));
    const Length low = config.cycle.travel_low, high = config.cycle.travel_high;
    const Length far = config.axis.sign > 0 ? high : low;
    const Length usual = plan.axis_kind == AxisKind::rotary ? plan.datum : far;
    const Length place = request.place_mm ? mm(*request.place_mm) : usual;
    if (place < low || place > high)
        return refuse(Fault::bad_request, "place_mm", "lies outside the travel of the axis");
    return DriftSetup{request.duration, request.interval, place};
}

Result<RestingTest>
axis_at_rest(RunHeaderParts parts, const DriftRequest& request, const DriftSetup& setup) {
    parts.plan.pass = RunPlan{}.pass;
    parts.plan.targets.clear();
    parts.plan.points.clear();
    parts.plan.remark.clear();
    const StationConfig& config = parts.config;
    AXISCAL_TRY(RunRecord header, make_run_header(parts, statements_of(request)));
    header.run_id = free_run_id(config, config.axis.name, parts.opened.utc_ns, "-drift");
    const int watched = *parts.roles.laser;
    state_rest(header, parts.supervisor, request,
               every_channel(parts.supervisor, watched, parts.roles.environment()));
    return RestingTest{std::move(header), setup, watched, {}};
}

Result<RestingTest> bar_at_rest(RunHeaderParts parts, const DriftRequest& request, double rate_hz) {
    const StationConfig& config = parts.config;
    AXISCAL_CHECK(check_spans(request, config));
    AXISCAL_CHECK(check_rate_of_bar(config, rate_hz));
    if (request.place_mm)
        return refuse(Fault::bad_request, "place_mm",
                      "is of an axis; a ballbar has no place on it");
    const std::string plane =
        config.circular ? std::string{name_of(config.circular->setup.plan.plane)} : "";
    const std::string name = (plane.empty() ? plane : plane + "-") + "ballbar";
    AXISCAL_TRY(RunRecord header, make_header_without_axis(parts, name, statements_of(request)));
    header.run_id = free_run_id(config, name, header.opened.utc_ns, "-drift");
    header.statements.axis = plane;
    header.laser = {};
    header.laser.instrument = config.ballbar->instrument;
    if (header.rotary) header.tolerances.reset(); // stated in arcsec, of the axis
    header.rotary.reset();
    header.scale.reset();
    const int watched = *parts.roles.ballbar;
    state_rest(header, parts.supervisor, request,
               every_channel(parts.supervisor, watched, parts.roles.of_circles()));
    const DriftSetup setup{request.duration, request.interval, Length{}, true};
    return RestingTest{std::move(header), setup, watched, {}};
}

} // namespace axiscal
