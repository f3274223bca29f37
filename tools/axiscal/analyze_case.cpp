#include "tools/axiscal/analyze_case.hpp"

#include "config/json_text.hpp"
#include "tools/axiscal/case_text.hpp"
#include "tools/axiscal/cases/case_reader.hpp"
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

} // namespace

CaseAnswer analyze_cases(std::string_view json_text) {
    if (is_measurements_csv(json_text)) {
        const auto table = separation_table_case(json_text);
        return table ? CaseAnswer{table->dump(2) + "\n", 0, {}} : refuse_all(table.error());
    }
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
