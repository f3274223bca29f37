#include "acquisition/console/api_json.hpp"
#include "config/measure.hpp"
#include "config/settings.hpp"

#include "analysis/quantity/valid_text.hpp"
#include "analysis/record/test_kind.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array statement_keys{"certificate_number",
                                    "customer",
                                    "place",
                                    "operator",
                                    "approver",
                                    "procedure",
                                    "state",
                                    "warm_up",
                                    "offsets",
                                    "idle_axes",
                                    "sensor_note",
                                    "next_due",
                                    "control_compensation",
                                    "run_out"};

tl::unexpected<Error> refuse_statement(const std::string& key) {
    const std::vector<std::string> words{statement_keys.begin(), statement_keys.end()};
    std::string list;
    for (const std::string& word : words)
        list += (list.empty() ? "" : ", ") + word;
    const std::string near = did_you_mean(key, words);
    return refuse(Fault::bad_request, "statements." + key,
                  "is not a statement" + (near.empty() ? "." : near) + " There are: " + list + ".");
}

/// What a person writes and a certificate prints. @errors bad_request naming the field
Result<std::string> printed_text(const std::string& field, const Json& given) {
    constexpr std::size_t longest = 1000; // some twelve lines of the certificate in Latin letters
    const auto* text = given.get_ptr<const std::string*>();
    if (text == nullptr) return refuse(Fault::bad_request, field, "must be a text");
    if (text->size() > longest)
        return refuse(Fault::bad_request, field,
                      "has " + std::to_string(text->size()) + " bytes, and there is room for " +
                          std::to_string(longest));
    return valid_text(*text);
}

Result<void> read_printed(const std::string& field, const Json& given, std::string& text) {
    AXISCAL_TRY(text, printed_text(field, given));
    return {};
}

Result<void> read_statements(const Json& given, ArmRequest& request) {
    if (!given.is_object())
        return refuse(Fault::bad_request, "statements", "must be an object of texts");
    for (const auto& [key, value] : given.items()) {
        if (std::ranges::find(statement_keys, key) == statement_keys.end())
            return refuse_statement(key);
        AXISCAL_TRY(const std::string text, printed_text("statements." + key, value));
        if (key == "next_due" && !text.empty() && text != "none" && !is_calendar_date(text))
            return refuse(Fault::bad_request, "statements.next_due",
                          "is no date: write year-month-day, for example 2027-11-21, or none");
        request.statements[key] = text;
    }
    return {};
}

/// @param wanted  "must be an object of reasons by check"
Result<void> read_texts(const std::string& key,
                        const Json& given,
                        std::string wanted,
                        std::map<std::string, std::string>& texts) {
    if (!given.is_object()) return refuse(Fault::bad_request, key, std::move(wanted));
    for (const auto& [name, text] : given.items()) {
        AXISCAL_CHECK(read_printed(key + "." + name, text, texts[name]));
    }
    return {};
}

Result<void> read_orderer(const Json& value, Orderer& by) {
    AXISCAL_TRY(by.name, name_of_orderer(value));
    return {};
}

/// To people each kind of test is one of the passes; only here it is told from those of the axis.
void read_pass(const std::string& pass, ArmRequest& request) {
    request.pass = valid_text(pass);
    request.kind = kind_named(request.pass).value_or(TestKind::positioning);
}

/// A field of an order, as it is told to who wrote another one. `wanted` is for a value that
/// nothing else refuses; empty: its own reader says what is wrong.
struct OrderField {
    std::string_view name, wanted;
};
constexpr std::array arm_fields{
    OrderField{"datum_mm", "must be a number: where the axis stands"},
    OrderField{"pass", "must be a text"},
    OrderField{"seed",
               "must be a whole number from 0 on: the part program has it in its first line"},
    OrderField{"datum_by_cnc", "must be true or false"},
    OrderField{"statements", ""},
    OrderField{"overrides", ""},
    OrderField{"options", ""},
    OrderField{"by", ""}};
constexpr std::array revision_fields{
    OrderField{"target", "must be a whole number from 0 to 100000"},
    OrderField{"direction", "must be positive or negative"},
    OrderField{"cycle", "must be a whole number from 0 to 100000"}, OrderField{"reason", ""},
    OrderField{"by", ""}};

tl::unexpected<Error> refuse_field(const std::string& key, std::span<const OrderField> fields) {
    std::vector<std::string> names;
    std::string list;
    for (const auto& [name, wanted] : fields) {
        if (name == key) return refuse(Fault::bad_request, key, std::string{wanted});
        names.emplace_back(name);
        list += (list.empty() ? "" : ", ") + names.back();
    }
    return refuse(Fault::bad_request, key,
                  "is unknown; known are " + list + did_you_mean(key, names));
}

