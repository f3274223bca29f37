// What the run with the mirror in the other position gave, beside the set-up of a straightness
// test. A pair of files of its own: a run file that was made before it has none of its tables.
#include "acquisition/runfile/setups/straightness_rows.hpp"

#include <array>

namespace axiscal::straightness_reversal_rows {
namespace {

using row_values::chained;
using straightness_rows::append_line;
using straightness_rows::append_line_row;

/// The run id stands in the row of the set-up: StraightnessSetup::reversal_of.
std::vector<ChainedRow> rows(const TestSetup& setup) {
    const auto& reversal = std::get<StraightnessSetup>(setup).reversal;
    if (!reversal) return {};
    Row head;
    append_line(head, *reversal);
    std::vector<ChainedRow> all{chained("straightness_reversal", std::move(head))};
    for (const RecordedLineRow& at : reversal->rows) {
        Row row;
        append_line_row(row, at);
        all.push_back(chained("straightness_reversal_row", std::move(row)));
    }
    return all;
}

void read_reversal(RecordedRun& run, RowReader& in) {
    auto& setup = setup_of<StraightnessSetup>(run, in);
    if (setup.reversal) return in.reject("stands there twice");
    RecordedLine& line = setup.reversal.emplace();
    line.run_id = setup.reversal_of;
    straightness_rows::read_line(line, in);
}

void read_reversal_row(RecordedRun& run, RowReader& in) {
    const RecordedLineRow at = straightness_rows::read_line_row(in);
    const bool alone = straightness_rows::stands_alone(run);
    auto& setup = setup_of<StraightnessSetup>(run, in);
    if (setup.reversal) return setup.reversal->rows.push_back(at);
    if (!alone) in.reject("stands there without the line that it belongs to");
}

constexpr std::array all_tables{
    DescribedTable{Table{"straightness_reversal", "axis, across, readings, scatter_m", "ttir"},
                   read_reversal},
    DescribedTable{Table{"straightness_reversal_row", "target_m, forward_m, backward_m", "rrR"},
                   read_reversal_row},
};

} // namespace
} // namespace axiscal::straightness_reversal_rows

namespace axiscal {

extern const SetupRows straightness_reversal_setup_rows{TestKind::straightness,
                                                        straightness_reversal_rows::all_tables,
                                                        straightness_reversal_rows::rows};

} // namespace axiscal
