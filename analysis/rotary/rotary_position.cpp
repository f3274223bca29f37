#include "analysis/rotary/rotary_position.hpp"

#include <cmath>
#include <cstdio>

namespace axiscal {
namespace {

constexpr double arcsec_per_degree = 3600;

std::string in_degrees(double angle_deg) {
    char text[40];
    std::snprintf(text, sizeof text, "%.4f deg", angle_deg);
    return text;
}

tl::unexpected<Error> out_of_range(const RotarySetup& setup, const std::string& rest) {
    const bool table = setup.method == AngleMethod::indexing_table;
    return fail(Fault::outside_window,
                "The rest that the " + std::string{table ? "interferometer" : "autocollimator"} +
                    " shows, " + rest + ", is beyond its range of " + in_degrees(setup.range_deg) +
                    ": " +
                    (table ? "the indexing table does not stand at the position of this target."
                           : "the face of this target does not stand before it."));
}

} // namespace

Length artefact_zero(const RotarySetup& setup, Length datum) {
    return setup.method == AngleMethod::polygon ? Length{} : datum;
}

int artefact_index(const RotarySetup& setup, Length datum, Length coordinate) {
    const double turned_deg = (coordinate - artefact_zero(setup, datum)).in(mm);
    return static_cast<int>(std::lround(turned_deg / setup.step_deg));
}

int positions_of_a_turn(const RotarySetup& setup) {
    constexpr double turn_deg = 360;
    return static_cast<int>(std::lround(turn_deg / setup.step_deg));
}

double artefact_deviation_deg(const RotarySetup& setup, int index) {
    if (setup.deviations_arcsec.empty()) return 0;
    const int count = static_cast<int>(setup.deviations_arcsec.size());
    const int place = ((index % count) + count) % count;
    const double seconds_of_arc = setup.deviations_arcsec[static_cast<std::size_t>(place)];
    return (setup.certificate_with_axis ? seconds_of_arc : -seconds_of_arc) / arcsec_per_degree;
}

Result<double> rest_deg(const RotarySetup& setup, int sign, Length since_datum, double n_minus_1) {
    if (setup.method == AngleMethod::polygon) {
        const double angle_deg = sign * since_datum.in(mm);
        if (!(std::fabs(angle_deg) <= setup.range_deg))
            return out_of_range(setup, in_degrees(angle_deg));
        return angle_deg;
    }
    const double sine = sign * (since_datum / setup.arm) / (1 + n_minus_1);
    if (!(std::fabs(sine) <= 1)) return out_of_range(setup, "more than a quarter turn");
    const double angle_deg = radian(std::asin(sine)).in(degree);
    if (std::fabs(angle_deg) > setup.range_deg) return out_of_range(setup, in_degrees(angle_deg));
    return angle_deg;
}

Result<Length> rotary_position(const RotarySetup& setup,
                               int sign,
                               const DatumRecord& datum,
                               Length reading,
                               double n_minus_1,
                               int index) {
    AXISCAL_TRY(const double rest, rest_deg(setup, sign, reading - datum.reading, n_minus_1));
    const double artefact_deg =
        artefact_deviation_deg(setup, index) - artefact_deviation_deg(setup, 0);
    return artefact_zero(setup, datum.coordinate) +
           mm(index * setup.step_deg + rest - artefact_deg);
}

Length least_reading_of_way(const RotarySetup& setup, Length way) {
    if (setup.method == AngleMethod::polygon) return way;
    const double half_step = degree(setup.step_deg / 2).in(radian);
    const double beyond = half_step + degree(way.in(mm)).in(radian);
    return setup.arm * (std::sin(beyond) - std::sin(half_step));
}

double reading_per_coordinate(const RotarySetup& setup) {
    if (setup.method == AngleMethod::polygon) return 1;
    return degree(1.0).in(radian)*setup.arm.in(mm);
}

} // namespace axiscal