Result<void> read_arm_field(const std::string& key, const Json& value, ArmRequest& request) {
    if (key == "datum_mm" && value.is_number())
        return request.datum_mm = value.get<double>(), Result<void>{};
    if (key == "pass" && value.is_string())
        return read_pass(value.get<std::string>(), request), Result<void>{};
    if (key == "seed" && value.is_number_unsigned())
        return request.seed = value.get<std::uint64_t>(), Result<void>{};
    if (key == "datum_by_cnc" && value.is_boolean())
        return request.datum_by_cnc = value.get<bool>(), Result<void>{};
    if (key == "statements") return read_statements(value, request);
    if (key == "overrides")
        return read_texts(key, value, "must be an object of reasons by check", request.overrides);
    if (key == "options")
        return read_texts(key, value, "must be an object of texts by name", request.options);
    if (key == "by") return read_orderer(value, request.by);
    return refuse_field(key, arm_fields);
}

Result<Json> parse_object(const std::string& body) {
    Json parsed = Json::parse(body.empty() ? "{}" : body, nullptr, false);
    if (parsed.is_discarded()) return refuse(Fault::bad_request, "body", "is not JSON");
    if (!parsed.is_object()) return refuse(Fault::bad_request, "body", "must be a JSON object");
    return parsed;
}

} // namespace

Result<std::string> name_of_orderer(const nlohmann::ordered_json& value) {
    constexpr std::size_t longest = 80;
    const auto* name = value.get_ptr<const std::string*>();
    const bool plain = name != nullptr && name->size() <= longest &&
                       name->find_first_not_of(' ') != std::string::npos &&
                       *name == valid_text(*name);
    if (plain) return *name;
    return refuse(Fault::bad_request, "by", "must be a name: one line of 1 to 80 bytes");
}

Result<ArmRequest> arm_request_from_json(const std::string& body) {
    AXISCAL_TRY(const Json parsed, parse_object(body));
    ArmRequest request;
    for (const auto& [key, value] : parsed.items())
        AXISCAL_CHECK(read_arm_field(key, value, request));
    return request;
}

namespace {

Result<void>
read_revision_field(const std::string& key, const Json& value, RevisionRequest& request) {
    constexpr std::int64_t most = 100'000;
    const bool index = value.is_number_integer() && value.get<std::int64_t>() >= 0 &&
                       value.get<std::int64_t>() <= most;
    if (key == "target" && index)
        return request.selection.target = value.get<int>(), Result<void>{};
    if (key == "cycle" && index)
        return request.selection.approach = value.get<int>(), Result<void>{};
    if (key == "direction" && (value == "positive" || value == "negative")) {
        request.selection.direction =
            value == "positive" ? Direction::positive : Direction::negative;
        return {};
    }
    if (key == "reason") return read_printed(key, value, request.reason);
    if (key == "by") return read_orderer(value, request.by);
    return refuse_field(key, revision_fields);
}

} // namespace

Result<RevisionRequest> revision_request_from_json(const std::string& body) {
    AXISCAL_TRY(const Json parsed, parse_object(body));
    RevisionRequest request;
    for (const auto& [key, value] : parsed.items())
        AXISCAL_CHECK(read_revision_field(key, value, request));
    if (request.reason.find_first_not_of(" \t\r\n") == std::string::npos)
        return refuse(Fault::bad_request, "reason", "is missing: it is printed on the certificate");
    return request;
}

Result<AnswerRequest> answer_request_from_json(const std::string& body) {
    AXISCAL_TRY(const Json parsed, parse_object(body));
    AnswerRequest request;
    for (const auto& [key, value] : parsed.items()) {
        if (key == "by") {
            AXISCAL_CHECK(read_orderer(value, request.by));
            continue;
        }
        if (key != "finding" && key != "text")
            return refuse(Fault::bad_request, key,
                          "is unknown; known are finding, text, by" +
                              did_you_mean(key, {"finding", "text", "by"}));
        AXISCAL_CHECK(read_printed(key, value, key == "text" ? request.text : request.finding));
    }
    if (request.finding.empty())
        return refuse(Fault::bad_request, "finding",
                      "is missing: which of the findings about the set-up is answered");
    if (request.text.find_first_not_of(" \t\r\n") == std::string::npos)
        return refuse(Fault::bad_request, "text", "is missing: it is printed on the certificate");
    return request;
}

Result<double> typed_reading_from_json(const std::string& body) {
    AXISCAL_TRY(const Json parsed, parse_object(body));
    for (const auto& [key, value] : parsed.items())
        if (key != "arcsec" || !value.is_number())
            return refuse(Fault::bad_request, key,
                          key == "arcsec" ? "must be a number" : "is unknown; known is arcsec");
    if (!parsed.contains("arcsec"))
        return refuse(Fault::bad_request, "arcsec", "is missing: what the autocollimator reads");
    return parsed["arcsec"].get<double>();
}

Result<AbortRequest> abort_request_from_json(const std::string& body) {
    AXISCAL_TRY(const Json parsed, parse_object(body));
    AbortRequest request;
    if (parsed.contains("by")) {
        AXISCAL_TRY(request.by, name_of_orderer(parsed["by"]));
    }
    if (!parsed.contains("reason")) return request;
    AXISCAL_CHECK(read_printed("reason", parsed["reason"], request.reason));
    return request;
}

} // namespace axiscal
