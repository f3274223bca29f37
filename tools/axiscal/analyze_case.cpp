#include "tools/axiscal/analyze_case.hpp"

#include "config/json_text.hpp"
#include "tools/axiscal/case_text.hpp"
#include "tools/axiscal/cases/case_reader.hpp"
#include "tools/axiscal/cases/case_table.hpp"
#include "tools/axiscal/cases/cases.hpp"
#include "tools/axiscal/cases/separation_csv.hpp"
#include "tools/axiscal/cases/separation_features.hpp"
#include "tools/axiscal/exit_code.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace axiscal {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

struct Analysis {
    std::string_view name;
    Result<ordered_json> (*evaluate)(const json& object);
};
constexpr std::array analyses{Analysis{"positioning", positioning_case},
                              Analysis{"air_index", air_index_case},
                              Analysis{"expansion", expansion_case},
                              Analysis{"drift", drift_case},
                              Analysis{"straightness", straightness_case},
                              Analysis{"squareness", squareness_case},
                              Analysis{"angular", angular_case},
                              Analysis{"diagonals", diagonals_case},
                              Analysis{"target_rule", target_rule_case},
                              Analysis{"periodic_error", periodic_error_case},
                              Analysis{"error_separation", separation_case},
                              Analysis{"probing_delay", probing_delay_case},
                              Analysis{"chebyshev_fit", chebyshev_fit_case},
                              Analysis{"circular", circular_case},
                              Analysis{"circle_fit", circle_fit_case}};

Result<ordered_json> analyze_one(const json& object, const std::string* repeated_key) {
    if (repeated_key)
        return refuse(Fault::bad_case, printable(*repeated_key), "stands twice in one object");
    if (!object.is_object()) return refuse(Fault::bad_case, "case", "must be an object");
    Words names;
    for (const Analysis& analysis : analyses)
        names.emplace_back(analysis.name);
    AXISCAL_TRY(const std::string name, one_of(object, "analysis", "analysis", names));
    return std::ranges::find(analyses, name, &Analysis::name)->evaluate(object);
}

std::string line_of(const std::string& place, const Error& error) {
    return "refused: " + place + error.field + ": " + error.detail;
}

CaseAnswer refuse_all(const Error& error) {
    return {{}, exit_refused, line_of("", error)};
}

/// Neither JSON nor a table: says what is.
Error no_case(const std::string& utf8) {
    const std::string begin = utf8.substr(0, std::min(utf8.find_first_of("\r\n"), std::size_t{40}));
    return {Fault::bad_case,
            "neither JSON nor a table that is known here ('" + printable(begin) +
                "'). A table has a column 'target [mm]', 'angle [deg]' or 'feature' first; "
                "'axiscal case new positioning --csv FILE' writes one to be filled in",
            {},
            "json"};
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
    answer.output = json_text(results, 2) + "\n";
    return answer;
}

Result<ordered_json> evaluate_table(const std::string& utf8, TableKind kind) {
    if (kind == TableKind::workpiece) return separation_table_case(utf8);
    AXISCAL_TRY(const CaseTable table, read_table_text(utf8));
    AXISCAL_TRY(const json object, case_of_table(table, kind));
    return analyze_one(object, nullptr);
}

CaseAnswer answer_table(const std::string& utf8) {
    const auto kind = kind_of_table(utf8);
    if (!kind) return refuse_all(no_case(utf8));
    const auto result = evaluate_table(utf8, *kind);
    return result ? CaseAnswer{json_text(*result, 2) + "\n", 0, {}} : refuse_all(result.error());
}

} // namespace

CaseAnswer analyze_cases(std::string_view bytes) {
    const auto utf8 = utf8_of(bytes);
    if (!utf8) return refuse_all(utf8.error());
    const auto begin = utf8->find_first_not_of(" \t\r\n");
    if (begin == std::string::npos)
        return refuse_all({Fault::bad_case,
                           "the file is empty; 'axiscal case new positioning --csv FILE' writes a "
                           "table to be filled in",
                           {},
                           "json"});
    const bool means_json = (*utf8)[begin] == '{' || (*utf8)[begin] == '[';
    if (!means_json && !json::accept(*utf8)) return answer_table(*utf8);
    const auto text = read_case_text(*utf8);
    if (!text) return refuse_all(text.error());
    if (text->document.is_array()) return answer_array(*text);
    const auto repeated = text->repeated_keys.begin();
    const auto result = analyze_one(
        text->document, repeated == text->repeated_keys.end() ? nullptr : &repeated->second);
    if (!result) return refuse_all(result.error());
    return {result->dump(2) + "\n", 0, {}};
}

} // namespace axiscal
