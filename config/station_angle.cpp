// [axis.angle]: the artefact beside which the angle of a rotary axis is read.
#include "config/station_readers.hpp"

#include <cmath>

namespace axiscal {
namespace {

using namespace std::chrono_literals;

constexpr double turn_deg = 360;

bool divides_a_turn(double step_deg) {
    constexpr double rounding = 1e-9;
    const double positions = turn_deg / step_deg;
    return std::fabs(positions - std::round(positions)) < rounding * positions;
}

void read_table(Settings& angle, RotarySetup& setup) {
    setup.step_deg = angle.rotary_length("step", mm(0.05), mm(10)).in(mm);
    if (!angle.refused("step") && !divides_a_turn(setup.step_deg))
        angle.refuse("step", "does not divide a turn of 360 deg: take it from the maker's data");
    setup.arm = angle.length("arm", mm(1), mm(1000));
    setup.range_deg = angle.rotary_length("range", mm(0.1), mm(15), mm(10)).in(mm);
    setup.turn_time = angle.duration("turn_time", 0s, 10min, 8s);
    setup.by_hand = angle.flag("by_hand", false);
    // A stride of the axis is at least one step, and half a step is left before it.
    if (!angle.refused("step") && !angle.refused("range") && setup.range_deg < 1.5 * setup.step_deg)
        angle.refuse("range", "is less than one and a half steps: the table could not be turned "
                              "back before the beam is lost; take a table with a finer step");
}

void read_polygon(Settings& angle, RotarySetup& setup) {
    constexpr int fewest = 3, most = 72;
    setup.method = AngleMethod::polygon;
    const auto faces = angle.integer("faces", fewest, most);
    setup.step_deg = turn_deg / static_cast<double>(std::max<std::int64_t>(faces, fewest));
    setup.range_deg = angle.rotary_length("range", mm(0.001), mm(5), mm(0.2)).in(mm);
}

void read_certificate(Settings& angle, RotarySetup& setup, InstrumentRecord& artefact) {
    artefact.maker = angle.text("maker", "");
    artefact.model = angle.text("model", "");
    artefact.serial = angle.text("serial", "");
    read_certificate_dates(angle, artefact);
    const std::vector<Length> stated =
        angle.rotary_lengths("deviations", mm(-1), mm(1), std::vector<Length>{});
    setup.certificate_with_axis = angle.choice("certificate_sense", {"with_axis", "against_axis"},
                                               "with_axis") == "with_axis";
    if (stated.empty()) return;
    if (!angle.has("certificate_sense"))
        angle.refuse("certificate_sense", "is missing: say in which sense the deviations count, "
                                          "\"with_axis\" or \"against_axis\"");
    constexpr double arcsec_per_degree = 3600;
    setup.deviations_arcsec.reserve(stated.size());
    for (const Length deviation : stated)
        setup.deviations_arcsec.push_back(deviation.in(mm)*arcsec_per_degree);
    const auto wanted = static_cast<std::size_t>(std::lround(turn_deg / setup.step_deg));
    if (!angle.refused("deviations") && setup.deviations_arcsec.size() != wanted)
        angle.refuse("deviations", "has " + std::to_string(setup.deviations_arcsec.size()) +
                                       " values, and the turn has " + std::to_string(wanted) +
                                       " positions: give one for each, that of position 0 first");
}

} // namespace

AngleConfig read_angle(Settings angle, bool has_laser, const StationConfig& station) {
    AngleConfig config;
    const bool polygon = angle.choice("method", {"indexing-table", "polygon"}) == "polygon";
    if (polygon)
        read_polygon(angle, config.setup);
    else
        read_table(angle, config.setup);
    if (polygon && angle.has("autocollimator"))
        config.autocollimator = read_role(angle, "autocollimator", station);
    config.artefact.name = polygon ? "polygon" : "indexing table";
    config.artefact.driver = "none";
    read_certificate(angle, config.setup, config.artefact);
    if (!angle.refused("method") && polygon == has_laser)
        angle.refuse("method",
                     polygon ? "is read by an autocollimator: remove axis.laser, and name the instrument "
                               "as axis.angle.autocollimator, if it is one"
                             : "needs the angular interferometer: name its channel in axis.laser");
    return config;
}

} // namespace axiscal
