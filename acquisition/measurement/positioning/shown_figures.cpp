#include "acquisition/measurement/positioning/shown_figures.hpp"

#include "acquisition/run/run_machine.hpp"
#include "analysis/record/run_record.hpp"

#include <vector>

namespace axiscal {
namespace {

std::vector<ShownReading> shown_readings(const RunMachine& machine) {
    std::vector<ShownReading> readings;
    for (const AcceptedPoint& point : machine.counting())
        readings.push_back({point.planned, point.deviation});
    return readings;
}

} // namespace

/// Points and exclusions never go: equal counts are the same points. Without a datum none is taken.
std::shared_ptr<const FiguresSoFar> ShownFigures::of(const RunRecord& header,
                                                     const RunMachine& machine) {
    if (header.kind != TestKind::positioning) return nullptr;
    const std::size_t points = machine.accepted().size(), left_out = machine.left_out();
    if (points == points_ && left_out == left_out_) return figures_;
    points_ = points;
    left_out_ = left_out;
    const std::vector<ShownReading> readings = shown_readings(machine);
    figures_ = readings.empty()
                   ? nullptr
                   : std::make_shared<const FiguresSoFar>(figures_so_far(header, readings));
    return figures_;
}

} // namespace axiscal
