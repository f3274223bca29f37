#include "analysis/air/air_index.hpp"
#include "tools/axiscal/cases/case_reader.hpp"
#include "tools/axiscal/cases/cases.hpp"

#include <algorithm>
#include <array>

namespace axiscal {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

struct NamedModel {
    std::string_view name;
    AirModel model;
};
constexpr std::array models{NamedModel{"ciddor", AirModel::ciddor},
                            NamedModel{"edlen_nist", AirModel::edlen_nist},
                            NamedModel{"birch_downs", AirModel::birch_downs},
                            NamedModel{"bonsch_potulski", AirModel::bonsch_potulski}};

Result<NamedModel> air_model_of(const json& object) {
    Words names;
    for (const NamedModel& model : models)
        names.emplace_back(model.name);
    AXISCAL_TRY(const std::string name, one_of(object, "model", "model", names));
    return *std::ranges::find(models, name, &NamedModel::name);
}

Result<void>
read_optional(const json& object, const std::string& key, std::optional<double>& value) {
    if (!object.contains(key)) return {};
    AXISCAL_TRY(value, number_at(object, key, key));
    return {};
}

Result<AirConditions> conditions_of(const json& object) {
    AirConditions air;
    AXISCAL_TRY(air.vacuum_wavelength_nm,
                number_at(object, "vacuum_wavelength_nm", "vacuum_wavelength_nm"));
    AXISCAL_TRY(air.temperature_degC, number_at(object, "temperature_degC", "temperature_degC"));
    AXISCAL_TRY(air.pressure_Pa, number_at(object, "pressure_Pa", "pressure_Pa"));
    AXISCAL_CHECK(
        read_optional(object, "relative_humidity_percent", air.relative_humidity_percent));
    AXISCAL_CHECK(read_optional(object, "vapour_pressure_Pa", air.vapour_pressure_Pa));
    AXISCAL_CHECK(read_optional(object, "co2_ppm", air.co2_ppm));
    if (object.contains("saturation")) {
        AXISCAL_TRY(const std::string form,
                    one_of(object, "saturation", "saturation", {"iapws", "ciddor"}));
        if (form == "ciddor") air.saturation = SaturationForm::ciddor;
    }
    return air;
}

/// Pa and degrees Celsius are asked for; weather stations tell hPa or mmHg, formulas kelvins.
Result<void> check_units(const AirConditions& air) {
    constexpr double highest_mistaken_Pa = 1200, lowest_kelvin = 250, highest_kelvin = 350;
    if (air.pressure_Pa > 0.5 && air.pressure_Pa <= highest_mistaken_Pa)
        return refuse(Fault::bad_case, "pressure_Pa",
                      "is no pressure of air in Pa: 1013.25 hPa (mbar), 101.325 kPa and 760 mmHg "
                      "are 101325 Pa");
    if (air.temperature_degC >= lowest_kelvin && air.temperature_degC <= highest_kelvin)
        return refuse(Fault::bad_case, "temperature_degC",
                      "looks like kelvins: 293.15 K are 20 degC");
    return {};
}

ordered_json validity_json(AirModel model) {
    ordered_json object;
    for (const AirRange& range : validity_of(model))
        object[range.name] = {range.low, range.high};
    return object;
}

} // namespace

Result<ordered_json> air_index_case(const json& object) {
    AXISCAL_CHECK(check_object(object, "",
                               {"analysis", "model", "vacuum_wavelength_nm", "temperature_degC",
                                "pressure_Pa", "relative_humidity_percent", "vapour_pressure_Pa",
                                "co2_ppm", "saturation"}));
    AXISCAL_TRY(const NamedModel named, air_model_of(object));
    AXISCAL_TRY(const AirConditions air, conditions_of(object));
    AXISCAL_CHECK(check_units(air));
    AXISCAL_TRY(const AirIndex index, air_index_of(named.model, air));
    ordered_json answer;
    answer["format"] = "axiscal.result/1";
    answer["model"] = named.name;
    answer["n_minus_1"] = index.n_minus_1;
    answer["vapour_pressure_Pa"] = index.vapour_pressure_Pa;
    if (index.co2_ppm) answer["co2_ppm"] = *index.co2_ppm;
    if (named.model == AirModel::bonsch_potulski)
        answer["note"] = "constants of this formula from memory of the paper, not seen in print";
    if (!index.ignored.empty()) answer["ignored"] = index.ignored;
    if (!index.outside_validity.empty()) answer["outside_validity"] = index.outside_validity;
    answer["validity"] = validity_json(named.model);
    return answer;
}

} // namespace axiscal
