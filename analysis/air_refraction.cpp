// Sources: P. E. Ciddor, Applied Optics 35 (1996) 1566; modified Edlen equation as published by
// Birch and Downs (Metrologia 31, 1994) with the temperature factor of NIST's Engineering Metrology
// Toolbox; IAPWS-IF97 region 4 and the IAPWS sublimation curve for saturation.

#include "analysis/air_refraction.hpp"

#include <cmath>

namespace axiscal {
namespace {

double saturation_over_water_Pa(double kelvins) {
    constexpr double k1 = 1.16705214528e3, k2 = -7.24213167032e5, k3 = -1.70738469401e1,
                     k4 = 1.20208247025e4, k5 = -3.23255503223e6, k6 = 1.49151086135e1,
                     k7 = -4.82326573616e3, k8 = 4.05113405421e5, k9 = -2.38555575678e-1,
                     k10 = 6.50175348448e2;
    const double w = kelvins + k9 / (kelvins - k10);
    const double a = w * w + k1 * w + k2;
    const double b = k3 * w * w + k4 * w + k5;
    const double c = k6 * w * w + k7 * w + k8;
    const double root = 2 * c / (-b + std::sqrt(b * b - 4 * a * c));
    return 1e6 * (root * root) * (root * root);
}

double saturation_over_ice_Pa(double kelvins) {
    const double theta = kelvins / 273.16;
    const double root = std::sqrt(theta);
    const double exponent =
        -13.928169 * (1 - 1 / (theta * root)) + 34.7078238 * (1 - 1 / (theta * std::sqrt(root)));
    return 611.657 * std::exp(exponent);
}

/// The state in the units of both papers.
struct Terms {
    double t_C, kelvins, p_Pa, vapour_Pa, inverse_square_um; ///< S = 1 / lambda^2
    double co2_ppm;
};

Terms terms_of(const AirState& air) {
    const double wavelength_um = air.vacuum_wavelength.in(um);
    return {air.temperature.in_celsius(),
            air.temperature.in_kelvin(),
            air.pressure.si(),
            air.relative_humidity.si() * saturation_vapour_pressure(air.temperature).si(),
            1 / (wavelength_um * wavelength_um),
            air.co2_ppm};
}

/// Z of moist air; xv is the mole fraction of water vapour.
double compressibility(const Terms& air, double xv) {
    constexpr double a0 = 1.58123e-6, a1 = -2.9331e-8, a2 = 1.1043e-10, b0 = 5.707e-6,
                     b1 = -2.051e-8, c0 = 1.9898e-4, c1 = -2.376e-6, d = 1.83e-11, e = -0.765e-8;
    const double t = air.t_C, ratio = air.p_Pa / air.kelvins;
    return 1 - ratio * (a0 + a1 * t + a2 * t * t + (b0 + b1 * t) * xv + (c0 + c1 * t) * xv * xv) +
           ratio * ratio * (d + e * xv * xv);
}

double ciddor(const Terms& air) {
    constexpr double gas_constant = 8.314472, molar_mass_vapour = 0.018015;
    constexpr double standard_compressibility = 0.9995922115; // dry air, 15 degC, 101325 Pa
    constexpr double standard_vapour_density = 0.00985938;    // 20 degC, 1333 Pa
    const double s = air.inverse_square_um;
    const double enhancement = 1.00062 + 3.14e-8 * air.p_Pa + 5.60e-7 * air.t_C * air.t_C;
    const double xv = enhancement * air.vapour_Pa / air.p_Pa;
    const double standard_air = 1e-8 * (5792105 / (238.0185 - s) + 167917 / (57.362 - s));
    const double dry = standard_air * (1 + 5.34e-7 * (air.co2_ppm - 450));
    const double vapour =
        1.022e-8 * (295.235 + 2.6422 * s - 0.03238 * s * s + 0.004028 * s * s * s);
    const double molar_mass_dry = 0.0289635 + 1.2011e-8 * (air.co2_ppm - 400);
    const double standard_density =
        101325 * molar_mass_dry / (standard_compressibility * gas_constant * 288.15);
    const double moles = air.p_Pa / (compressibility(air, xv) * gas_constant * air.kelvins);
    const double dry_density = (1 - xv) * moles * molar_mass_dry;
    const double vapour_density = xv * moles * molar_mass_vapour;
    return dry_density / standard_density * dry + vapour_density / standard_vapour_density * vapour;
}

double edlen(const Terms& air) {
    const double s = air.inverse_square_um;
    const double standard_air = 1e-8 * (8342.54 + 2406147 / (130 - s) + 15998 / (38.9 - s));
    const double x = (1 + 1e-8 * (0.601 - 0.00972 * air.t_C) * air.p_Pa) / (1 + 0.003661 * air.t_C);
    const double dry = air.p_Pa * standard_air * x / 96095.43;
    return dry - 1e-10 * (292.75 / air.kelvins) * (3.7345 - 0.0401 * s) * air.vapour_Pa;
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
    const Terms terms = terms_of(air);
    return Refractivity{formula == AirFormula::ciddor ? ciddor(terms) : edlen(terms),
                        remarks_on(formula, air)};
}

} // namespace axiscal
