// E_VE of a drift test, carried to the budget of later runs.
#include "acquisition/station/station.hpp"

#include "acquisition/run/cycle_plan.hpp"
#include "acquisition/runfile/run_file.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace axiscal {
namespace {

/// E_VE of a sealed test, one millimetre for one degree of a rotary axis. Nothing where the test
/// was of an axis of the other kind.
std::optional<Length> eve_of(const nlohmann::json& document, AxisKind kind) {
    const nlohmann::json::json_pointer place{"/parameters/E_VE/value"};
    if (!document.is_object() || !document.contains(place) || !document[place].is_number())
        return std::nullopt;
    const double value = document[place].get<double>();
    const bool angle = kind == AxisKind::rotary;
    const nlohmann::json stated = document.value("unit", nlohmann::json("um"));
    if (stated != (angle ? "arcsec" : "um") || value < 0) return std::nullopt;
    constexpr double arcsec_per_degree = 3600;
    return angle ? mm(value / arcsec_per_degree) : um(value);
}

/// How many readings of a sealed test became no coordinate: those may have been its extremes.
/// Tests sealed before this was counted state none.
int refused_readings_in(const nlohmann::json& document) {
    const auto stated = document.is_object() ? document.find("refused_readings") : document.end();
    return stated != document.end() && stated->is_number_integer() ? stated->get<int>() : 0;
}

} // namespace

Task<Result<Station::FoundEve>> Station::find_eve(WantedDrift wanted, AxisKind kind) {
    const auto found = co_await journal_.find_drift(runs_folder(), wanted);
    if (!found) co_return tl::unexpected<Error>(found.error());
    const auto document = nlohmann::json::parse(found->document, nullptr, false);
    if (const int refused = refused_readings_in(document); refused > 0)
        co_return fail(Fault::refused,
                       "the drift test " + found->run_id + " could not evaluate " +
                           std::to_string(refused) +
                           " of its readings, so that its E_VE may be too small: make another by " +
                           wanted.order() + ", or name a good one in " + wanted.key());
    const std::optional<Length> eve = eve_of(document, kind);
    if (!eve)
        co_return fail(Fault::bad_run_file, "the drift test " + found->run_id +
                                                " states no E_VE in the unit of this " +
                                                (wanted.of_bar ? "ballbar" : "axis"));
    co_return FoundEve{*eve, found->run_id, found->duration, found->place};
}

bool Station::takes_circles(const ArmRequest& request) const {
    const bool asked = request.pass == circular_pass || (!roles_.laser && !reads_polygon());
    return asked && roles_.ballbar && config_.circular;
}

Task<Result<std::optional<Station::FoundEve>>> Station::eve_for(bool circles) {
    WantedDrift wanted{circles ? config_.circular->eve_run : config_.eve_run, circles, {}};
    if (wanted.which.empty()) co_return std::optional<FoundEve>{};
    const std::string& stated = config_.statements.axis;
    const std::string& axis = stated.empty() ? config_.axis.name : stated;
    wanted.of = circles ? shown_name_of(*roles_.ballbar) : axis;
    const AxisKind kind = circles ? AxisKind::linear : config_.cycle.axis_kind;
    AXISCAL_CO_TRY(FoundEve found, co_await find_eve(std::move(wanted), kind));
    co_return std::optional{std::move(found)};
}

Result<EveFacts> Station::eve_facts(const ArmRequest& request, const FoundEve& found) const {
    EveFacts facts;
    facts.run_id = found.run_id;
    facts.lasted = found.lasted;
    const bool circles = takes_circles(request);
    facts.order = WantedDrift{{}, circles, {}}.order();
    if (circles) {
        facts.run_takes = least_time_of(config_.circular->setup.plan);
        return facts;
    }
    AXISCAL_TRY(const RunPlan plan, plan_for(request));
    facts.run_takes = least_time_of(plan, config_.cycle.feed, config_.cycle.dwell);
    facts.rest = found.rest;
    facts.angle = plan.axis_kind == AxisKind::rotary;
    if (facts.angle || config_.axis.scale) return facts;
    const Length dead = config_.axis.dead_path;
    facts.beam = dead + abs(found.rest - plan.datum);
    facts.longest_beam = dead;
    for (const Length target : plan.targets)
        facts.longest_beam = std::max(*facts.longest_beam, dead + abs(target - plan.datum));
    return facts;
}

} // namespace axiscal
