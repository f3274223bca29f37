#include "acquisition/console/pairing_json.hpp"

#include "acquisition/console/api_json.hpp"
#include "config/measure.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

/// An object that has no other keys than these.
Result<Json> parse_pairing(const std::string& body, const std::vector<std::string>& known) {
    Json parsed = Json::parse(body.empty() ? "{}" : body, nullptr, false);
    if (!parsed.is_object()) return refuse(Fault::bad_request, "body", "must be a JSON object");
    std::string list;
    for (const std::string& key : known)
        list += (list.empty() ? "" : ", ") + key;
    for (const auto& [key, value] : parsed.items())
        if (std::ranges::find(known, key) == known.end())
            return refuse(Fault::bad_request, key,
                          "is unknown; known: " + list + did_you_mean(key, known));
    return parsed;
}

Result<std::string> page_name_of(const Json& value) {
    auto name = name_of_orderer(value);
    if (!name) name.error().field = "name";
    return name;
}

bool is_digit(char letter) {
    return letter >= '0' && letter <= '9';
}

} // namespace

Result<std::string> pair_request_from_json(const std::string& body) {
    AXISCAL_TRY(const Json parsed, parse_pairing(body, {"name"}));
    if (!parsed.contains("name")) return std::string{};
    return page_name_of(parsed["name"]);
}

Result<std::string> session_request_from_json(const std::string& body) {
    AXISCAL_TRY(const Json parsed, parse_pairing(body, {"code"}));
    if (!parsed.contains("code"))
        return refuse(Fault::bad_request, "code", "is missing: 'axiscal pair' shows it");
    const auto* text = parsed["code"].get_ptr<const Json::string_t*>();
    std::string digits = text == nullptr ? std::string{} : *text;
    std::erase(digits, ' ');
    if (digits.size() == 8 && std::ranges::all_of(digits, is_digit)) return digits;
    return refuse(Fault::bad_request, "code", "must be the eight digits that 'axiscal pair' shows");
}

Result<EndOrder> end_request_from_json(const std::string& body) {
    AXISCAL_TRY(const Json parsed, parse_pairing(body, {"name", "all"}));
    const bool all = parsed.contains("all") && parsed["all"] == true;
    if (parsed.contains("all") && !all) return refuse(Fault::bad_request, "all", "must be true");
    if (all == parsed.contains("name"))
        return refuse(Fault::bad_request, "name", "or all is needed, one of them");
    if (all) return EndOrder{};
    AXISCAL_TRY(std::string name, page_name_of(parsed["name"]));
    return EndOrder{std::move(name)};
}

Json offer_json(const PairingCode& code, const std::string& page, const std::string& sentence) {
    return {{"code", code.digits},
            {"name", code.name},
            {"until_utc", iso8601_utc(code.until_utc_ns)},
            {"page", page},
            {"sentence", sentence}};
}

Json paired_json(const std::vector<PairedBrowser>& paired) {
    Json list = Json::array();
    for (const PairedBrowser& browser : paired) {
        const auto& last = browser.last_order_utc_ns;
        list.push_back({{"name", browser.name},
                        {"since_utc", iso8601_utc(browser.since_utc_ns)},
                        {"last_order_utc", last ? iso8601_utc(*last) : std::string{}},
                        {"until_utc", iso8601_utc(browser.until_utc_ns())}});
    }
    return {{"paired", std::move(list)}};
}

Json session_json(const PairedBrowser* browser) {
    if (browser == nullptr)
        return {{"paired", false},
                {"how", "Type 'axiscal pair' at the station and enter the code here."}};
    return {{"paired", true},
            {"name", browser->name},
            {"until_utc", iso8601_utc(browser->until_utc_ns())}};
}

} // namespace axiscal
