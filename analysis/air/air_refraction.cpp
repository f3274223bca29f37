// Sources: P. E. Ciddor, Applied Optics 35 (1996) 1566; modified Edlen equation as published by
// Birch and Downs (Metrologia 31, 1994) with the temperature factor of NIST's Engineering Metrology
// Toolbox; IAPWS-IF97 region 4 and the IAPWS sublimation curve for saturation.

#include "analysis/air/air_refraction.hpp"

#include "analysis/air/air_formulas.hpp"

namespace axiscal {
namespace {

AirTerms terms_of(const AirState& air) {
    const double wavelength_um = air.vacuum_wavelength.in(um);
    return {air.temperature.in_celsius(),
            air.temperature.in_kelvin(),
            air.pressure.si(),
            air.relative_humidity.si() * saturation_vapour_pressure(air.temperature).si(),
            1 / (wavelength_um * wavelength_um),
            air.co2_ppm};
}

bool within(double value, double low, double high) {
    return value >= low && value <= high; // false for NaN
}

Result<void> check_possible(const AirState& air) {
    if (!within(air.temperature.in_celsius(), -100, 100))
        return refuse(Fault::bad_request, "air temperature", "must lie in -100..100 degC");
    if (!within(air.relative_humidity.si(), 0, 1))
        return refuse(Fault::bad_request, "relative humidity", "must lie in 0..100 %");
    if (!within(air.vacuum_wavelength.in(nm), 300, 2000))
        return refuse(Fault::bad_request, "vacuum wavelength", "must lie in 300..2000 nm");
    if (!within(air.co2_ppm, 0, 1e5))
        return refuse(Fault::bad_request, "CO2", "must lie in 0..100000 ppm");
    const double vapour_Pa =
        air.relative_humidity.si() * saturation_vapour_pressure(air.temperature).si();
    if (!within(air.pressure.si(), 1, 1e6) || air.pressure.si() <= vapour_Pa)
        return refuse(Fault::bad_request, "air pressure",
                      "must lie in 1..1000000 Pa and above the pressure of its water vapour");
    return {};
}

std::vector<std::string> remarks_on(AirFormula formula, const AirState& air) {
    const bool is_ciddor = formula == AirFormula::ciddor;
    const std::string name = is_ciddor ? "Ciddor" : "modified Edlen";
    std::vector<std::string> remarks;
    if (!within(air.temperature.in_celsius(), is_ciddor ? -40 : 0, is_ciddor ? 100 : 40))
        remarks.push_back("air temperature outside the range of the " + name + " equation");
    if (!within(air.pressure.si(), 60e3, 120e3))
        remarks.push_back("air pressure outside 60..120 kPa of the " + name + " equation");
    if (!within(air.vacuum_wavelength.in(nm), 350, 1600))
        remarks.push_back("wavelength outside 350..1600 nm of the " + name + " equation");
    return remarks;
}

} // namespace

Pressure saturation_vapour_pressure(Temperature temperature) {
    const double kelvins = temperature.in_kelvin();
    return pascal(temperature.in_celsius() >= 0 ? saturation_over_water_Pa(kelvins)
                                                : saturation_over_ice_Pa(kelvins));
}

Result<Refractivity> refractivity_of(AirFormula formula, const AirState& air) {
    if (auto possible = check_possible(air); !possible) return tl::unexpected(possible.error());
    const AirTerms terms = terms_of(air);
    return Refractivity{formula == AirFormula::ciddor ? ciddor_n_minus_1(terms)
                                                      : edlen_nist_n_minus_1(terms),
                        remarks_on(formula, air)};
}

} // namespace axiscal
