#include "drivers/laser/ids_message.hpp"

#include "config/json_text.hpp"
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>

namespace axiscal {
namespace {

using Json = nlohmann::json;

/// Air is at least 2.2e-4 away from 1 anywhere on earth where people work; 1e-9 of a metre is 1 nm.
constexpr double one_within = 1e-9;

std::optional<IdsValue> value_of(const Json& node) {
    if (node.is_boolean()) return node.get<bool>();
    if (node.is_number_integer()) return node.get<std::int64_t>();
    if (node.is_number()) return node.get<double>();
    if (node.is_string()) return node.get<std::string>();
    return std::nullopt;
}

std::string words_of(const Json& error) {
    const bool has_text =
        error.is_object() && error.contains("message") && error["message"].is_string();
    return has_text ? error["message"].get<std::string>() : json_text(error);
}

std::string written(double index) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9f", index);
    return text;
}

} // namespace

std::string
ids_request(std::string_view method, const std::vector<int>& parameters, std::int64_t id) {
    // In the order in which the maker's own programs write it.
    const nlohmann::ordered_json request{
        {"jsonrpc", "2.0"}, {"method", method}, {"params", parameters}, {"id", id}, {"api", 2}};
    return json_text(request) + "\n";
}

Result<IdsReply> parse_ids_reply(std::string_view line) {
    const Json root = Json::parse(line, nullptr, false);
    const bool reply = root.is_object() && root.contains("id") && root["id"].is_number_integer();
    if (!reply) return fail(Fault::bad_frame, "no reply of an IDS");
    if (root.contains("error"))
        return fail(Fault::refused, "the IDS refuses: " + words_of(root["error"]));
    const auto result = root.find("result");
    if (result == root.end() || !result->is_array() || result->empty() ||
        !result->front().is_number_integer())
        return fail(Fault::bad_frame, "a reply whose result is no list with an error number");
    IdsReply found{root["id"].get<std::int64_t>(), result->front().get<std::int64_t>(), {}};
    for (std::size_t i = 1; i < result->size(); ++i) {
        auto value = value_of((*result)[i]);
        if (!value) return fail(Fault::bad_frame, "a result that is no number, text or flag");
        found.values.push_back(*std::move(value));
    }
    return found;
}

std::optional<double> number_of(const IdsReply& reply, std::size_t place) {
    if (place >= reply.values.size()) return std::nullopt;
    if (const auto* whole = std::get_if<std::int64_t>(&reply.values[place]))
        return static_cast<double>(*whole);
    const auto* real = std::get_if<double>(&reply.values[place]);
    return real && std::isfinite(*real) ? std::optional{*real} : std::nullopt;
}

std::optional<std::int64_t> whole_number_of(const IdsReply& reply, std::size_t place) {
    if (place >= reply.values.size()) return std::nullopt;
    if (const auto* flag = std::get_if<bool>(&reply.values[place])) return *flag ? 1 : 0;
    const auto* whole = std::get_if<std::int64_t>(&reply.values[place]);
    return whole ? std::optional{*whole} : std::nullopt;
}

std::string text_of(const IdsReply& reply, std::size_t place) {
    if (place >= reply.values.size()) return {};
    if (const auto* text = std::get_if<std::string>(&reply.values[place])) return *text;
    const auto whole = whole_number_of(reply, place);
    return whole ? std::to_string(*whole) : std::string{};
}

std::string correction_of_its_own(const IdsCompensation& found) {
    const bool divides = !(std::abs(found.index - 1) <= one_within);
    if (divides)
        return "the IDS divides by a refractive index of " + written(found.index) +
               " itself, and the air is corrected here: it would be corrected twice. Set its index "
               "to 1 by hand (compensation mode 2)";
    if (found.mode == 0 && found.unit_connected)
        return "the IDS follows its environment unit: its index is 1 now and will not stay so. Set "
               "compensation mode 2 with index 1";
    return {};
}

} // namespace axiscal
