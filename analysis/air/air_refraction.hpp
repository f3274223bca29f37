#pragma once
// Phase refractive index of air, as n - 1: forming n first would lose 3.5 digits. Pure.

#include "analysis/quantity/quantity.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/quantity/temperature.hpp"
#include "analysis/record/run_record.hpp"

#include <string>
#include <vector>

namespace axiscal {

/// The air in the beam and the light that crosses it.
struct AirState {
    Temperature temperature;
    Pressure pressure;
    Ratio relative_humidity; ///< over liquid water for t >= 0 degC, over ice below
    Length vacuum_wavelength;
    double co2_ppm = 450; ///< used by Ciddor; modified Edlen is fixed at 450 ppm
};

struct Refractivity {
    double n_minus_1 = 0;
    std::vector<std::string> remarks; ///< where the state lies outside the formula's range
};

/// Vapour pressure of saturated air: IAPWS-IF97 region 4 over water (t >= 0 degC), IAPWS
/// sublimation curve over ice below. Relative accuracy 2e-9 against the published check values.
/// For t >= 0 only + - * / sqrt are used, so that the bits do not depend on a mathematics library.
Pressure saturation_vapour_pressure(Temperature temperature);

/// Ciddor 1996 or modified Edlen in NIST's shop-floor form. Valid (1e-8 .. 3e-8) for 0..40 degC
/// (Ciddor -40..100 degC), 60..120 kPa, 350..1600 nm; outside that it computes and remarks.
/// @errors Fault::bad_request with the field for what cannot be: humidity outside 0..100 %,
/// pressure not above the vapour's, temperature outside -100..100 degC, wavelength outside
/// 300..2000 nm, CO2 outside 0..100000 ppm, NaN anywhere.
Result<Refractivity> refractivity_of(AirFormula formula, const AirState& air);

} // namespace axiscal
