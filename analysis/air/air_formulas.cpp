#include "analysis/air/air_formulas.hpp"

#include <cmath>

namespace axiscal {
namespace {

/// Z of moist air; xv is the mole fraction of water vapour.
double compressibility(const AirTerms& air, double xv) {
    constexpr double a0 = 1.58123e-6, a1 = -2.9331e-8, a2 = 1.1043e-10, b0 = 5.707e-6,
                     b1 = -2.051e-8, c0 = 1.9898e-4, c1 = -2.376e-6, d = 1.83e-11, e = -0.765e-8;
    const double t = air.t_C, ratio = air.p_Pa / air.kelvins;
    return 1 - ratio * (a0 + a1 * t + a2 * t * t + (b0 + b1 * t) * xv + (c0 + c1 * t) * xv * xv) +
           ratio * ratio * (d + e * xv * xv);
}

/// Dry air by Birch and Downs, common to both water terms.
double edlen_dry(const AirTerms& air) {
    const double s = air.inverse_square_um;
    const double standard_air = 1e-8 * (8342.54 + 2406147 / (130 - s) + 15998 / (38.9 - s));
    const double x = (1 + 1e-8 * (0.601 - 0.00972 * air.t_C) * air.p_Pa) / (1 + 0.003661 * air.t_C);
    return air.p_Pa * standard_air * x / 96095.43;
}

} // namespace

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
    constexpr double still_falling_K = 50; // 1e-37 Pa; the curve turns up again below 20 K
    if (kelvins < still_falling_K) return 0;
    const double theta = kelvins / 273.16;
    const double root = std::sqrt(theta);
    const double exponent =
        -13.928169 * (1 - 1 / (theta * root)) + 34.7078238 * (1 - 1 / (theta * std::sqrt(root)));
    return 611.657 * std::exp(exponent);
}

double saturation_of_ciddor_Pa(double kelvins) {
    return std::exp(1.2378847e-5 * kelvins * kelvins - 1.9121316e-2 * kelvins + 33.93711047 -
                    6343.1645 / kelvins);
}

double ciddor_n_minus_1(const AirTerms& air) {
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

double edlen_nist_n_minus_1(const AirTerms& air) {
    return edlen_dry(air) - 1e-10 * (292.75 / air.kelvins) *
                                (3.7345 - 0.0401 * air.inverse_square_um) * air.vapour_Pa;
}

double birch_downs_n_minus_1(const AirTerms& air) {
    return edlen_dry(air) - 1e-10 * (3.7345 - 0.0401 * air.inverse_square_um) * air.vapour_Pa;
}

double bonsch_potulski_n_minus_1(const AirTerms& air) {
    const double s = air.inverse_square_um;
    const double standard_air = 1e-8 * (8091.37 + 2333983 / (130 - s) + 15518 / (38.9 - s));
    const double with_co2 = standard_air * (1 + 0.5327e-6 * (air.co2_ppm - 400));
    const double x =
        (1 + 1e-8 * (0.5953 - 0.009876 * air.t_C) * air.p_Pa) / (1 + 0.003661 * air.t_C);
    return air.p_Pa * with_co2 * x / 93214.60 - 1e-10 * (3.8020 - 0.0384 * s) * air.vapour_Pa;
}

} // namespace axiscal
