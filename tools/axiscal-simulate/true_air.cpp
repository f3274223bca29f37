#include "true_air.hpp"

#include <cmath>

namespace axiscal::simulate {

Pressure saturation_vapour_pressure(Temperature temperature) {
    const double kelvin = temperature.in_kelvin();
    return pascal(std::exp(1.2378847e-5 * kelvin * kelvin - 1.9121316e-2 * kelvin + 33.93711047 -
                           6.3431645e3 / kelvin));
}

double refractivity(const TrueAir& air, Pressure vapour, Length vacuum_wavelength) {
    const double sigma = 1.0 / vacuum_wavelength.in(um);
    const double square = sigma * sigma;
    const double t = air.temperature.in_celsius();
    const double p = air.pressure.in(pascal);
    const double standard =
        1e-8 * (8091.37 + 2333983.0 / (130.0 - square) + 15518.0 / (38.9 - square));
    const double with_co2 = standard * (1.0 + 0.5327e-6 * (air.co2_ppm - 400.0));
    const double dry = with_co2 * p / 93214.60 * (1.0 + 1e-8 * (0.5953 - 0.009876 * t) * p) /
                       (1.0 + 0.0036610 * t);
    return dry - 1e-10 * (3.8020 - 0.0384 * square) * vapour.in(pascal);
}

double refractivity(const TrueAir& air, Length vacuum_wavelength) {
    const Pressure vapour = saturation_vapour_pressure(air.temperature) * air.humidity.si();
    return refractivity(air, vapour, vacuum_wavelength);
}

} // namespace axiscal::simulate
