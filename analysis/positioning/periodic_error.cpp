#include "analysis/positioning/periodic_error.hpp"

#include "analysis/linear/length.hpp"
#include "analysis/positioning/harmonic_columns.hpp"
#include "analysis/positioning/sums.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace axiscal {
namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr double largest_condition = 1e8;
constexpr int most_harmonics = 50;

Result<void> check_numbers(const std::vector<double>& numbers, const char* field) {
    constexpr double largest_magnitude = 1e12; // beyond any machine in any unit
    for (std::size_t i = 0; i < numbers.size(); ++i)
        if (!(std::fabs(numbers[i]) <= largest_magnitude))
            return refuse(Fault::bad_case, std::string{field} + "[" + std::to_string(i) + "]",
                          "is not a number of at most 1e12");
    return {};
}

Result<void> check_question(const PeriodicQuestion& question) {
    AXISCAL_CHECK(check_numbers(question.positions, "positions"));
    AXISCAL_CHECK(check_numbers(question.deviations, "deviations"));
    const std::size_t count = question.positions.size();
    if (question.deviations.size() != count)
        return refuse(Fault::bad_case, "deviations",
                      "has " + std::to_string(question.deviations.size()) + " numbers for " +
                          std::to_string(count) + " positions");
    if (question.harmonics < 1 || question.harmonics > most_harmonics)
        return refuse(Fault::bad_case, "harmonics", "must lie between 1 and 50");
    const auto unknowns =
        2 + 2 * static_cast<std::size_t>(question.harmonics) + (question.pitch ? 0U : 1U);
    if (count <= unknowns)
        return refuse(Fault::bad_case, "positions",
                      "are " + std::to_string(count) + " for " + std::to_string(unknowns) +
                          " unknowns; more are needed");
    if (question.pitch && question.pitch_range)
        return refuse(Fault::bad_case, "pitch_range", "has no meaning beside a stated pitch");
    return {};
}

Result<CentredPoints> centre(const PeriodicQuestion& question) {
    auto sorted = question.positions;
    std::ranges::sort(sorted);
    const double low = sorted.front(), high = sorted.back();
    // the iterator form: clang 14 cannot read the ranges one of this library
    const auto end_of_distinct = std::unique(sorted.begin(), sorted.end());
    CentredPoints points;
    points.distinct = static_cast<std::size_t>(end_of_distinct - sorted.begin());
    points.middle = low + (high - low) / 2;
    points.half_span = (high - low) / 2;
    if (points.distinct < 2 || points.half_span < 1e-9)
        return refuse(Fault::bad_case, "positions", "all lie at one place");
    for (const double x : question.positions)
        points.steps.push_back(x - points.middle);
    points.deviations = &question.deviations;
    return points;
}

std::string plain(double number) {
    std::string text = std::to_string(number);
    text.erase(std::min(text.size(), text.find('.') + 3));
    return text;
}

/// @errors field "pitch": less than one period, fewer than 4 points a wave.
Result<void> check_pitch(const CentredPoints& points, double pitch, int harmonics) {
    if (!(pitch > 0)) return refuse(Fault::bad_case, "pitch", "must be greater than 0");
    if (pitch > points.span() * (1 + 1e-9))
        return refuse(Fault::bad_case, "pitch", "is longer than the length that was measured");
    const double a_wave = pitch / points.mean_step() / harmonics;
    if (a_wave < least_points_of_a_wave * (1 - 1e-9))
        return refuse(Fault::bad_case, "pitch",
                      "has " + plain(a_wave) +
                          " points a period of the highest harmonic; 4 are needed, 20 are good");
    return {};
}

/// Derivative of the harmonics by the frequency, a column more for Gauss-Newton.
std::vector<double> frequency_column(const CentredPoints& points,
                                     const std::vector<std::vector<double>>& columns,
                                     const std::vector<double>& coefficients) {
    std::vector<double> column(points.steps.size());
    for (std::size_t h = 1; 2 * h < columns.size(); ++h)
        for (std::size_t i = 0; i < column.size(); ++i)
            column[i] += turn * static_cast<double>(h) * points.steps[i] *
                         (coefficients[2 * h + 1] * columns[2 * h][i] -
                          coefficients[2 * h] * columns[2 * h + 1][i]);
    return column;
}

/// From the peak of the grid to the least squares of all harmonics.
Result<double> refine(const CentredPoints& points, double peak, int harmonics) {
    constexpr int most_rounds = 100;
    const double line_width = 1 / points.span();
    double frequency = peak;
    for (int round = 0; round < most_rounds; ++round) {
        auto columns = harmonic_columns(points, frequency, harmonics);
        const auto fit = fit_columns(columns, *points.deviations);
        columns.push_back(frequency_column(points, columns, fit.coefficients));
        const double size = std::fabs(*std::ranges::max_element(
            columns.back(), {}, [](double value) { return std::fabs(value); }));
        if (!(size > 0)) break;
        for (double& value : columns.back())
            value /= size;
        const auto wider = fit_columns(columns, fit.residuals);
        if (wider.condition > largest_condition) break;
        // a step of a tenth of the line width at most: the model is far from linear beyond
        const double step =
            std::clamp(wider.coefficients.back() / size, -line_width / 10, line_width / 10);
        frequency += step;
        if (std::fabs(frequency - peak) > line_width) break;
        if (std::fabs(step) <= 1e-15 * frequency) return frequency;
        if (round > 20 && std::fabs(step) <= 1e-12 * frequency) return frequency;
    }
    return refuse(Fault::bad_case, "pitch",
                  "does not settle near the highest peak; state it, or give a pitch_range");
}

