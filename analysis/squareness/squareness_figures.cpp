#include "analysis/squareness/squareness_figures.hpp"

#include "analysis/straightness/recorded_line_of.hpp"

#include <algorithm>
#include <utility>

namespace axiscal {
namespace {

/// Of each of the three references what `angle_by` gives of it, and their spread.
template <class AngleBy> Squareness by_each_reference(AngleBy angle_by) {
    Squareness out;
    for (double Squareness::*const reference :
         {&Squareness::end_points, &Squareness::least_squares, &Squareness::minimum_zone})
        out.*reference = angle_by(reference);
    const auto [low, high] = std::minmax({out.end_points, out.least_squares, out.minimum_zone});
    out.method_spread = high - low;
    return out;
}

SquareLines square_lines(StraightnessLine first, StraightnessLine second) {
    SquareLines lines{std::move(first), std::move(second), {}};
    lines.apparent = squareness_of({lines.first.against, 1}, {lines.second.against, 1});
    return lines;
}

Result<SquareLines> square_lines_of(const OtherSquare& other) {
    AXISCAL_TRY(StraightnessLine first, line_of(other.first));
    AXISCAL_TRY(StraightnessLine second, line_of(other.second));
    return square_lines(std::move(first), std::move(second));
}

/// +1 where the error of the square counts as stated, -1 where it is turned.
double sign_of(SquarePosition square) {
    return square == SquarePosition::turned ? -1 : 1;
}

/// The square's error counts in one apparent angle with each sign: their mean is free of it.
void part_square(SquarenessFigures& figures, double sign, const Squareness& other) {
    const Squareness& own = figures.lines.apparent;
    figures.by_reversal = true;
    figures.square_error_rad = sign * (other.least_squares - own.least_squares) / 2;
    figures.squareness = by_each_reference(
        [&](double Squareness::*reference) { return (own.*reference + other.*reference) / 2; });
}

void take_out_square(SquarenessFigures& figures, double sign, double error_rad) {
    const Squareness& own = figures.lines.apparent;
    figures.square_error_rad = error_rad;
    figures.squareness = by_each_reference(
        [&](double Squareness::*reference) { return own.*reference + sign * error_rad; });
}

} // namespace

Result<StraightnessLine> line_of(const RecordedLine& recorded) {
    auto found = evaluate_straightness(readings_of(recorded));
    if (!found) return tl::unexpected<Error>(std::move(found).error());
    return std::move(found->mean);
}

Result<SquarenessFigures> evaluate_squareness(const StraightnessLine& second,
                                              const SquarenessSetup& setup) {
    AXISCAL_TRY(StraightnessLine first, line_of(setup.first));
    SquarenessFigures figures;
    figures.lines = square_lines(std::move(first), second);
    const double sign = sign_of(setup.square);
    if (!setup.other) {
        take_out_square(figures, sign, setup.stated.error.value_or(Angle{}).in(radian));
        return figures;
    }
    AXISCAL_TRY(figures.other, square_lines_of(*setup.other));
    part_square(figures, sign, figures.other->apparent);
    return figures;
}

} // namespace axiscal
