#include "analysis/compensation/expansion.hpp"

#include "analysis/checked_numbers.hpp"
#include "analysis/compensation/thermal_compensation.hpp"

#include <cmath>

namespace axiscal {
namespace {

Result<void> check_body(const ThermalBody& body, const std::string& name) {
    AXISCAL_CHECK(check_case_number(body.expansion_per_K, name + ".expansion_per_K"));
    AXISCAL_CHECK(check_case_number(body.temperature_degC, name + ".temperature_degC"));
    if (!(body.temperature_degC > -273.15))
        return refuse(Fault::bad_case, name + ".temperature_degC", "must be above -273.15 degC");
    const double strain = thermal_strain(body);
    if (!(strain > -0.5 && strain < 1))
        return refuse(Fault::bad_case, name, "would halve or double in length: no solid body does");
    return {};
}

Result<void> check_setup(const InterferometerSetup& setup) {
    AXISCAL_CHECK(check_positive(setup.vacuum_wavelength_nm, "vacuum_wavelength_nm"));
    if (setup.passes != 2 && setup.passes != 4)
        return refuse(Fault::bad_case, "passes",
                      "must be 2 (corner cube) or 4 (plane mirror optics)");
    AXISCAL_CHECK(check_case_number(setup.dead_path_mm, "dead_path_mm"));
    if (setup.dead_path_mm < 0) return refuse(Fault::bad_case, "dead_path_mm", "must be 0 or more");
    constexpr double largest_angle_rad = 0.5; // no beam comes back from there
    if (!(std::fabs(setup.beam_angle_rad) <= largest_angle_rad))
        return refuse(Fault::bad_case, "beam_angle_rad", "must lie in -0.5..0.5 rad");
    if (setup.machine) return check_body(*setup.machine, "machine");
    return {};
}

Result<void> check_refractivity(double n_minus_1, const char* field) {
    if (std::fabs(n_minus_1) <= 0.5) return {};
    return refuse(Fault::bad_case, field, "must be n - 1, within -0.5..0.5");
}

} // namespace

double thermal_strain(const ThermalBody& body) {
    return body.expansion_per_K * (body.temperature_degC - 20);
}

Result<DeviationAt20C> deviation_at_20C(double distance,
                                        double deviation,
                                        const ThermalBody& machine,
                                        const ThermalBody& instrument) {
    AXISCAL_CHECK(check_case_number(distance, "distance"));
    AXISCAL_CHECK(check_case_number(deviation, "deviation"));
    AXISCAL_CHECK(check_body(machine, "machine"));
    AXISCAL_CHECK(check_body(instrument, "instrument"));
    const double of_machine = thermal_strain(machine), of_instrument = thermal_strain(instrument);
    const double difference = of_machine - of_instrument;
    return DeviationAt20C{deviation - distance * difference,
                          deviation - (distance + deviation) * difference / (1 + of_machine)};
}

Result<Displacement>
displacement_of(const InterferometerSetup& setup, double counts, double n_minus_1) {
    AXISCAL_CHECK(check_setup(setup));
    AXISCAL_CHECK(check_case_number(counts, "counts"));
    AXISCAL_CHECK(check_refractivity(n_minus_1, "n_minus_1"));
    AXISCAL_CHECK(check_refractivity(setup.n_minus_1_at_zero, "n_minus_1_at_zero"));
    const Length vacuum = nm(setup.vacuum_wavelength_nm) * (counts / setup.passes);
    Displacement out;
    out.vacuum_mm = vacuum.in(mm);
    out.in_air_mm =
        displacement_in_air(vacuum, n_minus_1, setup.n_minus_1_at_zero, mm(setup.dead_path_mm))
            .in(mm);
    const double half = std::sin(setup.beam_angle_rad / 2);
    out.cosine_mm = out.in_air_mm * (2 * half * half / std::cos(setup.beam_angle_rad));
    out.along_axis_mm = out.in_air_mm + out.cosine_mm;
    if (!setup.machine) return out;
    const Expansion alpha = per_kelvin(setup.machine->expansion_per_K);
    const Temperature material = Temperature::celsius(setup.machine->temperature_degC);
    const auto at = [&](ExpansionForm form) {
        return displacement_at_20C(mm(out.along_axis_mm), alpha, material, form).in(mm);
    };
    out.at_20C = DeviationAt20C{at(ExpansionForm::first_order), at(ExpansionForm::exact)};
    return out;
}

double beam_angle_of_walk(double walk, double travel) {
    return std::atan2(walk, 2 * travel);
}

double abbe_error(double offset, double angle_rad) {
    return offset * std::tan(angle_rad);
}

} // namespace axiscal
