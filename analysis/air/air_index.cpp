#include "analysis/air/air_index.hpp"

#include "analysis/air/air_formulas.hpp"

#include <array>
#include <cmath>

namespace axiscal {
namespace {

constexpr double zero_celsius_K = 273.15;
constexpr double critical_water_K = 647.096; // IAPWS

bool uses_co2(AirModel model) {
    return model == AirModel::ciddor || model == AirModel::bonsch_potulski;
}

double usual_co2_ppm(AirModel model) {
    return model == AirModel::bonsch_potulski ? 400 : 450;
}

Result<void> impossible(const char* field, const char* reason) {
    return refuse(Fault::bad_case, field, reason);
}

/// Poles of the dispersion formula, 1/um^2.
std::array<double, 2> poles_of(AirModel model) {
    if (model == AirModel::ciddor) return {238.0185, 57.362};
    return {130, 38.9};
}

Result<void> check_wavelength(AirModel model, double nanometres) {
    if (!std::isfinite(nanometres) || !(nanometres > 0))
        return impossible("vacuum_wavelength_nm", "must be larger than 0");
    const double inverse_square_um = 1e6 / nanometres / nanometres;
    if (!std::isfinite(inverse_square_um))
        return impossible("vacuum_wavelength_nm", "is too short for any formula");
    for (const double pole : poles_of(model))
        if (std::fabs(inverse_square_um / pole - 1) < 0.02)
            return impossible("vacuum_wavelength_nm", "lies in a resonance of the formula");
    if (inverse_square_um > poles_of(model).back())
        return impossible(
            "vacuum_wavelength_nm",
            "is shorter than a resonance of the formula (a helium-neon laser has 632.99)");
    return {};
}

Result<void> check_humidity_key(const AirConditions& air) {
    if (air.relative_humidity_percent && air.vapour_pressure_Pa)
        return impossible("vapour_pressure_Pa",
                          "stands beside relative_humidity_percent; exactly one is needed");
    if (!air.relative_humidity_percent && !air.vapour_pressure_Pa)
        return impossible("relative_humidity_percent",
                          "is missing; it or vapour_pressure_Pa is needed");
    if (air.vapour_pressure_Pa && !(*air.vapour_pressure_Pa >= 0))
        return impossible("vapour_pressure_Pa", "must be 0 or more");
    if (air.relative_humidity_percent && !(*air.relative_humidity_percent >= 0))
        return impossible("relative_humidity_percent", "must be 0 or more");
    return {};
}

Result<void> check_possible(AirModel model, const AirConditions& air) {
    AXISCAL_CHECK(check_wavelength(model, air.vacuum_wavelength_nm));
    if (!std::isfinite(air.temperature_degC) || !(air.temperature_degC > -zero_celsius_K))
        return impossible("temperature_degC", "must be above -273.15 degC");
    if (!std::isfinite(air.pressure_Pa) || !(air.pressure_Pa >= 0))
        return impossible("pressure_Pa", "must be 0 or more");
    if (air.co2_ppm && !(*air.co2_ppm >= 0 && *air.co2_ppm <= 1e6))
        return impossible("co2_ppm", "must lie in 0..1000000 ppm");
    return check_humidity_key(air);
}

/// Empty above the critical point of water.
std::optional<double> saturation_Pa(const AirConditions& air) {
    const double kelvins = air.temperature_degC + zero_celsius_K;
    if (kelvins > critical_water_K) return std::nullopt;
    if (air.saturation == SaturationForm::ciddor) return saturation_of_ciddor_Pa(kelvins);
    return air.temperature_degC >= 0 ? saturation_over_water_Pa(kelvins)
                                     : saturation_over_ice_Pa(kelvins);
}

Result<double> vapour_of(const AirConditions& air) {
    double vapour_Pa = air.vapour_pressure_Pa.value_or(0);
    const char* field = "vapour_pressure_Pa";
    if (air.relative_humidity_percent) {
        field = "relative_humidity_percent";
        const auto saturation = saturation_Pa(air);
        if (!saturation)
            return refuse(Fault::bad_case, field,
                          "has no meaning above the critical temperature of water, 373.946 degC; "
                          "give vapour_pressure_Pa");
        vapour_Pa = *air.relative_humidity_percent * 1e-2 * *saturation;
    }
    if (!(vapour_Pa <= air.pressure_Pa))
        return refuse(Fault::bad_case, field, "makes more vapour pressure than there is pressure");
    return vapour_Pa;
}

double n_minus_1_of(AirModel model, const AirTerms& terms) {
    switch (model) {
    case AirModel::ciddor: return ciddor_n_minus_1(terms);
    case AirModel::edlen_nist: return edlen_nist_n_minus_1(terms);
    case AirModel::birch_downs: return birch_downs_n_minus_1(terms);
    case AirModel::bonsch_potulski: break;
    }
    return bonsch_potulski_n_minus_1(terms);
}

/// In percent; of a vapour pressure only whether it is more than saturation counts.
double humidity_of(const AirConditions& air) {
    if (air.relative_humidity_percent) return *air.relative_humidity_percent;
    const auto saturation = saturation_Pa(air);
    return saturation && *air.vapour_pressure_Pa > *saturation ? 200 : 50;
}

std::vector<std::string>
outside_validity(AirModel model, const AirConditions& air, double co2_ppm) {
    const std::array<double, 5> values{air.temperature_degC, air.pressure_Pa, humidity_of(air),
                                       air.vacuum_wavelength_nm, co2_ppm};
    const auto ranges = validity_of(model);
    std::vector<std::string> names;
    for (std::size_t i = 0; i < ranges.size(); ++i)
        if (values[i] < ranges[i].low || values[i] > ranges[i].high)
            names.emplace_back(ranges[i].name);
    return names;
}

} // namespace

std::vector<AirRange> validity_of(AirModel model) {
    AirRange temperature{"temperature", 15, 25};
    if (model == AirModel::ciddor) temperature = {"temperature", -40, 100};
    if (model == AirModel::edlen_nist) temperature = {"temperature", 0, 40};
    std::vector<AirRange> ranges{temperature,
                                 {"pressure", 60e3, 120e3},
                                 {"relative_humidity", 0, 100},
                                 {"vacuum_wavelength", 350, 1600}};
    if (uses_co2(model)) ranges.push_back({"co2", 0, 2000});
    return ranges;
}

Result<AirIndex> air_index_of(AirModel model, const AirConditions& air) {
    AXISCAL_CHECK(check_possible(model, air));
    AXISCAL_TRY(const double vapour_Pa, vapour_of(air));
    const double co2_ppm = air.co2_ppm.value_or(usual_co2_ppm(model));
    const double wavelength_um = air.vacuum_wavelength_nm * 1e-3;
    const AirTerms terms{air.temperature_degC,
                         air.temperature_degC + zero_celsius_K,
                         air.pressure_Pa,
                         vapour_Pa,
                         1 / (wavelength_um * wavelength_um),
                         co2_ppm};
    AirIndex index;
    index.n_minus_1 = air.pressure_Pa > 0 ? n_minus_1_of(model, terms) : 0;
    if (!std::isfinite(index.n_minus_1) || !(index.n_minus_1 > -1))
        return refuse(Fault::bad_case, "model", "gives no refractive index for such a state");
    index.vapour_pressure_Pa = vapour_Pa;
    index.outside_validity = outside_validity(model, air, co2_ppm);
    if (uses_co2(model)) index.co2_ppm = co2_ppm;
    if (!uses_co2(model) && air.co2_ppm) index.ignored.emplace_back("co2_ppm");
    return index;
}

} // namespace axiscal
