#pragma once
// Phase refractive index of air by four published formulas, with their ranges. Pure.

#include "analysis/quantity/result.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace axiscal {

enum class AirModel : std::uint8_t { ciddor, edlen_nist, birch_downs, bonsch_potulski };

/// Where the saturation pressure comes from that turns relative humidity into vapour pressure.
enum class SaturationForm : std::uint8_t {
    iapws, ///< over liquid water for t >= 0 degC, over ice below, as NIST's toolbox takes it
    ciddor ///< over water at every temperature, the form printed in Ciddor's paper
};

/// Air and light; exactly one of the two humidities.
struct AirConditions {
    double vacuum_wavelength_nm = 0, temperature_degC = 0, pressure_Pa = 0;
    std::optional<double> relative_humidity_percent, vapour_pressure_Pa;
    std::optional<double> co2_ppm; ///< default: what the model's paper takes
    SaturationForm saturation = SaturationForm::iapws;
};

struct AirRange {
    const char* name; ///< "temperature", "pressure", "relative_humidity", ...
    double low, high; ///< in the unit of the conditions
};

struct AirIndex {
    double n_minus_1 = 0;
    double vapour_pressure_Pa = 0;
    std::optional<double> co2_ppm;             ///< what the model used, where it uses any
    std::vector<std::string> outside_validity; ///< names of AirRange
    std::vector<std::string> ignored;          ///< conditions that the model does not know
};

/// Range in which the model is stated to hold: 60..120 kPa, 0..100 %, 350..1600 nm; Ciddor
/// -40..100 degC, NIST's Edlen 0..40 degC; Birch & Downs and Boensch & Potulski 15..25 degC: their
/// water term has no temperature and leaves the others by 1e-7 at 40 degC. CO2 0..2000 ppm (from
/// memory) where it counts.
std::vector<AirRange> validity_of(AirModel model);

/// n - 1 by `model`. Uncertainty of the formulas 1e-8 .. 3e-8 inside their range; outside it the
/// value is computed and the condition named. Supersaturated air is possible (a cloud, air over
/// ice): above 100 % it is computed and "relative_humidity" is named. No air (p = 0) gives 0.
/// @errors Fault::bad_case with the contract's key for what cannot be: t <= -273.15 degC, p < 0, a
/// vapour pressure below 0 or above p, humidity < 0, CO2 outside 0..1e6 ppm, wavelength <= 0 or
/// within 1 % of a resonance of the formula, relative humidity above the critical temperature of
/// water (there is no saturation), NaN or infinity; "model" where the formula gives no index (n <=
/// 0), far outside its range.
Result<AirIndex> air_index_of(AirModel model, const AirConditions& air);

} // namespace axiscal
