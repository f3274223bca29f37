// The set-up of a straightness test; its points stand in the tables of every run.
#include "acquisition/runfile/setups/straightness_rows.hpp"

#include <array>

namespace axiscal::straightness_rows {
namespace {

using row_values::chained;

std::vector<ChainedRow> rows(const TestSetup& setup) {
    const auto& straightness = std::get<StraightnessSetup>(setup);
    std::vector<ChainedRow> all;
    all.push_back(chained("straightness", row_of_optics(straightness)));
    all.push_back(chained("straightness_uncertainty", row_of_statement(straightness.uncertainty)));
    return all;
}

void read_setup(RecordedRun& run, RowReader& in) {
    read_optics(only_setup_of<StraightnessSetup>(run, in), in);
}

void read_statement_of_it(RecordedRun& run, RowReader& in) {
    setup_of<StraightnessSetup>(run, in).uncertainty = read_optics_statement(in);
}

constexpr std::array all_tables{
    DescribedTable{Table{"straightness",
                         "method, across, sign, factor, resolution_m, mirror, reversal_of, base_m, "
                         "angle_resolution_rad, place",
                         "ttirrttrrt"},
                   read_setup},
    DescribedTable{Table{"straightness_uncertainty",
                         "factor_U, factor_limit, factor_k, mirror_limit_um_per_m2, angle_U_rad, "
                         "angle_k, base_U_m, base_k, eve_m, eve_rad",
                         "RRrRRrRrRR"},
                   read_statement_of_it},
};

} // namespace
} // namespace axiscal::straightness_rows

namespace axiscal {

extern const SetupRows straightness_setup_rows{
    TestKind::straightness, straightness_rows::all_tables, straightness_rows::rows};

} // namespace axiscal
