#include "acquisition/documents/straightness/straightness_document.hpp"

#include "acquisition/documents/document_parts.hpp"
#include "acquisition/documents/straightness/straightness_remarks.hpp"
#include "analysis/straightness/mirror_reversal.hpp"
#include "analysis/straightness/run_straightness.hpp"
#include "analysis/straightness/sensitivity.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace axiscal {
namespace {

Result<void> add_budgets(StraightnessResult& result, double scatter) {
    const StraightnessFigures& figures = result.figures;
    result.lines.push_back({"mean", figures.mean, {}});
    result.lines.push_back({"forward", figures.forward, {}});
    if (figures.backward) result.lines.push_back({"backward", *figures.backward, {}});
    for (BudgetedLine& line : result.lines) {
        const int readings =
            line.name == "mean" ? figures.readings_a_mean() : figures.readings_of_direction();
        StraightnessInputs inputs = inputs_of(result.setup(), scatter, readings);
        inputs.mirror_reversed = result.mirror.has_value();
        AXISCAL_TRY(line.budget, make_straightness_budget(line.found, inputs));
    }
    return {};
}

/// Of a partial result the position of its own mirror alone: targets may be missing.
Result<void> part_mirror(StraightnessResult& result) {
    const auto& reversal = result.setup().reversal;
    if (!reversal || result.completeness.partial()) return {};
    AXISCAL_TRY(PartedStraightness parted,
                part_straightness(result.figures, result.setup().mirror, *reversal));
    result.figures = std::move(parted.axis);
    result.mirror = std::move(parted.mirror);
    return {};
}

/// The closed form holds while the same points stay the extremes; the trials tell where they do
/// not.
Result<void> add_trials(StraightnessResult& result) {
    constexpr int trials = 10'000;
    constexpr std::uint64_t seed = 1;
    const auto u_um = independent_u_um(result);
    const StraightnessLine& line = result.mean().found;
    const auto by_reading = sensitivity_of(line.line, line.against, main_reference);
    const bool wollaston = result.setup().method == StraightnessMethod::wollaston;
    const double reach =
        std::sqrt(sum_of_squares(wollaston ? by_reading : sensitivity_to_steps(by_reading)));
    if (!u_um || !(*u_um > 0) || !(reach > 0)) return {};
    StraightnessErrors errors;
    (wollaston ? errors.reading_u_um : errors.step_u_um) = *u_um / reach;
    AXISCAL_TRY(result.tried, try_straightness(line.line, errors, trials, seed));
    return {};
}

void append_optional(std::vector<double>& figures, const std::optional<double>& value) {
    figures.push_back(value ? 1 : 0);
    figures.push_back(value.value_or(0));
}

std::string digest_of_straightness(const StraightnessResult& result) {
    std::vector<double> figures;
    for (const BudgetedLine& line : result.lines)
        for (const LineReference reference : line_references) {
            figures.push_back(line.found.straightness_um(reference));
            figures.push_back(line_against(line.found.against, reference).slope);
        }
    for (const auto& value : {result.figures.reversal_um, result.figures.mean_reversal_um,
                              result.figures.repeatability_um})
        append_optional(figures, value);
    for (const StraightnessRow& row : result.figures.rows) {
        figures.push_back(row.target_mm);
        figures.push_back(row.mean_forward_um);
        for (const auto& value : {row.mean_backward_um, row.mean_um, row.reversal_um,
                                  row.s_forward_um, row.s_backward_um})
            append_optional(figures, value);
    }
    if (result.mirror)
        for (const LineReference reference : line_references)
            figures.push_back(result.mirror->straightness_um(reference));
    return digest_of_figures("axiscal.straightness/1", figures);
}

/// Against the limits of the run, by band of the length that was measured.
void judge(StraightnessResult& result) {
    std::vector<FigureToJudge> judged;
    for (NamedStraightness& figure : figures_of(result))
        judged.push_back({std::move(figure.key), figure.value_um, figure.expanded_um});
    const auto& rows = result.figures.rows;
    result.conformity = conformity_of(result.run.tolerances, judged, "um",
                                      rows.back().target_mm - rows.front().target_mm);
}

void add_figures_of(std::vector<NamedStraightness>& figures, const BudgetedLine& line) {
    const std::string direction = line.name == "mean" ? "" : "_" + std::string{line.name};
    for (const LineReference reference : line_references)
        figures.push_back({"straightness_" + std::string{name_of(reference)} + direction,
                           line.found.straightness_um(reference),
                           uncertainty_against(line, reference).expanded_um});
}

} // namespace

const StraightnessUncertainty& uncertainty_against(const BudgetedLine& line,
                                                   LineReference reference) {
    return line.budget.by_reference[static_cast<std::size_t>(reference)];
}

std::vector<NamedStraightness> figures_of(const StraightnessResult& result) {
    std::vector<NamedStraightness> figures;
    for (const BudgetedLine& line : result.lines)
        add_figures_of(figures, line);
    const StraightnessFigures& found = result.figures;
    if (found.reversal_um) figures.push_back({"straightness_B", *found.reversal_um, {}});
    if (found.mean_reversal_um)
        figures.push_back({"straightness_B_mean", *found.mean_reversal_um, {}});
    if (found.repeatability_um) figures.push_back({"straightness_R", *found.repeatability_um, {}});
    return figures;
}

std::optional<double> independent_u_um(const StraightnessResult& result) {
    const StraightnessUncertainty& main = uncertainty_against(result.mean(), main_reference);
    if (!main.u_um) return std::nullopt;
    double squares = 0;
    for (const StraightnessContribution& part : main.contributions)
        if (part.term == StraightnessTerm::angle || part.term == StraightnessTerm::resolution ||
            part.term == StraightnessTerm::environment)
            squares += part.u_um * part.u_um;
    return std::sqrt(squares);
}

std::string straightness_symbol_of(const StraightnessResult& result) {
    return "E_" + result.setup().across + result.run.statements.axis;
}

Result<StraightnessResult> straightness_result_of(const std::string& path,
                                                  RunFileContents contents) {
    StraightnessResult result;
    AXISCAL_TRY(const Duration clock_off,
                take_across_run(result, path, std::move(contents), TestKind::straightness));
    AXISCAL_TRY(const double scatter, read_across_run(result));
    AXISCAL_CHECK(part_mirror(result));
    AXISCAL_CHECK(
        add_budgets(result, result.mirror ? result.figures.pooled_s_um.value_or(0) : scatter));
    AXISCAL_CHECK(add_trials(result));
    if (result.completeness.partial())
        result.run.statements.certificate_number.clear();
    else
        judge(result);
    result.remarks = remarks_on_straightness(result, clock_off);
    result.result_digest = digest_of_straightness(result);
    return result;
}

} // namespace axiscal
