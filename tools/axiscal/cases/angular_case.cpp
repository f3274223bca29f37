#include "acquisition/documents/positioning/result_json.hpp"
#include "analysis/positioning/positioning_accuracy.hpp"
#include "tools/axiscal/cases/case_reader.hpp"
#include "tools/axiscal/cases/cases.hpp"
#include "tools/axiscal/cases/line_reader.hpp"

#include <utility>

namespace axiscal {

using nlohmann::json;
using nlohmann::ordered_json;

Result<ordered_json> angular_case(const json& object) {
    AXISCAL_CHECK(check_object(object, "",
                               {"analysis", "axis", "motion", "unit", "target_unit", "targets",
                                "deviations", "forward", "backward"}));
    AXISCAL_TRY(const std::string unit,
                one_of(object, "unit", "unit", {"rad", "urad", "um/m", "arcsec", "deg"}));
    AXISCAL_TRY(const std::string target_unit,
                one_of(object, "target_unit", "target_unit", {"mm", "um", "m", "deg"}));
    if (object.contains("motion")) {
        AXISCAL_TRY(const auto motion,
                    one_of(object, "motion", "motion", {"pitch", "yaw", "roll", "rotation"}));
    }
    AXISCAL_TRY(auto targets, numbers_at(object, "targets", "targets"));
    AXISCAL_TRY(DeviationTable table, read_table(object, "", "deviations", std::move(targets)));
    table.unit = unit;
    AXISCAL_TRY(const RunAt20C run,
                declare_at_20C(std::move(table), "angles have no length to bring to 20 degC"));
    ordered_json answer =
        result_to_json(evaluate_positioning(run, "ISO 230-1:2012, scheme of ISO 230-2:2014"));
    answer["target_unit"] = target_unit;
    answer["rad_per_unit"] = angle_unit_rad(unit);
    return answer;
}

} // namespace axiscal
