#include "tools/axiscal/analyze_case.hpp"

#include "acquisition/publish/result_json.hpp"
#include "analysis/positioning_accuracy.hpp"
#include "tools/axiscal/case_text.hpp"
#include "tools/axiscal/exit_code.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>
#include <vector>

namespace axiscal {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;
using Words = std::vector<std::string>;

struct Standard {
    std::string_view name;
    double cover_factor;
};
constexpr std::array standards{Standard{"ISO 230-2:2014", 2}, Standard{"ISO 230-2:2006", 2},
                               Standard{"ISO 230-2:1997", 2}, Standard{"ISO 230-2:1988", 3}};

// ---- keys -----------------------------------------------------------------------------------

/// Keys that carry words only and can change no figure.
constexpr std::array<std::string_view, 14> remark_keys{
    "comment", "customer", "date",     "description", "id",  "instrument", "machine",
    "name",    "note",     "operator", "place",       "run", "source",     "title"};

/// Letters to insert, delete or replace to turn one word into the other, case aside.
std::size_t edit_distance(const std::string& a, const std::string& b) {
    const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j)
        row[j] = j;
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (lower(a[i]) == lower(b[j]) ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row.back();
}

std::string hint_for(const std::string& key, const Words& known) {
    constexpr std::size_t longest_key = 32, near = 2;
    if (key.size() <= longest_key)
        for (const std::string& word : known)
            if (edit_distance(key, word) <= near) return "did you mean '" + word + "'?";
    return "remarks go under 'comment'";
}

Result<void> check_keys(const json& object, const std::string& prefix, const Words& known) {
    for (const auto& [key, value] : object.items()) {
        if (std::ranges::find(known, key) != known.end()) continue;
        if (std::ranges::find(remark_keys, key) != remark_keys.end()) continue;
        return refuse(Fault::bad_case, prefix + printable(key),
                      "is not a key of a case; " + hint_for(key, known));
    }
    return {};
}

Result<const json*> member(const json& object, const std::string& key, const std::string& field) {
    const auto found = object.find(key);
    if (found == object.end()) return refuse(Fault::bad_case, field, "is missing");
    return &*found;
}

Result<std::string> text_of(const json& object, const std::string& key, const std::string& field) {
    AXISCAL_TRY(const json* value, member(object, key, field));
    if (!value->is_string() || !not_finite_token(*value).empty())
        return refuse(Fault::bad_case, field, "must be a text");
    return value->get<std::string>();
}

Result<std::string>
one_of(const json& object, const std::string& key, const std::string& field, const Words& allowed) {
    AXISCAL_TRY(std::string word, text_of(object, key, field));
    if (std::ranges::find(allowed, word) != allowed.end()) return word;
    std::string list;
    for (const std::string& item : allowed)
        list += (list.empty() ? "\"" : ", \"") + item + '"';
    return refuse(Fault::bad_case, field,
                  (allowed.size() == 1 ? "must be " : "must be one of ") + list);
}

// ---- numbers --------------------------------------------------------------------------------

std::string indexed(const std::string& field, std::size_t index) {
    return field + "[" + std::to_string(index) + "]";
}

Result<double> number_of(const json& value, const std::string& field) {
    if (value.is_number()) return value.get<double>();
    if (const std::string token = not_finite_token(value); !token.empty())
        return refuse(Fault::bad_case, field, token + " is not a finite number");
    return refuse(Fault::bad_case, field,
                  std::string{"must be a number, not "} + value.type_name());
}

Result<std::vector<double>> numbers_of(const json& array, const std::string& field) {
    if (!array.is_array()) return refuse(Fault::bad_case, field, "must be an array of numbers");
    std::vector<double> numbers;
    numbers.reserve(array.size());
    for (std::size_t i = 0; i < array.size(); ++i) {
        AXISCAL_TRY(const double number, number_of(array[i], indexed(field, i)));
        numbers.push_back(number);
    }
    return numbers;
}

Result<std::vector<std::vector<double>>> rows_of(const json& array, const std::string& field) {
    if (!array.is_array() || array.empty())
        return refuse(Fault::bad_case, field, "must be an array of one row a target");
    std::vector<std::vector<double>> rows;
    for (std::size_t i = 0; i < array.size(); ++i) {
        AXISCAL_TRY(auto row, numbers_of(array[i], indexed(field, i)));
        rows.push_back(std::move(row));
    }
    return rows;
}

void subtract_targets(DeviationTable& table) {
    for (auto* rows : {&table.forward, &table.backward})
        for (std::size_t i = 0; i < rows->size(); ++i)
            for (double& value : (*rows)[i])
                value -= table.targets[i];
}

// ---- one case -------------------------------------------------------------------------------

struct Case {
    DeviationTable table;
    Standard standard;
};

Result<std::string> unit_of(const json& object) {
    AXISCAL_TRY(const json* axis, member(object, "axis", "axis"));
    if (!axis->is_object())
        return refuse(Fault::bad_case, "axis", "must be an object with name and kind");
    if (auto good = check_keys(*axis, "axis.", {"name", "kind"}); !good)
        return tl::unexpected(good.error());
    AXISCAL_TRY(const std::string name, text_of(*axis, "name", "axis.name"));
    AXISCAL_TRY(const std::string kind, one_of(*axis, "kind", "axis.kind", {"linear", "rotary"}));
    return one_of(object, "unit", "unit", kind == "linear" ? Words{"mm", "um", "m"} : Words{"deg"});
}

Result<Standard> standard_of(const json& object) {
    Words names;
    for (const Standard& standard : standards)
        names.emplace_back(standard.name);
    AXISCAL_TRY(const std::string name, one_of(object, "standard", "standard", names));
    return *std::ranges::find(standards, name, &Standard::name);
}

Result<DeviationTable> table_of(const json& object) {
    DeviationTable table;
    AXISCAL_TRY(const json* targets, member(object, "targets", "targets"));
    AXISCAL_TRY(table.targets, numbers_of(*targets, "targets"));
    AXISCAL_TRY(const json* forward, member(object, "forward", "forward"));
    AXISCAL_TRY(table.forward, rows_of(*forward, "forward"));
    if (object.contains("backward")) {
        AXISCAL_TRY(table.backward, rows_of(object.at("backward"), "backward"));
    }
    return table;
}

Result<Case> case_of(const json& object) {
    if (!object.is_object()) return refuse(Fault::bad_case, "case", "must be an object");
    const Words known{"analysis", "standard", "axis",     "unit",        "readings",
                      "targets",  "forward",  "backward", "compensation"};
    if (auto good = check_keys(object, "", known); !good) return tl::unexpected(good.error());
    AXISCAL_TRY(const auto analysis, one_of(object, "analysis", "analysis", {"positioning"}));
    AXISCAL_TRY(const Standard standard, standard_of(object));
    AXISCAL_TRY(std::string unit, unit_of(object));
    AXISCAL_TRY(const std::string readings,
                one_of(object, "readings", "readings", {"positions", "deviations"}));
    if (object.contains("compensation")) {
        AXISCAL_TRY(const auto stated,
                    one_of(object, "compensation", "compensation", {"already_at_20C"}));
    }
    AXISCAL_TRY(DeviationTable table, table_of(object));
    table.unit = std::move(unit);
    // positions are first checked as they came: the shape must be right and the numbers sane
    AXISCAL_TRY(const RunAt20C checked, declare_at_20C(table, "as it came"));
    if (readings == "positions") subtract_targets(table);
    return Case{std::move(table), standard};
}

Result<ordered_json> analyze_one(const json& object, const std::string* repeated_key) {
    if (repeated_key)
        return refuse(Fault::bad_case, printable(*repeated_key), "stands twice in one object");
    AXISCAL_TRY(Case one, case_of(object));
    AXISCAL_TRY(const RunAt20C run,
                declare_at_20C(std::move(one.table), "a case is taken as measured at 20 degC"));
    return result_to_json(
        evaluate_positioning(run, std::string{one.standard.name}, one.standard.cover_factor));
}

std::string line_of(const std::string& place, const Error& error) {
    return "refused: " + place + error.field + ": " + error.detail;
}

CaseAnswer refuse_all(const Error& error) {
    return {{}, exit_refused, line_of("", error)};
}

CaseAnswer answer_array(const CaseText& text) {
    ordered_json results = ordered_json::array();
    std::size_t refused = 0;
    CaseAnswer answer;
    for (std::size_t i = 0; i < text.document.size(); ++i) {
        const auto repeated = text.repeated_keys.find(i);
        auto result = analyze_one(
            text.document[i], repeated == text.repeated_keys.end() ? nullptr : &repeated->second);
        if (result) {
            results.push_back(*std::move(result));
            continue;
        }
        ordered_json refusal;
        refusal["refused"]["field"] = result.error().field;
        refusal["refused"]["reason"] = result.error().detail;
        results.push_back(std::move(refusal));
        if (refused++ == 0) answer.error_line = line_of(indexed("case", i) + " ", result.error());
    }
    if (refused > 0) {
        answer.exit_code = exit_refused;
        answer.error_line += " (" + std::to_string(refused) + " of " +
                             std::to_string(text.document.size()) + " cases refused)";
    }
    answer.output = results.dump(2) + "\n";
    return answer;
}

} // namespace

CaseAnswer analyze_cases(std::string_view json_text) {
    const auto text = read_case_text(json_text);
    if (!text) return refuse_all(text.error());
    if (text->document.is_array()) return answer_array(*text);
    const auto repeated = text->repeated_keys.begin();
    const auto result = analyze_one(
        text->document, repeated == text->repeated_keys.end() ? nullptr : &repeated->second);
    if (!result) return refuse_all(result.error());
    return {result->dump(2) + "\n", 0, {}};
}

} // namespace axiscal
