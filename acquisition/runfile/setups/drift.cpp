// The set-up of a drift test.
#include "acquisition/runfile/row_values.hpp"
#include "acquisition/runfile/setups/setup_rows.hpp"

#include <array>

namespace axiscal::drift_setup {
namespace {

using row_values::chained;
using row_values::whole;

std::vector<ChainedRow> rows(const TestSetup& setup) {
    const auto& [duration, interval, place, of_bar] = std::get<DriftSetup>(setup);
    return {chained("drift",
                    {whole(duration.count()), whole(interval.count()), place.si(), whole(of_bar)})};
}

void read_drift(RecordedRun& run, RowReader& in) {
    auto& drift = only_setup_of<DriftSetup>(run, in);
    drift.duration = Duration{in.integer()};
    drift.interval = Duration{in.integer()};
    drift.place = in.length();
    drift.of_bar = in.flag();
}

constexpr std::array all_tables{
    DescribedTable{Table{"drift", "duration_ns, interval_ns, place_m, of_bar", "iiri"}, read_drift},
};

} // namespace
} // namespace axiscal::drift_setup

namespace axiscal {

extern const SetupRows drift_setup_rows{TestKind::drift, drift_setup::all_tables,
                                        drift_setup::rows};

} // namespace axiscal
