// What the pre-flight checks look at, gathered from the running station.
#include "acquisition/station/station.hpp"

#include <algorithm>

namespace axiscal {
namespace {

/// As make_run_header will take it: what a person says at arming goes before the station file.
std::string
stated(const ArmRequest& request, const std::string& key, const std::string& in_station_file) {
    const auto said = request.statements.find(key);
    return said == request.statements.end() ? in_station_file : said->second;
}

} // namespace

std::optional<int> Station::autocollimator_for(PreflightFacts& facts) const {
    const auto id = roles_.autocollimator;
    if (!id || facts.circular) return std::nullopt;
    facts.faces_read = true;
    if (const auto& last = readings_.latest(*id)) facts.face_age = facts.now - last->at;
    return id;
}

PreflightFacts Station::preflight_facts(const ArmRequest& request) const {
    constexpr std::size_t day_letters = 10;
    const MonotonicTime now = scheduler_.now();
    const ChannelFacts seen = channels();
    PreflightFacts facts{
        config_,
        now,
        iso8601_utc(scheduler_.clock_tie().utc_ns).substr(0, day_letters),
        stated(request, "state", config_.statements.state),
        stated(request, "control_compensation", config_.statements.control_compensation),
        {},
        {},
        {},
        {},
        {},
        {}};
    if (config_.axis.angle)
        facts.run_out = stated(request, "run_out", config_.axis.angle->setup.run_out);
    facts.boot_known = boot_id_.known();
    facts.newest_run = tests_.newest().run_id;
    if (!facts.newest_run.empty())
        facts.newest_run_day = iso8601_utc(tests_.newest().opened_utc_ns).substr(0, day_letters);
    facts.may_sleep = sleep_lock_.refusal();
    facts.polygon = reads_polygon();
    facts.circular = takes_circles(request);
    std::vector<int> roles = facts.circular ? roles_.of_circles() : roles_.environment();
    for (const int id : roles)
        facts.sensors.push_back(seen.sensor(id, now));
    const std::optional<int> length_id = facts.circular ? roles_.ballbar : roles_.laser;
    if (length_id) roles.push_back(*length_id);
    if (const auto id = autocollimator_for(facts)) roles.push_back(*id);
    const auto views = supervisor_.view();
    for (const int id : roles) {
        const StationChannel& channel = channel_of(id);
        const auto& name = channel.instrument_name;
        if (std::ranges::find(facts.in_use, name) != facts.in_use.end()) continue;
        facts.in_use.push_back(name);
        if (const auto& serial = supervisor_.identity(channel.instrument).serial; !serial.empty())
            facts.serials[name] = serial;
        const auto& view = views[static_cast<std::size_t>(channel.instrument)];
        // An autocollimator between two faces has no good reading, and is there all the same.
        const bool there = view.state == InstrumentState::available ||
                           (id == roles_.autocollimator && view.state == InstrumentState::faulty);
        if (!there) facts.unavailable.push_back(name);
    }
    if (!length_id) return facts;
    const int seat = channel_of(*length_id).instrument;
    for (const StationChannel& channel : supervisor_.channels())
        if (channel.kind == ChannelKind::strength && channel.instrument == seat)
            facts.strengths.push_back(seen.sensor(channel.id, now));
    if (facts.circular) {
        if (const auto& reading = readings_.latest(*length_id)) facts.bar_age = now - reading->at;
        facts.bar = &readings_.log_of(*length_id);
        return facts;
    }
    if (const auto reading = readings_.reference().newest(); reading && reading->value())
        facts.laser_age = now - reading->at;
    facts.laser_samples = readings_.reference().between(now - drift_reach(config_.preflight), now);
    const auto within = readings_.reference().between(now - config_.preflight.drift_window, now);
    facts.laser_range = metre(readings_.reference().summary_of(within).spread_m());
    return facts;
}

Result<std::vector<PreflightRecord>> Station::judge(const ArmRequest& request,
                                                    const std::optional<FoundEve>& eve) const {
    PreflightFacts facts = preflight_facts(request);
    if (eve) {
        AXISCAL_TRY(facts.eve, eve_facts(request, *eve));
    }
    auto checks = judge_preflight(facts);
    AXISCAL_CHECK(override_checks(checks, request.overrides));
    return checks;
}

/// Where the drift test is missing its check fails, and no reason helps: arming finds no E_VE.
Task<Result<std::vector<PreflightRecord>>> Station::preflight(ArmRequest request) {
    const auto eve = co_await eve_for(takes_circles(request));
    if (eve) co_return judge(request, *eve);
    PreflightFacts facts = preflight_facts(request);
    facts.eve.emplace().why_not = eve.error().detail;
    auto checks = judge_preflight(facts);
    if (auto kept = override_checks(checks, request.overrides); !kept)
        co_return tl::unexpected<Error>(kept.error());
    co_return checks;
}

} // namespace axiscal
