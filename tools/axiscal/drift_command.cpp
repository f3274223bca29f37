#include "tools/axiscal/drift_command.hpp"

#include "config/json_text.hpp"
#include "config/measure.hpp"
#include "tools/axiscal/daemon_reply.hpp"
#include "tools/axiscal/exit_code.hpp"

#include <nlohmann/json.hpp>

#include <chrono>
#include <iostream>
#include <thread>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

constexpr auto look_every = std::chrono::milliseconds{250};

/// "30 min" into `body`; false after a sentence on standard error.
bool put_span(Json& body, const char* key, const std::string& words, const char* option) {
    const auto span = read_measure(words, duration_measure);
    if (span) return body[key] = span->si, true;
    std::cerr << option << ": " << span.error().detail << "\n";
    return false;
}

int outcome_of(const Json& drift, bool json) {
    if (json) std::cout << json_text(drift) << "\n";
    const bool complete = drift.at("state") == "complete";
    const std::string certificate = drift.at("certificate"), sentence = drift.at("sentence");
    if (!json)
        std::cout << "Drift test " << drift.at("id").get<std::string>() << " is "
                  << drift.at("state").get<std::string>()
                  << (certificate.empty() ? "" : "; certificate in " + certificate)
                  << (sentence.empty() ? "" : ": " + sentence) << "\n";
    if (!complete) return exit_incomplete;
    return certificate.empty() ? exit_failed : exit_ok;
}

int wait_for_end(const StationClient& client, const std::string& run_id, bool json) {
    for (;;) {
        const auto reply = client.get("/v1/status");
        if (!reply) return tell_no_contact(reply.error());
        if (reply->status >= 300) return tell_refusal(*reply);
        const Json drift = Json::parse(reply->body).at("drift");
        if (drift.is_null() || drift.at("id") != run_id) {
            std::cerr << "The station knows nothing of " << run_id << " any more.\n";
            return exit_incomplete;
        }
        const bool over = drift.at("state") == "incomplete" ||
                          (drift.at("state") == "complete" &&
                           (drift.at("certificate") != "" || drift.at("sentence") != ""));
        if (over) return outcome_of(drift, json);
        std::this_thread::sleep_for(look_every);
    }
}

} // namespace

int command_drift(const StationClient& client, const DriftOrder& order, bool json) {
    Json body{{"statements", order.statements}};
    if (!put_span(body, "duration_s", order.duration, "--duration") ||
        !put_span(body, "interval_s", order.interval, "--interval"))
        return exit_usage;
    if (!order.of.empty()) body["of"] = order.of;
    if (!order.by.empty()) body["by"] = order.by;
    if (order.place_mm) body["place_mm"] = *order.place_mm;
    const auto reply = client.post("/v1/drift", json_text(body));
    if (!order.wait)
        return show_reply(reply, json, [](const Json& begun) {
            return "Drift test " + begun.at("run").get<std::string>() +
                   " has begun: leave the machine alone. 'axiscal status' shows it.\n";
        });
    if (!reply) return tell_no_contact(reply.error());
    if (reply->status >= 300) return tell_refusal(*reply);
    return wait_for_end(client, Json::parse(reply->body).at("run"), json);
}

} // namespace axiscal