double sum_of(const std::vector<Harmonic>& harmonics, double phase) {
    double sum = 0;
    for (const Harmonic& wave : harmonics)
        sum += wave.amplitude * std::cos(wave.order * phase - wave.phase_rad);
    return sum;
}

double rise_of(const std::vector<Harmonic>& harmonics, double phase) {
    double rise = 0;
    for (const Harmonic& wave : harmonics)
        rise -= wave.order * wave.amplitude * std::sin(wave.order * phase - wave.phase_rad);
    return rise;
}

/// The place between where the rise changes its sign.
double turning_point(const std::vector<Harmonic>& harmonics, double low, double high) {
    const bool rises = rise_of(harmonics, low) > 0;
    for (int k = 0; k < 60; ++k) {
        const double middle = (low + high) / 2;
        ((rise_of(harmonics, middle) > 0) == rises ? low : high) = middle;
    }
    return (low + high) / 2;
}

/// Extremes of the sum over one period: 64 places a wave of the highest, each turn in between by
/// bisection.
double peak_to_valley_of(const std::vector<Harmonic>& harmonics) {
    if (harmonics.size() == 1) return harmonics.front().peak_to_valley();
    const int places = 64 * harmonics.back().order;
    const double step = turn / places;
    Span span;
    for (int k = 0; k < places; ++k) {
        const double low = k * step, high = low + step;
        span.include(sum_of(harmonics, low));
        if ((rise_of(harmonics, low) > 0) != (rise_of(harmonics, high) > 0))
            span.include(sum_of(harmonics, turning_point(harmonics, low, high)));
    }
    return span.width();
}

/// From the phase about the middle to that about the coordinate's zero.
Harmonic harmonic_of(double cosine, double sine, int order, double turns_to_middle) {
    const double shift = turn * std::remainder(order * turns_to_middle, 1.0);
    const double phase = std::remainder(std::atan2(sine, cosine) + shift, turn);
    return {order, length_in_plane(cosine, sine), phase == -std::numbers::pi ? -phase : phase};
}

void add_residuals(const ColumnFit& fit, bool found, PeriodicError& result) {
    double squares = 0;
    for (const double residual : fit.residuals)
        squares += residual * residual;
    const std::size_t fitted = fit.coefficients.size() + (found ? 1 : 0);
    const std::size_t count = fit.residuals.size();
    result.residual_rms = std::sqrt(squares / static_cast<double>(count));
    if (count > fitted)
        result.residual_standard_deviation =
            std::sqrt(squares / static_cast<double>(count - fitted));
}

void add_remarks(PeriodicError& result) {
    if (result.points_per_period < good_points_of_a_period)
        result.remarks.push_back(plain(result.points_per_period) +
                                 " points a period: 20 or more are good");
    if (result.periods < good_periods)
        result.remarks.push_back(plain(result.periods) +
                                 " periods: slope and wave are poorly told apart below 2");
    if (result.search && result.search->false_alarm_probability > 0.01)
        result.remarks.push_back(
            "no period stands out of the noise (probability of a false alarm " +
            plain(100 * result.search->false_alarm_probability) + " %)");
}

Result<PeriodicError>
evaluate_at(const CentredPoints& points, double frequency, int harmonics, bool found) {
    const auto fit =
        fit_columns(harmonic_columns(points, frequency, harmonics), *points.deviations);
    if (fit.condition > largest_condition)
        return refuse(Fault::bad_case, "positions",
                      "do not tell offset, slope and harmonics apart at this pitch");
    PeriodicError result;
    result.pitch = 1 / frequency;
    result.slope = fit.coefficients[1] / points.half_span;
    result.offset = fit.coefficients[0] - result.slope * points.middle;
    for (int h = 1; h <= harmonics; ++h) {
        const std::size_t k = 2 * static_cast<std::size_t>(h);
        result.harmonics.push_back(harmonic_of(fit.coefficients[k], fit.coefficients[k + 1], h,
                                               points.middle * frequency));
    }
    result.peak_to_valley = peak_to_valley_of(result.harmonics);
    result.points_per_period = result.pitch / points.mean_step();
    result.periods = points.span() * frequency;
    result.condition = fit.condition;
    add_residuals(fit, found, result);
    return result;
}

} // namespace

Result<PeriodicError> fit_periodic_error(const PeriodicQuestion& question) {
    AXISCAL_CHECK(check_question(question));
    AXISCAL_TRY(const CentredPoints points, centre(question));
    std::optional<PitchSearch> search;
    double frequency = 0;
    if (question.pitch) {
        AXISCAL_CHECK(check_pitch(points, *question.pitch, question.harmonics));
        frequency = 1 / *question.pitch;
    } else {
        AXISCAL_TRY(const Peak peak, search_pitch(points, question));
        AXISCAL_TRY(frequency, refine(points, peak.frequency, question.harmonics));
        search = weigh_peak(points, frequency, peak.range);
    }
    AXISCAL_TRY(PeriodicError result,
                evaluate_at(points, frequency, question.harmonics, search.has_value()));
    if (question.pitch) result.pitch = *question.pitch;
    result.search = search;
    add_remarks(result);
    return result;
}

} // namespace axiscal
