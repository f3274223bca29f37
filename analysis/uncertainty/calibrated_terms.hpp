#pragma once
// Terms of the uncertainty budget from the certificates of the instruments, offered where the
// station file states none. Pure.

#include "analysis/record/run_record.hpp"

#include <optional>
#include <string>
#include <vector>

namespace axiscal {

inline constexpr double calibrated_k = 2;

/// Expanded uncertainty (k = 2) of the laser system over `length_m`, um: of the laser's own
/// certificate and, where air is corrected here, of the sensors of the air by what the formula of
/// the run makes of them at 20 degC, 101325 Pa and 50 % (ISO 230-2, annex A: the device with its
/// sensors). Several sensors of one kind count like their worst. Empty without the laser's U, and
/// where one kind of air sensor has none: it would be too small. What was used, or what is missing,
/// is added to `remarks`. Of a linear scale in the laser's place: of its own certificate alone.
std::optional<double>
calibrated_device_um(const RunRecord& run, double length_m, std::vector<std::string>& remarks);

/// Full width of the material's temperature, K: 2 sqrt(3) times the largest standard uncertainty of
/// its sensors' certificates. Contact and the places between the sensors are not in it; the remark
/// says so. Empty where one material sensor has no U.
std::optional<double> calibrated_temperature_width_K(const RunRecord& run,
                                                     std::vector<std::string>& remarks);

/// The same of the sensors on the scale that measures the axis.
std::optional<double> calibrated_scale_width_K(const RunRecord& run,
                                               std::vector<std::string>& remarks);

} // namespace axiscal
