#include "analysis/straightness/mirror_reversal.hpp"

#include "analysis/straightness/recorded_line_of.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

namespace axiscal {
namespace {

constexpr double um_a_mm = 1000;

tl::unexpected<Error> not_alike(const std::string& what) {
    return refuse(Fault::bad_case, "targets",
                  "of both positions of the mirror are not the same " + what +
                      ": take both runs by one plan");
}

/// A target that was kept in metres comes back with another last digit.
bool is_same_place(double one_mm, double other_mm) {
    constexpr double rounding_mm = 1e-6;
    return std::fabs(one_mm - other_mm) < rounding_mm;
}

Result<void> check_alike(const StraightnessFigures& run, const StraightnessFigures& other) {
    if (run.rows.size() != other.rows.size()) return not_alike("in number");
    for (std::size_t i = 0; i < run.rows.size(); ++i)
        if (!is_same_place(run.rows[i].target_mm, other.rows[i].target_mm))
            return not_alike("places");
    if (run.backward.has_value() != other.backward.has_value()) return not_alike("directions");
    return {};
}

/// The means of a run about the least-squares line of its own mean.
class AboutOwnLine {
public:
    explicit AboutOwnLine(const StraightnessFigures& run)
        : run_{run} {}
    [[nodiscard]] double forward_um(std::size_t i) const {
        return run_.rows[i].mean_forward_um - line_um(i);
    }
    [[nodiscard]] double backward_um(std::size_t i) const {
        return run_.rows[i].mean_backward_um.value_or(0) - line_um(i);
    }
    [[nodiscard]] double mean_um(std::size_t i) const {
        return run_.mean.against.least_squares.residuals[i];
    }

private:
    [[nodiscard]] double line_um(std::size_t i) const {
        const ReferenceLine& line = run_.mean.against.least_squares;
        return line.offset + line.slope * run_.rows[i].target_mm * um_a_mm;
    }
    const StraightnessFigures& run_;
};

double half_sum(double a, double b) {
    return (a + b) / 2;
}

void average_rows(StraightnessFigures& run, const StraightnessFigures& other) {
    const StraightnessFigures before = run;
    const AboutOwnLine one{before}, two{other};
    for (std::size_t i = 0; i < run.rows.size(); ++i) {
        StraightnessRow& row = run.rows[i];
        row.mean_forward_um = half_sum(one.forward_um(i), two.forward_um(i));
        if (!row.mean_backward_um) continue;
        row.mean_backward_um = half_sum(one.backward_um(i), two.backward_um(i));
        row.mean_um = half_sum(row.mean_forward_um, *row.mean_backward_um);
        row.reversal_um = row.mean_forward_um - *row.mean_backward_um;
    }
}

void average_reversal(StraightnessFigures& run) {
    if (!run.backward) return;
    double largest = 0, sum = 0;
    for (const StraightnessRow& row : run.rows) {
        largest = std::max(largest, std::fabs(row.reversal_um.value_or(0)));
        sum += row.reversal_um.value_or(0);
    }
    run.reversal_um = largest;
    run.mean_reversal_um = sum / static_cast<double>(run.rows.size());
}

/// Of the same number of readings, as both runs have it.
void pool_scatter(StraightnessFigures& run, Length other) {
    if (!run.pooled_s_um || !(other > Length{})) return;
    run.pooled_s_um = std::hypot(*run.pooled_s_um, other.in(um)) / std::sqrt(2.0);
}

Result<StraightnessLine>
mirror_of(const StraightnessFigures& run, MirrorPosition stood, const StraightnessFigures& other) {
    const double side = stood == MirrorPosition::normal ? 1 : -1;
    StraightnessLine mirror;
    mirror.line.positions = run.mean.line.positions;
    for (std::size_t i = 0; i < run.rows.size(); ++i)
        mirror.line.deviations.push_back(
            side * (AboutOwnLine{run}.mean_um(i) - AboutOwnLine{other}.mean_um(i)) / 2);
    AXISCAL_TRY(mirror.against, straightness_of(mirror.line));
    return mirror;
}

} // namespace

Result<PartedStraightness>
part_straightness(const StraightnessFigures& run, MirrorPosition stood, const RecordedLine& other) {
    AXISCAL_TRY(const StraightnessFigures second, evaluate_straightness(readings_of(other)));
    AXISCAL_CHECK(check_alike(run, second));
    PartedStraightness parted{run, {}};
    AXISCAL_TRY(parted.mirror, mirror_of(run, stood, second));
    average_rows(parted.axis, second);
    AXISCAL_CHECK(draw_lines(parted.axis));
    average_reversal(parted.axis);
    pool_scatter(parted.axis, other.scatter);
    parted.axis.approaches = std::min(run.approaches, other.readings);
    parted.axis.runs = 2;
    return parted;
}

} // namespace axiscal
