#include "acquisition/runfile/record_columns.hpp"
#include "acquisition/runfile/record_readers.hpp"

namespace axiscal {
namespace record_readers {
namespace {

/// What was measured point by point needs the run alone.
template <auto read> void measured(RecordedRun& run, RowReader& in) {
    read(run, in);
}

constexpr std::array<void (*)(RecordedRun&, RowReader&), tables.size()> readers{
    measured<read_run>,
    measured<read_test>,
    measured<read_plan>,
    measured<read_target>,
    measured<read_plan_point>,
    measured<read_laser>,
    measured<read_material>,
    measured<read_air>,
    measured<read_rotary>,
    measured<read_rotary_deviation>,
    measured<read_linear_scale>,
    measured<read_linear_scale_sensor>,
    measured<read_imported>,
    measured<read_uncertainty>,
    measured<read_uncertainty_target>,
    measured<read_tolerance_set>,
    measured<read_tolerance_limit>,
    measured<read_standard>,
    measured<read_statement>,
    measured<read_instrument>,
    measured<read_channel>,
    measured<read_channel_calibration>,
    measured<read_channel_correction>,
    read_alignment,
    read_alignment_place,
    read_drift,
    read_probing,
    read_probing_touch,
    read_eve_source,
    read_datum,
    read_point,
    measured<read_environment>,
    measured<read_event>,
    read_circular,
    read_circular_bar,
    read_circular_uncertainty,
    read_stream,
    read_stream_block,
    read_preflight,
    read_retake,
    read_retake_point,
    read_exclusion,
    read_answer,
    read_ordered,
    read_closing,
};

} // namespace
} // namespace record_readers

Result<void> place_row(RecordedRun& run, const Table& table, const Row& row) {
    RowReader in{table, row};
    record_readers::readers[static_cast<std::size_t>(&table - tables.data())](run, in);
    return in.status();
}

} // namespace axiscal
