#include "acquisition/documents/probing/probing_document.hpp"

#include "acquisition/documents/conformity_json.hpp"
#include "acquisition/documents/document_parts.hpp"
#include "acquisition/documents/record_json.hpp"
#include "analysis/probing/probing_case.hpp"

#include <algorithm>
#include <cstdio>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

std::string digest_of(const std::vector<ProbingDelay>& results) {
    std::vector<double> figures;
    for (const ProbingDelay& result : results)
        figures.insert(figures.end(),
                       {result.variation_mm, result.variation_ms,
                        static_cast<double>(result.touches), result.period_ms.value_or(-1),
                        result.reference_repeatability_mm.value_or(-1)});
    return digest_of_figures("axiscal.probing/1", figures);
}

Json series_of(const ProbingDelay& result) {
    Json object;
    object["symbol"] = result.symbol;
    object["direction"] = result.unit_direction;
    object["touches"] = result.touches;
    object["reference"] = result.reference;
    object["variation_mm"] = result.variation_mm;
    object["variation_ms"] = result.variation_ms;
    object["standard_deviation_mm"] = stated_json(result.standard_deviation_mm);
    object["period_ms"] = stated_json(result.period_ms);
    object["period_standard_uncertainty_ms"] = stated_json(result.period_standard_uncertainty_ms);
    object["no_period"] = result.period_ms ? Json{} : Json(result.no_period);
    object["reference_repeatability_mm"] = stated_json(result.reference_repeatability_mm);
    object["net_variation_mm"] = stated_json(result.net_variation_mm);
    return object;
}

Json series_list(const std::vector<ProbingDelay>& results) {
    Json list = Json::array();
    for (const ProbingDelay& result : results)
        list.push_back(series_of(result));
    return list;
}

Json run_of(const ProbingResult& document) {
    const RunRecord& run = document.run;
    Json object = test_run_json(run, document.run_file_sha256, document.result_digest);
    object["machine"] = run.statements.machine;
    object["machine_serial"] = run.statements.machine_serial;
    object["operator"] = run.statements.operator_name;
    object["statements"] = statements_json(run.statements);
    object["probe"] = document.record.probe;
    object["signal_path"] = document.record.signal_path;
    return object;
}

/// Of several series of one direction the largest.
std::vector<FigureToJudge> figures_to_judge(const std::vector<ProbingDelay>& results) {
    std::vector<FigureToJudge> figures;
    for (const ProbingDelay& result : results) {
        const auto same = std::ranges::find(figures, result.symbol, &FigureToJudge::parameter);
        if (same == figures.end())
            figures.push_back({result.symbol, result.variation_mm, {}});
        else
            same->value = std::max(*same->value, result.variation_mm);
    }
    return figures;
}

} // namespace

Result<ProbingResult> probing_result_of(const std::string& path, RunFileContents contents) {
    if (!contents.closed || !contents.run.complete)
        return fail(Fault::incomplete_run, path + " is not closed as complete");
    auto* record = std::get_if<ProbingRecord>(&contents.attachments.setup);
    if (record == nullptr) return fail(Fault::bad_run_file, path + " has no row probing");
    ProbingResult result;
    result.record = std::move(*record);
    AXISCAL_TRY(result.results, evaluate_probing_delay(case_of(result.record)));
    result.conformity = conformity_of(contents.run.tolerances, figures_to_judge(result.results), "mm");
    result.run = std::move(contents.run);
    result.result_digest = digest_of(result.results);
    return result;
}

Json probing_figures(const ProbingResult& result) {
    Json figures;
    figures["format"] = "axiscal.probing/1";
    figures["unit"] = "mm";
    figures["parameters"] = series_list(result.results);
    return figures;
}

Json probing_to_json(const ProbingResult& document) {
    Json object;
    object["format"] = "axiscal.probing/1";
    object["standard"] = "ISO 230-10, 6.9 (steps reconstructed)";
    object["unit"] = "mm";
    object["feed_mm_per_min"] = document.record.feed_mm_per_min;
    object["feed_mm_per_ms"] = feed_mm_per_ms(document.record);
    add_conformity(object, document.conformity);
    object["parameters"] = series_list(document.results);
    object["preliminary"] = true;
    object["missing"] = Json::array({"an uncertainty budget"});
    object["run"] = run_of(document);
    return object;
}

double feed_mm_per_ms(const ProbingRecord& record) {
    constexpr double ms_per_min = 60'000;
    return record.feed_mm_per_min / ms_per_min;
}

std::string probing_csv(const ProbingResult& document) {
    std::string text = "direction,kind,approach_mm,x_mm,y_mm,z_mm\r\n";
    for (const ProbingTouch& touch : document.record.touches) {
        char line[160];
        std::snprintf(line, sizeof line, "%g %g %g,%s,%.6f,%.6f,%.6f,%.6f\r\n", touch.direction[0],
                      touch.direction[1], touch.direction[2],
                      touch.reference ? "reference" : "touch", touch.approach.in(mm),
                      touch.latched[0].in(mm), touch.latched[1].in(mm), touch.latched[2].in(mm));
        text += line;
    }
    return text;
}

} // namespace axiscal
