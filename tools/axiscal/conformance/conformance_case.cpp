#include "tools/axiscal/conformance/conformance_case.hpp"

#include "tools/axiscal/case_text.hpp"
#include "tools/axiscal/cases/case_reader.hpp"

#include <algorithm>
#include <utility>

namespace axiscal {
namespace {

using nlohmann::json;

Result<std::string> filled_text(const json& object, const char* key, const std::string& field) {
    AXISCAL_TRY(std::string text, text_of(object, key, field));
    if (text.empty()) return refuse(Fault::bad_case, field, "must not be empty");
    return text;
}

Result<double> bound_of(const json& value, const std::string& field) {
    AXISCAL_TRY(const double bound, number_of(value, field));
    if (bound < 0) return refuse(Fault::bad_case, field, "must not be negative");
    return bound;
}

/// A typical size of the figures; without one, `missing`.
Result<double> scale_of(const json& object, const std::string& field, double missing) {
    return object.contains("scale") ? bound_of(object.at("scale"), field) : Result<double>{missing};
}

Result<std::string> pointer_at(const json& object, const std::string& field) {
    AXISCAL_TRY(std::string pointer, filled_text(object, "at", field));
    try {
        const json::json_pointer checked{pointer};
    } catch (const json::exception&) {
        return refuse(Fault::bad_case, field, "is no JSON pointer, as \"/parameters/E/value\"");
    }
    return pointer;
}

Result<void> read_number(const json& object, const std::string& field, Expectation& out) {
    AXISCAL_TRY(out.value, number_at(object, "value", field + ".value"));
    AXISCAL_TRY(const json* tolerance, member(object, "tolerance", field + ".tolerance"));
    AXISCAL_TRY(out.tolerance, bound_of(*tolerance, field + ".tolerance"));
    AXISCAL_TRY(out.reason, filled_text(object, "reason", field + ".reason"));
    return {};
}

Result<void> read_equal(const json& object, const std::string& field, Expectation& out) {
    out.kind = Expectation::Kind::equal;
    out.equals = object.at("equals");
    if (out.equals.is_string() || out.equals.is_boolean() || out.equals.is_number_integer())
        return {};
    return refuse(Fault::bad_case, field + ".equals",
                  "must be a text, a boolean or a whole number; other numbers need 'value' and "
                  "'tolerance'");
}

Result<void> read_absent(const json& object, const std::string& field, Expectation& out) {
    out.kind = Expectation::Kind::absent;
    if (object.at("absent") == true) return {};
    return refuse(Fault::bad_case, field + ".absent", "must be true");
}

Result<Expectation>
read_expectation(const json& object, const std::string& field, double case_scale) {
    const Words known{"at", "value", "tolerance", "scale", "equals", "absent", "reason"};
    AXISCAL_CHECK(check_object(object, field, known));
    Expectation out;
    AXISCAL_TRY(out.at, pointer_at(object, field + ".at"));
    AXISCAL_TRY(out.scale, scale_of(object, field + ".scale", case_scale));
    const auto kinds = std::ranges::count_if(std::array{"value", "equals", "absent"},
                                             [&](const char* k) { return object.contains(k); });
    if (kinds != 1)
        return refuse(Fault::bad_case, field,
                      "needs one of 'value', 'equals' and 'absent', and only one");
    if (object.contains("equals")) {
        AXISCAL_CHECK(read_equal(object, field, out));
    } else if (object.contains("absent")) {
        AXISCAL_CHECK(read_absent(object, field, out));
    } else {
        AXISCAL_CHECK(read_number(object, field, out));
    }
    return out;
}

Result<std::vector<Expectation>> read_expectations(const json& object, double scale) {
    AXISCAL_TRY(const json* list, member(object, "expect", "expect"));
    if (!list->is_array() || list->empty())
        return refuse(Fault::bad_case, "expect", "must be a list of at least one figure");
    std::vector<Expectation> out;
    for (std::size_t i = 0; i < list->size(); ++i) {
        AXISCAL_TRY(Expectation one, read_expectation((*list)[i], indexed("expect", i), scale));
        if (std::ranges::find(out, one.at, &Expectation::at) != out.end())
            return refuse(Fault::bad_case, indexed("expect", i) + ".at", "stands twice");
        out.push_back(std::move(one));
    }
    return out;
}

Result<void> read_origin(const json& object, ConformanceCase& out) {
    const Words origins{conformance_origins.begin(), conformance_origins.end()};
    AXISCAL_TRY(out.origin, one_of(object, "origin", "origin", origins));
    AXISCAL_TRY(out.source, filled_text(object, "source", "source"));
    const bool derived = out.origin == "closed_form" || out.origin == "two_ways";
    if (derived || object.contains("derivation")) {
        AXISCAL_TRY(out.derivation, filled_text(object, "derivation", "derivation"));
    }
    return {};
}

} // namespace

Result<ConformanceCase> read_conformance_case(std::string_view text, const std::string& id) {
    AXISCAL_TRY(const CaseText read, read_case_text(text));
    if (!read.repeated_keys.empty())
        return refuse(Fault::bad_case, printable(read.repeated_keys.begin()->second),
                      "stands twice in one object");
    const json& object = read.document;
    AXISCAL_CHECK(check_object(
        object, "",
        {"id", "title", "origin", "source", "derivation", "scale", "notes", "case", "expect"}));
    ConformanceCase out;
    AXISCAL_TRY(out.id, filled_text(object, "id", "id"));
    if (out.id != id)
        return refuse(Fault::bad_case, "id", "must be the name of its file, \"" + id + "\"");
    AXISCAL_TRY(out.title, filled_text(object, "title", "title"));
    AXISCAL_CHECK(read_origin(object, out));
    AXISCAL_TRY(const json* input, member(object, "case", "case"));
    if (!input->is_object()) return refuse(Fault::bad_case, "case", "must be an object");
    out.input = *input;
    AXISCAL_TRY(const double scale, scale_of(object, "scale", 0));
    AXISCAL_TRY(out.expect, read_expectations(object, scale));
    return out;
}

} // namespace axiscal
