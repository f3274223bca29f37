#pragma once
// A record of where the axis was, without a word about captures: the planned points are found where
// the axis stood. Pure.

#include "analysis/quantity/result.hpp"
#include "tools/axiscal/imports/import_map.hpp"
#include "tools/axiscal/imports/laser_readings.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace axiscal {

struct AxisSample {
    MonotonicTime at;
    double position_m = 0;    ///< a rotary axis: degrees as millimetres
    std::uint64_t number = 0; ///< of the instrument, from 1; a leap is a loss. 0: it does not count
    std::size_t line = 0;     ///< in the file
};

/// Adds to all positions what makes the first window the datum of the plan.
/// @errors Fault::bad_case, "line N": the axis does not stand where the file begins, or samples are
/// lost there.
Result<void> tie_datum(std::vector<AxisSample>& samples, const StandstillMap& map);

/// The mean of the last still window before the axis leaves, of each planned point, in mm or
/// degrees. Stillness and the side from which the axis came are judged as the station judges them
/// (acquisition/capture). A rest with which the file begins is no point: nothing shows how the axis
/// came to it.
/// @param samples  in the order of their times
/// @errors Fault::bad_case, "line N", with target and approach: a stop that is missing, stands
/// twice or beyond the plan, is too short or not still, has lost samples in its window, or was
/// reached from the other side; "file": it ends before the plan does.
Result<LaserReadings> readings_of_standstills(std::span<const AxisSample> samples,
                                              const StandstillMap& map);

} // namespace axiscal
