#include "tools/axiscal/pair_command.hpp"

#include "analysis/quantity/counted.hpp"
#include "config/json_text.hpp"
#include "tools/axiscal/daemon_reply.hpp"

#include <nlohmann/json.hpp>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

/// "12345678" as a person reads it out.
std::string shown_code(const std::string& digits) {
    return digits.size() == 8 ? digits.substr(0, 4) + " " + digits.substr(4) : digits;
}

std::string offer_text(const Json& offer) {
    const std::string page = offer.at("page"), sentence = offer.at("sentence");
    std::string text = "Code:  " + shown_code(offer.at("code").get<std::string>()) +
                       "   counts once, until " + offer.at("until_utc").get<std::string>() + "\n";
    if (!page.empty()) text += "Page:  " + page + "\n";
    text += "The browser that enters it may order; what it orders is logged as \"" +
            offer.at("name").get<std::string>() + "\".\n";
    return sentence.empty() ? text : text + sentence + "\n";
}

std::string list_text(const Json& answer) {
    const Json& paired = answer.at("paired");
    if (paired.empty()) return "No browser is paired.\n";
    std::string text;
    for (const Json& browser : paired) {
        const std::string last = browser.at("last_order_utc");
        text += browser.at("name").get<std::string>() + ": since " +
                browser.at("since_utc").get<std::string>() + ", last order " +
                (last.empty() ? "none" : last) + "\n";
    }
    return text;
}

std::string ended_text(const Json& answer) {
    return counted(answer.at("ended").get<long>(), "pairing is", "pairings are") + " ended.\n";
}

} // namespace

int command_pair(const StationClient& client, const PairOrder& order, bool json) {
    if (order.list) return show_reply(client.get("/v1/pair"), json, list_text);
    Json body = Json::object();
    if (order.end_all || order.end_name) {
        if (order.end_all)
            body["all"] = true;
        else
            body["name"] = *order.end_name;
        return show_reply(client.post("/v1/pair/end", json_text(body)), json, ended_text);
    }
    if (!order.name.empty()) body["name"] = order.name;
    return show_reply(client.post("/v1/pair", json_text(body)), json, offer_text);
}

} // namespace axiscal
