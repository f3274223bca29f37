// A probing test: all of it stands in its set-up.
#include "acquisition/runfile/row_values.hpp"
#include "acquisition/runfile/setups/setup_rows.hpp"

#include <array>

namespace axiscal::probing_setup {
namespace {

using row_values::chained;
using row_values::whole;

ChainedRow row_of_touch(const ProbingTouch& touch) {
    const auto& [direction, reference, approach, latched] = touch;
    return chained("probing_touch",
                   {direction[0], direction[1], direction[2], whole(reference), approach.si(),
                    latched[0].si(), latched[1].si(), latched[2].si()});
}

std::vector<ChainedRow> rows(const TestSetup& setup) {
    const auto& [feed_mm_per_min, probe, signal_path, touches] = std::get<ProbingRecord>(setup);
    std::vector<ChainedRow> all{chained("probing", {feed_mm_per_min, probe, signal_path})};
    for (const ProbingTouch& touch : touches)
        all.push_back(row_of_touch(touch));
    return all;
}

void read_probing(RecordedRun& run, RowReader& in) {
    auto& probing = only_setup_of<ProbingRecord>(run, in);
    probing.feed_mm_per_min = in.real();
    probing.probe = in.text();
    probing.signal_path = in.text();
}

void read_probing_touch(RecordedRun& run, RowReader& in) {
    ProbingTouch touch;
    for (double& component : touch.direction)
        component = in.real();
    touch.reference = in.flag();
    touch.approach = in.length();
    for (Length& coordinate : touch.latched)
        coordinate = in.length();
    setup_of<ProbingRecord>(run, in).touches.push_back(touch);
}

constexpr std::array all_tables{
    DescribedTable{Table{"probing", "feed_mm_per_min, probe, signal_path", "rtt"}, read_probing},
    DescribedTable{
        Table{"probing_touch",
              "direction_x, direction_y, direction_z, reference, approach_m, x_m, y_m, z_m",
              "rrrirrrr"},
        read_probing_touch},
};

} // namespace
} // namespace axiscal::probing_setup

namespace axiscal {

extern const SetupRows probing_setup_rows{TestKind::probing, probing_setup::all_tables,
                                          probing_setup::rows};

} // namespace axiscal
