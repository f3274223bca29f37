#pragma once
// The refractive index of the simulated air, by a formula that the daemon does not have. Pure.

#include "analysis/quantity/quantity.hpp"
#include "analysis/quantity/temperature.hpp"

namespace axiscal::simulate {

struct TrueAir {
    Temperature temperature = reference_temperature;
    Pressure pressure = pascal(101325);
    Ratio humidity = percent(50);
    double co2_ppm = 450;
};

/// Saturation vapour pressure over water, the exponential form that Ciddor 1996 quotes.
Pressure saturation_vapour_pressure(Temperature temperature);

/// n - 1 after Boensch and Potulski 1998 (Metrologia 35, 133).
/// @param vacuum_wavelength  350 nm to 650 nm; air at 20 +- 5 C, about 100 kPa.
/// Agrees there with the published NIST values of tests/reference/air_index.csv to 3e-8.
double refractivity(const TrueAir& air, Length vacuum_wavelength);
/// The same from a partial pressure of water vapour instead of a relative humidity.
double refractivity(const TrueAir& air, Pressure vapour, Length vacuum_wavelength);

} // namespace axiscal::simulate
