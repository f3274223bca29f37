#include "analysis/geometry/squareness.hpp"
#include "tools/axiscal/cases/case_reader.hpp"
#include "tools/axiscal/cases/cases.hpp"
#include "tools/axiscal/cases/line_reader.hpp"
#include "tools/axiscal/cases/plausibility.hpp"

#include <utility>

namespace axiscal {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

struct Units {
    std::string deviation, target;
    [[nodiscard]] double target_to_deviation() const {
        return length_unit_m(target) / length_unit_m(deviation);
    }
};

Result<Units> units_of(const json& object) {
    const Words lengths{"um", "mm", "m"};
    Units units;
    AXISCAL_TRY(units.deviation, one_of(object, "unit", "unit", lengths));
    units.target = units.deviation;
    if (object.contains("target_unit")) {
        AXISCAL_TRY(units.target, one_of(object, "target_unit", "target_unit", lengths));
    }
    return units;
}

ordered_json line_json(const ReferenceLine& line, const char* measured) {
    ordered_json object;
    object["straightness"] = line.straightness;
    object["slope"] = line.slope;
    object["offset"] = line.offset;
    object["measured"] = measured;
    object["residuals"] = line.residuals;
    return object;
}

ordered_json zone_json(const MinimumZone& zone) {
    ordered_json object = line_json(zone.line, "perpendicular to the line");
    object["gap"] = zone.gap;
    object["control_points"] = ordered_json::array();
    for (const ZonePoint& point : zone.control_points)
        object["control_points"].push_back(
            {{"index", point.index}, {"side", point.upper ? "upper" : "lower"}});
    return object;
}

void add_straightness(ordered_json& answer, const Straightness& found) {
    answer["end_points"] = line_json(found.end_points, "along the deviation");
    answer["least_squares"] = line_json(found.least_squares, "along the deviation");
    answer["minimum_zone"] = zone_json(found.minimum_zone);
}

Result<SquarenessLine> side_of(const json& object, const char* key, const Units& units) {
    AXISCAL_TRY(const json* side, member(object, key, key));
    Words keys = line_keys;
    keys.insert(keys.end(), {"axis", "positive_towards_other"});
    AXISCAL_CHECK(check_object(*side, key, keys));
    const std::string prefix = std::string{key} + ".";
    AXISCAL_TRY(const double sign,
                number_or(*side, "positive_towards_other", prefix + "positive_towards_other", 1));
    if (sign != 1 && sign != -1)
        return refuse(Fault::bad_case, prefix + "positive_towards_other", "must be 1 or -1");
    AXISCAL_TRY(const LineCase line, read_line(*side, prefix, units.target_to_deviation()));
    auto straightness = straightness_of(line.line);
    if (!straightness) return under(prefix, straightness.error());
    return SquarenessLine{*std::move(straightness), sign > 0 ? 1 : -1};
}

void add_angle(ordered_json& object, double radians) {
    object["squareness_rad"] = radians;
    object["squareness_um_per_m"] = radians * 1e6;
    object["squareness_arcsec"] = radians / arcsec.size;
}

} // namespace

Result<ordered_json> straightness_case(const json& object) {
    Words keys = line_keys;
    keys.insert(keys.end(), {"analysis", "axis", "unit", "target_unit"});
    AXISCAL_CHECK(check_object(object, "", keys));
    AXISCAL_TRY(const Units units, units_of(object));
    AXISCAL_TRY(const LineCase line, read_line(object, "", units.target_to_deviation()));
    AXISCAL_TRY(const Straightness found, straightness_of(line.line));
    ordered_json answer;
    answer["format"] = "axiscal.result/1";
    answer["standard"] = "ISO 230-1:2012";
    answer["unit"] = units.deviation;
    answer["from"] = line.repetition ? "readings" : "angles";
    add_straightness(answer, found);
    answer["line"] = line.line.deviations;
    if (line.repetition && line.repetition->parameters.B)
        answer["B"] = *line.repetition->parameters.B;
    if (!object.contains("target_unit"))
        add_remarks(unit_remarks(line.line.positions, units.deviation, "target_unit"), answer);
    return answer;
}

Result<ordered_json> squareness_case(const json& object) {
    AXISCAL_CHECK(check_object(
        object, "",
        {"analysis", "unit", "target_unit", "first", "second", "optical_square_error_urad"}));
    AXISCAL_TRY(const Units units, units_of(object));
    AXISCAL_TRY(const SquarenessLine first, side_of(object, "first", units));
    AXISCAL_TRY(const SquarenessLine second, side_of(object, "second", units));
    AXISCAL_TRY(const double error_urad,
                number_or(object, "optical_square_error_urad", "optical_square_error_urad", 0));
    if (!(error_urad >= -1e6 && error_urad <= 1e6))
        return refuse(Fault::bad_case, "optical_square_error_urad", "is larger than 1 rad");
    const Squareness found = squareness_of(first, second, error_urad * 1e-6);
    ordered_json answer;
    answer["format"] = "axiscal.result/1";
    answer["standard"] = "ISO 230-1:2012";
    add_angle(answer, found.least_squares);
    answer["reference"] = "least_squares";
    answer["sign"] = "> 0: the angle between the + directions of both axes exceeds 90 deg";
    add_angle(answer["end_points"], found.end_points);
    add_angle(answer["least_squares"], found.least_squares);
    add_angle(answer["minimum_zone"], found.minimum_zone);
    answer["method_spread_rad"] = found.method_spread;
    return answer;
}

} // namespace axiscal
