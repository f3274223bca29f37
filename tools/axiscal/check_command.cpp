// `axiscal check-config`: what the station file means, or every refusal with its line.
#include "acquisition/events/webhook_signature.hpp"
#include "acquisition/station/station_loader.hpp"
#include "acquisition/tls/tls_judgement.hpp"
#include "analysis/quantity/counted.hpp"
#include "config/certificate_dates.hpp"
#include "config/json_text.hpp"
#include "tools/axiscal/complaint.hpp"
#include "tools/axiscal/exit_code.hpp"
#include "tools/axiscal/offline_commands.hpp"

#include <nlohmann/json.hpp>

#include <chrono>
#include <iostream>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

std::int64_t now_utc_ns() {
    return std::chrono::nanoseconds{std::chrono::system_clock::now().time_since_epoch()}.count();
}

/// ISO date, UTC.
std::string today() {
    return iso8601_utc(now_utc_ns()).substr(0, 10);
}

/// Which channels play the parts that the file leaves to their kind.
Json roles_by_kind(const AxisConfig& axis) {
    Json roles = Json::object();
    const auto add = [&](const std::string& key, const RoleConfig& role) {
        if (role.by_kind) roles[key].push_back(role.instrument + "/" + role.channel);
    };
    add("axis.laser", axis.laser);
    add("axis.air.temperature", axis.air_temperature);
    add("axis.air.pressure", axis.air_pressure);
    add("axis.air.humidity", axis.air_humidity);
    for (const RoleConfig& role : axis.material_temperature)
        add("axis.material.temperature", role);
    return roles;
}

void print_roles(const Json& roles) {
    for (const auto& [key, channels] : roles.items()) {
        std::string list;
        for (const Json& channel : channels)
            list += (list.empty() ? "" : ", ") + channel.get<std::string>();
        std::cout << key << ": " << list << "\n";
    }
}

/// What is wrong with the file of the webhook's secret, as far as this user may read it.
void add_note_on_secret(const StationConfig& config, std::vector<Refusal>& notes) {
    if (!config.webhook) return;
    const auto keys = read_webhook_secret(config.webhook->secret_file);
    if (!keys && keys.error().cause != std::errc::permission_denied)
        notes.push_back({config.file, config.webhook->line, "webhook.secret_file",
                         "nothing can be signed: " + describe(keys.error())});
}

} // namespace

int command_check_config(const std::string& station_file, bool json) {
    const auto station = load_station(station_file);
    if (!station) return complain(station.error(), json);
    TlsJudgement tls = judge_tls(station->config, now_utc_ns());
    if (!tls.refusals.empty()) return complain(tls.refusals, json);
    Json warnings = Json::array();
    std::vector<Refusal> notes = station->config.warnings;
    for (Refusal& note : expired_certificates(station->config, today()))
        notes.push_back(std::move(note));
    for (Refusal& note : tls.notes)
        notes.push_back(std::move(note));
    add_note_on_secret(station->config, notes);
    for (const Refusal& warning : notes) {
        warnings.push_back(warning.describe());
        if (!json) std::cout << "note: " << warning.describe() << "\n";
    }
    Json roles = roles_by_kind(station->config.axis);
    if (!json) print_roles(roles);
    Json passes = Json::array();
    for (const RunPlan& plan : station->passes) {
        passes.push_back({{"pass", plan.pass},
                          {"targets", plan.targets.size()},
                          {"approaches", plan.approaches},
                          {"points", plan.points.size()},
                          {"remark", plan.remark}});
        if (!json)
            std::cout << "pass " << plan.pass << ": "
                      << counted(static_cast<long>(plan.targets.size()), "target") << ", "
                      << counted(static_cast<long>(plan.points.size()), "point")
                      << (plan.remark.empty() ? "" : "; " + plan.remark) << "\n";
    }
    if (json)
        std::cout << json_text(Json{{"refusals", Json::array()},
                                    {"notes", std::move(warnings)},
                                    {"roles", std::move(roles)},
                                    {"passes", std::move(passes)}})
                  << "\n";
    else
        std::cout << station_file << " is accepted.\n";
    return exit_ok;
}

} // namespace axiscal
