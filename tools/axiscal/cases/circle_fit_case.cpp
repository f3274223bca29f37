#include "analysis/circle/circle_fit.hpp"
#include "tools/axiscal/cases/case_reader.hpp"
#include "tools/axiscal/cases/cases.hpp"

#include <utility>

namespace axiscal {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

struct Points {
    std::vector<double> x, y;
};

Result<void> add_point(Points& points, const json& point, std::size_t index) {
    if (!point.is_array() || point.size() != 2)
        return refuse(Fault::bad_case, indexed("points", index), "must be [x, y]");
    for (std::size_t k = 0; k < 2; ++k) {
        std::vector<double>& values = k == 0 ? points.x : points.y;
        if (point[k].is_number()) {
            values.push_back(point[k].get<double>());
            continue;
        }
        // a million names of fields would take longer than the fits: only the wrong one gets its
        auto refused = number_of(point[k], indexed(indexed("points", index), k));
        return tl::unexpected(std::move(refused).error());
    }
    return {};
}

Result<Points> points_of(const json& object) {
    AXISCAL_TRY(const json* list, member(object, "points", "points"));
    if (!list->is_array()) return refuse(Fault::bad_case, "points", "must be an array of [x, y]");
    Points points;
    points.x.reserve(list->size());
    points.y.reserve(list->size());
    for (std::size_t i = 0; i < list->size(); ++i)
        AXISCAL_CHECK(add_point(points, (*list)[i], i));
    return points;
}

ordered_json circle_json(const PlainCircle& circle) {
    return {{"x", circle.x}, {"y", circle.y}, {"radius", circle.radius}};
}

const char* name_of(ZoneSearch search) {
    switch (search) {
    case ZoneSearch::local: return "local";
    case ZoneSearch::multi_start: return "multi_start";
    case ZoneSearch::exhaustive: return "exhaustive";
    }
    return "local";
}

ordered_json zone_json(const MinimumZoneCircle& zone) {
    ordered_json object{{"x", zone.x},
                        {"y", zone.y},
                        {"outer_radius", zone.outer_radius},
                        {"inner_radius", zone.inner_radius},
                        {"width", zone.width},
                        {"gap", zone.gap}};
    object["control_points"] = ordered_json::array();
    for (const ControlPoint& point : zone.control_points)
        object["control_points"].push_back(
            {{"index", point.index}, {"side", point.side == ZoneSide::outer ? "outer" : "inner"}});
    object["certified"] = "local optimum";
    object["search"] = name_of(zone.search);
    object["wide"] = zone.wide;
    if (zone.wide)
        object["note"] =
            "the zone is wider than a tenth of the radius: other optima may exist, and "
            "the certificate is of this one";
    if (zone.strip)
        object["note"] = "the zone tends to a strip: its radius was held at a million extents";
    return object;
}

} // namespace

Result<ordered_json> circle_fit_case(const json& object) {
    AXISCAL_CHECK(check_object(object, "", {"analysis", "points", "unit"}));
    std::string unit;
    if (object.contains("unit")) {
        AXISCAL_TRY(unit, one_of(object, "unit", "unit", {"um", "mm", "m"}));
    }
    AXISCAL_TRY(const Points points, points_of(object));
    const auto& [x, y] = points;
    AXISCAL_TRY(const LeastSquaresCircle mean, fit_least_squares_circle(x, y));
    AXISCAL_TRY(const MinimumZoneCircle zone, fit_minimum_zone_circle(x, y));
    AXISCAL_TRY(const PlainCircle around, fit_minimum_circumscribed_circle(x, y));
    const auto inside = fit_maximum_inscribed_circle(x, y);
    ordered_json answer;
    answer["format"] = "axiscal.result/1";
    answer["standard"] = "ISO 230-4";
    if (!unit.empty()) answer["unit"] = unit;
    answer["least_squares"] = {
        {"x", mean.x}, {"y", mean.y}, {"radius", mean.radius}, {"condition", mean.condition}};
    answer["minimum_zone"] = zone_json(zone);
    answer["minimum_circumscribed"] = circle_json(around);
    if (inside)
        answer["maximum_inscribed"] = circle_json(*inside);
    else
        answer["not_evaluated"]["maximum_inscribed"] = inside.error().detail;
    answer["arc_deg"] = arc_of_points_deg(x, y, mean.x, mean.y);
    return answer;
}

} // namespace axiscal
