#include "acquisition/documents/squareness/squareness_document.hpp"

#include "acquisition/documents/document_parts.hpp"
#include "acquisition/documents/squareness/squareness_remarks.hpp"
#include "analysis/straightness/recorded_line_of.hpp"

#include <array>
#include <utility>

namespace axiscal {
namespace {

constexpr std::array squareness_order{LineReference::least_squares, LineReference::end_points,
                                      LineReference::minimum_zone};

bool is_line_of(const RecordedLine& line, const std::string& axis, const std::string& across) {
    return line.axis == axis && line.across == across;
}

/// A line of another axis would make a number that means nothing.
Result<void> check_square_lines(const std::string& path, const SquarenessResult& result) {
    const SquarenessSetup& setup = result.setup();
    if (setup.optics.method != StraightnessMethod::wollaston)
        return fail(Fault::bad_run_file, path + " is a squareness by " +
                                             std::string{name_of(setup.optics.method)} +
                                             ": only a Wollaston prism sees both axes");
    const std::string &first = setup.optics.across, &second = result.second_axis();
    bool fits = is_line_of(setup.first, first, second);
    if (setup.other)
        fits = fits && is_line_of(setup.other->first, first, second) &&
               is_line_of(setup.other->second, second, first);
    if (fits) return {};
    return fail(Fault::bad_run_file, path + " holds a line that is not of axis " + first +
                                         " across " + second + " or the other way round");
}

Result<void> add_square_lines(SquarenessResult& result) {
    const SquarenessSetup& setup = result.setup();
    const SquarenessFigures& found = result.found;
    AXISCAL_TRY(RecordedLine own, recorded_line_of(result.run, result.revisions, setup.optics));
    result.lines.push_back({setup.square, setup.first, found.lines.first});
    result.lines.push_back({setup.square, std::move(own), found.lines.second});
    if (!setup.other || !found.other) return {};
    const SquarePosition other =
        setup.square == SquarePosition::normal ? SquarePosition::turned : SquarePosition::normal;
    result.lines.push_back({other, setup.other->first, found.other->first});
    result.lines.push_back({other, setup.other->second, found.other->second});
    return {};
}

/// `result` holds the run.
Result<void> add_squareness(SquarenessResult& result) {
    AXISCAL_TRY(const double scatter_um, read_across_run(result));
    AXISCAL_TRY(result.found, evaluate_squareness(result.figures.mean, result.setup()));
    AXISCAL_TRY(result.budget,
                make_squareness_budget(result.found, result.setup(),
                                       result.figures.readings_a_mean(), scatter_um));
    return add_square_lines(result);
}

void append_optional_um(std::vector<double>& figures, const std::optional<double>& value) {
    figures.push_back(value ? 1 : 0);
    figures.push_back(value.value_or(0));
}

std::string digest_of_squareness(const SquarenessResult& result) {
    std::vector<double> figures;
    for (const LineReference reference : line_references) {
        figures.push_back(squareness_against(result.found.squareness, reference));
        for (const SquareLine& line : result.lines)
            figures.push_back(line_against(line.found.against, reference).slope);
    }
    figures.push_back(result.found.square_error_rad);
    figures.push_back(result.found.by_reversal ? 1 : 0);
    for (const StraightnessRow& row : result.figures.rows) {
        figures.push_back(row.target_mm);
        figures.push_back(row.mean_forward_um);
        append_optional_um(figures, row.mean_backward_um);
        append_optional_um(figures, row.mean_um);
    }
    return digest_of_figures("axiscal.squareness/1", figures);
}

/// Against the limits of the run; no band of travel holds for two axes. A length is no limit of an
/// angle.
Result<void> judge_squareness(const std::string& path, SquarenessResult& result) {
    const auto& agreed = result.run.tolerances;
    if (agreed && agreed->unit != "um/m" && agreed->unit != "arcsec")
        return fail(Fault::bad_run_file, path + " has limits of a squareness in " + agreed->unit +
                                             ": they must be in um/m or arcsec");
    std::vector<FigureToJudge> judged;
    for (NamedSquareness& figure : figures_of(result))
        judged.push_back({std::move(figure.key), figure.value_um_per_m, figure.expanded_um_per_m,
                          result.budget.coverage});
    result.conformity = conformity_of(agreed, judged, "um/m");
    return {};
}

} // namespace

const SquarenessSetup& SquarenessResult::setup() const {
    return std::get<SquarenessSetup>(attachments.setup);
}

double arcsec_of_um_per_m(double um_per_m) {
    return um_per_m / um_per_m_of_rad / arcsec.size;
}

double squareness_against(const Squareness& squareness, LineReference reference) {
    switch (reference) {
    case LineReference::end_points: return squareness.end_points;
    case LineReference::least_squares: return squareness.least_squares;
    case LineReference::minimum_zone: break;
    }
    return squareness.minimum_zone;
}

std::vector<NamedSquareness> figures_of(const SquarenessResult& result) {
    std::vector<NamedSquareness> figures;
    for (const LineReference reference : squareness_order)
        figures.push_back({"squareness_" + std::string{name_of(reference)},
                           squareness_against(result.found.squareness, reference) * um_per_m_of_rad,
                           {}});
    if (result.budget.expanded_rad)
        figures.front().expanded_um_per_m = *result.budget.expanded_rad * um_per_m_of_rad;
    return figures;
}

std::string_view square_error_by(const SquarenessResult& result) {
    if (result.found.by_reversal) return "reversal";
    return result.setup().stated.error ? "stated" : "not taken out";
}

std::string squareness_title(const SquarenessResult& result) {
    return "Squareness of axis " + result.second_axis() + " to axis " + result.first_axis();
}

std::string sign_of_squareness(const SquarenessResult& result) {
    return "> 0 where the angle between +" + result.first_axis() + " and +" + result.second_axis() +
           " is larger than 90 degrees";
}

Result<SquarenessResult> squareness_result_of(const std::string& path, RunFileContents contents) {
    SquarenessResult result;
    AXISCAL_TRY(const Duration clock_off,
                take_across_run(result, path, std::move(contents), TestKind::squareness));
    AXISCAL_CHECK(check_square_lines(path, result));
    AXISCAL_CHECK(add_squareness(result));
    if (result.completeness.partial())
        result.run.statements.certificate_number.clear();
    else
        AXISCAL_CHECK(judge_squareness(path, result));
    result.remarks = remarks_on_squareness(result, clock_off);
    result.result_digest = digest_of_squareness(result);
    return result;
}

} // namespace axiscal
