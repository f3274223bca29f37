#include "analysis/squareness/squareness_budget.hpp"

#include "analysis/checked_numbers.hpp"
#include "analysis/straightness/run_straightness.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace axiscal {
namespace {

constexpr double root_3 = std::numbers::sqrt3;
constexpr double um_a_metre = 1e6;

/// One line as its slope counts in the squareness.
struct CountedLine {
    std::size_t axis = 0; ///< 0: the first, 1: the second
    double weight = 1;
    double readings = 1; ///< in each mean
    double scatter_um = 0;
    double length_um = 0;
    double squares = 0; ///< Q: sum (x - mean)^2, um^2
    double arms = 0;    ///< sum |x - mean|, um
};

void add_arms(CountedLine& counted, const std::vector<double>& positions) {
    const double start = positions.front(); // about the first one: a far origin costs no digits
    double mean = 0;
    for (const double x : positions)
        mean += (x - start) / static_cast<double>(positions.size());
    for (const double x : positions) {
        const double arm = x - start - mean;
        counted.squares += arm * arm;
        counted.arms += std::fabs(arm);
    }
    counted.length_um = positions.back() - start;
}

CountedLine counted_line(std::size_t axis, const StraightnessLine& line) {
    CountedLine counted;
    counted.axis = axis;
    add_arms(counted, line.line.positions);
    return counted;
}

CountedLine
counted_line(std::size_t axis, const StraightnessLine& line, const RecordedLine& recorded) {
    CountedLine counted = counted_line(axis, line);
    const bool both_ways = !recorded.rows.empty() && recorded.rows.front().backward.has_value();
    counted.readings = (both_ways ? 2.0 : 1.0) * recorded.readings;
    counted.scatter_um = recorded.scatter.in(um);
    return counted;
}

bool is_one_run(const RecordedLine& a, const RecordedLine& b) {
    return !a.run_id.empty() && a.run_id == b.run_id;
}

/// Where the second axis alone was measured again, the line of the first stands in both halves:
/// its errors are the same ones, and it counts whole.
std::vector<CountedLine> counted_lines(const SquarenessFigures& figures,
                                       const SquarenessSetup& setup,
                                       int readings_a_mean,
                                       double scatter_um) {
    std::vector<CountedLine> lines{counted_line(0, figures.lines.first, setup.first),
                                   counted_line(1, figures.lines.second)};
    lines[1].readings = readings_a_mean;
    lines[1].scatter_um = scatter_um;
    if (!figures.other || !setup.other) return lines;
    const bool once = is_one_run(setup.first, setup.other->first);
    if (!once) lines.push_back(counted_line(0, figures.other->first, setup.other->first));
    lines.push_back(counted_line(1, figures.other->second, setup.other->second));
    for (CountedLine& line : lines)
        line.weight = once && line.axis == 0 ? 1 : 0.5;
    return lines;
}

/// What is stated, as standard uncertainties; absent: not stated.
struct SquarenessInputs {
    bool by_reversal = false;
    double apparent_rad = 0; ///< by reversal the mean of both
    StraightnessInputs optics;
    std::optional<double> square_u_rad, mount_limit_rad;
};

std::optional<double> square_u(const SquareStatement& stated, bool by_reversal) {
    if (by_reversal) return 0.0;
    if (stated.error_U) return stated.error_U->in(radian) / stated.error_k;
    if (stated.error_limit) return stated.error_limit->in(radian) / root_3;
    return std::nullopt;
}

SquarenessInputs squareness_inputs(const SquarenessFigures& figures, const SquarenessSetup& setup) {
    SquarenessInputs in;
    in.by_reversal = figures.by_reversal;
    in.apparent_rad = figures.lines.apparent.least_squares;
    if (figures.other)
        in.apparent_rad = (in.apparent_rad + figures.other->apparent.least_squares) / 2;
    in.optics = inputs_of(setup.optics, 0, 1);
    in.square_u_rad = square_u(setup.stated, figures.by_reversal);
    if (setup.stated.mount_limit) in.mount_limit_rad = setup.stated.mount_limit->in(radian);
    return in;
}

Result<void> check_not_negative(const std::optional<double>& value, const std::string& field) {
    if (!value) return {};
    AXISCAL_CHECK(check_case_number(*value, field));
    if (*value < 0) return refuse(Fault::bad_case, field, "is negative");
    return {};
}

Result<void> check_squareness_inputs(const SquarenessInputs& in,
                                     const std::vector<CountedLine>& lines) {
    if (!in.optics.wollaston)
        return refuse(Fault::bad_case, "method", "of the optics is not a Wollaston prism");
    AXISCAL_CHECK(check_not_negative(in.optics.factor_u, "factor_u"));
    AXISCAL_CHECK(check_not_negative(in.optics.mirror_limit_um_per_m2, "mirror_limit_um_per_m2"));
    AXISCAL_CHECK(check_not_negative(in.optics.resolution, "resolution"));
    AXISCAL_CHECK(check_not_negative(in.optics.eve, "eve"));
    AXISCAL_CHECK(check_not_negative(in.square_u_rad, "square_u"));
    AXISCAL_CHECK(check_not_negative(in.mount_limit_rad, "mount_limit"));
    for (const CountedLine& line : lines) {
        AXISCAL_CHECK(check_not_negative(line.scatter_um, "scatter"));
        if (line.readings < 1)
            return refuse(Fault::bad_case, "readings_a_mean", "must be at least 1");
    }
    return {};
}

/// The given value times `factor`, where there is one.
std::optional<double> scaled(const std::optional<double>& value, double factor) {
    return value ? std::optional{*value * factor} : std::nullopt;
}

/// For a limit of 1 um over 1 m. One mirror shows the same form to both lines of an axis, whose
/// errors then add up; each axis may see another part of it.
double slope_by_mirror(const std::vector<CountedLine>& lines) {
    std::array<double, 2> of_axis{};
    for (const CountedLine& line : lines) {
        const double length_m = line.length_um / um_a_metre;
        of_axis[line.axis] += line.weight * length_m * length_m * line.arms / line.squares;
    }
    return std::sqrt(of_axis[0] * of_axis[0] + of_axis[1] * of_axis[1]);
}

/// For an error of 1 um of each mean by itself.
double slope_by_mean(const std::vector<CountedLine>& lines) {
    double sum = 0;
    for (const CountedLine& line : lines)
        sum += line.weight * line.weight / line.squares;
    return std::sqrt(sum);
}

/// The scatter of the readings holds the environment; E_VE alone may have been taken on a calm day.
std::optional<double> environment_u(const std::optional<double>& eve,
                                    const std::vector<CountedLine>& lines) {
    if (!eve) return std::nullopt;
    double sum = 0;
    for (const CountedLine& line : lines) {
        const double one = line.weight * std::max(*eve / (2 * root_3), line.scatter_um);
        sum += one * one / (line.readings * line.squares);
    }
    return std::sqrt(sum);
}

/// One term with what it gives of the squareness; no value: not stated.
struct SquarenessTermFound {
    SquarenessTerm term = SquarenessTerm::factor;
    std::optional<double> u_rad;
    std::string formula;
};

std::vector<SquarenessTermFound> squareness_terms(const SquarenessInputs& in,
                                                  const std::vector<CountedLine>& lines) {
    const bool both = in.by_reversal;
    const double halves = both ? 1 / std::numbers::sqrt2 : 1;
    return {
        {SquarenessTerm::factor, scaled(in.optics.factor_u, std::fabs(in.apparent_rad)),
         both ? "|mean apparent angle| u(f)/f" : "|apparent angle| u(f)/f"},
        {SquarenessTerm::mirror,
         scaled(in.optics.mirror_limit_um_per_m2, slope_by_mirror(lines) / root_3),
         "sqrt(sum (sum w a L^2 sum|x - mean|/Q)^2)/sqrt(3)"},
        {SquarenessTerm::square, in.square_u_rad, both ? "0: by reversal" : "U/k or limit/sqrt(3)"},
        {SquarenessTerm::mount, scaled(in.mount_limit_rad, halves / root_3),
         both ? "limit/sqrt(3)/sqrt(2)" : "limit/sqrt(3)"},
        {SquarenessTerm::resolution,
         scaled(in.optics.resolution, slope_by_mean(lines) / (2 * root_3)),
         "q/(2 sqrt(3)) sqrt(sum w^2/Q)"},
        {SquarenessTerm::environment, environment_u(in.optics.eve, lines),
         "sqrt(sum w^2 max(E_VE/(2 sqrt(3)), s)^2/(N Q))"},
    };
}

void combine(SquarenessBudget& budget, std::vector<SquarenessTermFound> terms) {
    double squares = 0;
    for (SquarenessTermFound& found : terms) {
        if (!found.u_rad) {
            budget.not_stated.emplace_back(name_of(found.term));
            continue;
        }
        squares += *found.u_rad * *found.u_rad;
        budget.contributions.push_back({found.term, *found.u_rad, std::move(found.formula)});
    }
    if (!budget.not_stated.empty()) return;
    budget.u_rad = std::sqrt(squares);
    budget.expanded_rad = budget.coverage * *budget.u_rad;
}

} // namespace

std::string_view name_of(SquarenessTerm term) {
    switch (term) {
    case SquarenessTerm::factor: return "factor";
    case SquarenessTerm::mirror: return "mirror";
    case SquarenessTerm::square: return "square";
    case SquarenessTerm::mount: return "mount";
    case SquarenessTerm::resolution: return "resolution";
    case SquarenessTerm::environment: return "environment";
    }
    return "?";
}

Result<SquarenessBudget> make_squareness_budget(const SquarenessFigures& figures,
                                                const SquarenessSetup& setup,
                                                int readings_a_mean,
                                                double scatter_um) {
    const auto lines = counted_lines(figures, setup, readings_a_mean, scatter_um);
    const SquarenessInputs in = squareness_inputs(figures, setup);
    AXISCAL_CHECK(check_squareness_inputs(in, lines));
    SquarenessBudget budget;
    budget.by_scatter = in.optics.eve && std::ranges::any_of(lines, [&](const CountedLine& line) {
                            return line.scatter_um > *in.optics.eve / (2 * root_3);
                        });
    combine(budget, squareness_terms(in, lines));
    return budget;
}

} // namespace axiscal
