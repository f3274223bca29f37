#include "acquisition/measurement/preflight_facts.hpp"

#include "acquisition/live/channel_facts.hpp"
#include "acquisition/live/live_readings.hpp"
#include "acquisition/live/roles.hpp"
#include "acquisition/live/supervisor.hpp"
#include "acquisition/measurement/latest_tests.hpp"
#include "acquisition/measurement/measurement_kind.hpp"
#include "acquisition/measurement/positioning/axis_instruments.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

namespace axiscal {
namespace {

ChannelFacts channels_now(const OrderContext& context) {
    return {context.config, context.roles, context.instruments, context.readings};
}

/// ISO date.
std::string day_of(std::int64_t utc_ns) {
    constexpr std::size_t day_letters = 10;
    return iso8601_utc(utc_ns).substr(0, day_letters);
}

/// As make_run_header will take it: what a person says at arming goes before the station file.
std::string said_or_stated(const ArmRequest& request,
                           const std::string& key,
                           const std::string& in_station_file) {
    const auto said = request.statements.find(key);
    return said == request.statements.end() ? in_station_file : said->second;
}

/// Whatever the kind of test.
PreflightFacts facts_of_station(const OrderContext& context, const ArmRequest& request) {
    const StationConfig& config = context.config;
    const Statements& statements = config.statements;
    PreflightFacts facts{
        config,
        context.scheduler.now(),
        day_of(context.scheduler.clock_tie().utc_ns),
        said_or_stated(request, "state", statements.state),
        said_or_stated(request, "control_compensation", statements.control_compensation),
        {},
        {},
        {},
        {},
        {},
        {}};
    if (config.axis.angle)
        facts.run_out = said_or_stated(request, "run_out", config.axis.angle->setup.run_out);
    facts.boot_known = context.boot_id.known();
    const LatestTests::Newest& newest = context.tests.newest();
    facts.newest_run = newest.run_id;
    if (!newest.run_id.empty()) facts.newest_run_day = day_of(newest.opened_utc_ns);
    facts.may_sleep = context.may_sleep;
    facts.polygon = reads_polygon(config);
    return facts;
}

/// An autocollimator between two faces has no good reading, and is there all the same.
bool is_there(const OrderContext& context, int channel, InstrumentState state) {
    return state == InstrumentState::available ||
           (channel == context.roles.autocollimator && state == InstrumentState::faulty);
}

/// Each once, by the first of its channels.
void add_instruments(const OrderContext& context,
                     const std::vector<int>& channels,
                     PreflightFacts& facts) {
    const auto views = context.instruments.view();
    for (const int id : channels) {
        const StationChannel& channel = context.instruments.channel(id);
        const std::string& name = channel.instrument_name;
        if (std::ranges::find(facts.in_use, name) != facts.in_use.end()) continue;
        facts.in_use.push_back(name);
        const std::string& serial = context.instruments.identity(channel.instrument).serial;
        if (!serial.empty()) facts.serials[name] = serial;
        const auto& view = views[static_cast<std::size_t>(channel.instrument)];
        if (!is_there(context, id, view.state)) facts.unavailable.push_back(name);
    }
}

} // namespace

void add_sensors(const OrderContext& context,
                 const std::vector<int>& channels,
                 PreflightFacts& facts) {
    const ChannelFacts seen = channels_now(context);
    for (const int id : channels)
        facts.sensors.push_back(seen.sensor(id, facts.now));
}

void add_strengths(const OrderContext& context, int length, PreflightFacts& facts) {
    const ChannelFacts seen = channels_now(context);
    const int seat = context.instruments.channel(length).instrument;
    for (const StationChannel& channel : context.instruments.channels())
        if (channel.kind == ChannelKind::strength && channel.instrument == seat)
            facts.strengths.push_back(seen.sensor(channel.id, facts.now));
}

PreflightFacts preflight_facts(const OrderContext& context, const ArmRequest& request) {
    PreflightFacts facts = facts_of_station(context, request);
    const MeasurementKind& kind = kind_row(kind_that_is_checked(context, request));
    add_instruments(context, kind.add_facts(context, facts), facts);
    return facts;
}

} // namespace axiscal
