#include "acquisition/runfile/record_columns.hpp"
#include "acquisition/runfile/record_readers.hpp"
#include "acquisition/runfile/setups/setup_rows.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {
namespace record_readers {
namespace {

/// What was measured point by point needs the run alone.
template <auto read> void measured(RecordedRun& run, RowReader& in) {
    read(run, in);
}

constexpr std::array<ReadRow*, tables.size()> readers{
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
    read_eve_source,
    read_datum,
    read_point,
    measured<read_environment>,
    measured<read_event>,
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

namespace {

/// A reader for each table, in the same order.
struct ChainedTables {
    std::vector<Table> tables;
    std::vector<record_readers::ReadRow*> readers;
};

std::size_t place_in_schema(const Table& table) {
    const std::string begin = "CREATE TABLE " + std::string{table.name} + "(";
    return std::string_view{run_file_schema}.find(begin);
}

ChainedTables joined_tables() {
    std::multimap<std::size_t, DescribedTable> in_order;
    const auto take = [&in_order](const DescribedTable& one) {
        in_order.emplace(place_in_schema(one.table), one);
    };
    for (std::size_t i = 0; i < tables.size(); ++i)
        take({tables[i], record_readers::readers[i]});
    for (const SetupRows* kind : setup_rows())
        std::ranges::for_each(kind->tables, take);
    ChainedTables joined;
    for (const auto& [place, one] : in_order) {
        joined.tables.push_back(one.table);
        joined.readers.push_back(one.read);
    }
    return joined;
}

const ChainedTables& every_table() {
    static const ChainedTables every = joined_tables();
    return every;
}

} // namespace

std::span<const Table> chained_tables() {
    return every_table().tables;
}

const Table& table_named(std::string_view name) {
    return *std::ranges::find(chained_tables(), name, &Table::name);
}

Result<void> place_row(RecordedRun& run, const Table& table, const Row& row) {
    RowReader in{table, row};
    const auto place = static_cast<std::size_t>(&table - chained_tables().data());
    every_table().readers[place](run, in);
    return in.status();
}

} // namespace axiscal
