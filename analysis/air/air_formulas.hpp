#pragma once
// The formulas of the air as functions of plain numbers in the papers' own units. Nothing is
// checked here: air_index.hpp and air_refraction.hpp are the doors. Pure.

namespace axiscal {

/// Over liquid water, IAPWS-IF97 region 4 (273.15..647.096 K). Relative agreement with the
/// published check values 2e-9. Only + - * / sqrt. Above the critical point it has no meaning.
double saturation_over_water_Pa(double kelvins);

/// Over ice, IAPWS sublimation curve (50..273.16 K, 0 below).
double saturation_over_ice_Pa(double kelvins);

/// Over water in Ciddor's own form (Davis 1992): within 0.1 % of IAPWS for 0..40 degC.
double saturation_of_ciddor_Pa(double kelvins);

/// The state in the units of the papers.
struct AirTerms {
    double t_C = 20, kelvins = 293.15, p_Pa = 101325, vapour_Pa = 0;
    double inverse_square_um = 2.5; ///< S = 1 / lambda^2, vacuum wavelength
    double co2_ppm = 450;
};

/// All of them give n - 1; forming n first would lose 3.5 digits.

/// Ciddor, Applied Optics 35 (1996) 1566; p > 0.
double ciddor_n_minus_1(const AirTerms& air);
/// Modified Edlen with the water term of NIST's Engineering Metrology Toolbox, 450 ppm CO2.
double edlen_nist_n_minus_1(const AirTerms& air);
/// Birch and Downs, Metrologia 31 (1994) 315, 450 ppm CO2.
double birch_downs_n_minus_1(const AirTerms& air);
/// Boensch and Potulski, Metrologia 35 (1998) 133. Constants from memory of the paper: no printed
/// table was at hand to check them; they agree with the other three as far as those papers say.
double bonsch_potulski_n_minus_1(const AirTerms& air);

} // namespace axiscal
