// Marlin dialect (also runs on Klipper and RepRapFirmware). Source: Marlin 2 documentation of
// G0-G1, G4 (P in milliseconds), M400, M84. No waiting on inputs: the station sees the halts
// itself.
#include "acquisition/program/part_program.hpp"

#include <cmath>
#include <cstdio>

namespace axiscal {
namespace {

/// Points taken again find the station armed.
std::string head_of(const ProgramOrder& order) {
    const std::string arming = order.retakes ? "" : "; " + std::string{waits_for_nobody} + "\n";
    return "; axiscal " + program_id(order.plan) +
           "\n; home the machine (G28) and take the heaters off before this program\n" + arming +
           "G21\nG90\nM84 S0 ; motors stay on while the axis dwells\n";
}

} // namespace

Result<std::string> write_marlin(const ProgramOrder& order) {
    if (auto fits = check_prepare(order); !fits) return tl::unexpected<Error>(fits.error());
    if (order.shape != TriggerShape::dwell)
        return fail(Fault::bad_request,
                    "Marlin cannot wait for the station's answer: set trigger.shape = \"dwell\"");
    if (order.rotary)
        return fail(Fault::bad_request,
                    "a rotary axis needs a control that waits for the station and for the indexing "
                    "table: use the dialect linuxcnc");
    if (order.dwell < order.least_halt)
        return fail(Fault::bad_request,
                    "a dwell of " + std::to_string(seconds_of(order.dwell)) +
                        " s is shorter than the station needs to see the halt (" +
                        std::to_string(seconds_of(order.least_halt)) + " s): lengthen cycle.dwell");
    char feed[32], pause[32];
    std::snprintf(feed, sizeof feed, " F%.1f\n", order.feed.in(mm_per_minute));
    std::snprintf(pause, sizeof pause, "G4 P%ld\n", std::lround(seconds_of(order.dwell) * 1000));
    std::string text = head_of(order);
    bool at_datum = true; // the first move
    for (const ProgramMove& move : moves_of(order.plan)) {
        if (move.point)
            text += "; P" + std::to_string(move.point->target_index + 1) +
                    (move.point->direction == Direction::positive ? " up " : " down ") +
                    std::to_string(move.point->approach + 1) + "\n";
        text += "G1 " + coordinate_word(order.axis, move.coordinate_mm) + feed;
        if (move.point || at_datum) text += std::string{"M400\n"} + pause;
        at_datum = false;
    }
    return text + "; end of cycle\n";
}

} // namespace axiscal
