#pragma once
// Part programs for circular tests, from the plan of the station file. Pure.

#include "analysis/record/circular_setup.hpp"
#include "config/station_config.hpp"

#include <string>

namespace axiscal {

struct CircularOrder {
    CircularPlan plan;
    TriggerShape shape = TriggerShape::sequence_block;
    Duration answer_limit =
        usual_cnc_timeout(std::chrono::seconds{10}); ///< longest wait for `done`
};

/// Rest, request n, feed-in, circle with overshoot, feed-out, for every circle n of the plan; the
/// last request, one more than there are circles, ends the test. Where the next circle begins
/// elsewhere than the last ended, the way back is an arc at the radius of rest: the bar stays on.
/// With StartMethod::trigger the number also changes at both ends of each arc, without waiting.
/// Without a handshake (dwell trigger) the halts are 2 s and nobody is asked.
std::string write_circular_linuxcnc(const CircularOrder& order);

} // namespace axiscal
