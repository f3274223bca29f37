#pragma once
// One function a chained table: takes a row's values in the order of its columns into the record.
// What they refuse is remembered by the reader. Internal to record_rows_read*.cpp and setups/.
// Pure.

#include "acquisition/runfile/record_rows.hpp"

#include <optional>

namespace axiscal::record_readers {

using ReadRow = void(RecordedRun& run, RowReader& in);
/// Of what was measured point by point.
using ReadMeasuredRow = void(RunRecord& run, RowReader& in);

// record_rows_read_setup.cpp
ReadMeasuredRow read_run, read_test, read_plan, read_target, read_plan_point, read_laser,
    read_material, read_air, read_rotary, read_rotary_deviation, read_linear_scale,
    read_linear_scale_sensor, read_imported, read_uncertainty, read_uncertainty_target,
    read_tolerance_set, read_tolerance_limit, read_standard, read_statement, read_instrument,
    read_channel, read_channel_calibration, read_channel_correction;
ClockTie read_tie(RowReader& in);
PlannedPoint read_planned(RowReader& in);

// record_rows_read_beside.cpp
ReadRow read_alignment, read_alignment_place, read_eve_source;

// record_rows_read_course.cpp
ReadMeasuredRow read_environment, read_event;
ReadRow read_datum, read_point, read_stream, read_stream_block, read_preflight, read_retake,
    read_retake_point, read_exclusion, read_answer, read_ordered, read_closing;

/// Left alone where the column is NULL.
template <class Amount> void read_optional(std::optional<Amount>& amount, RowReader& in) {
    if (const auto si = in.optional_real()) amount = Amount::from_si(*si);
}

} // namespace axiscal::record_readers
