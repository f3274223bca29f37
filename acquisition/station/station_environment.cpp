// The limits of the environment: outside them nothing is captured, and the run goes on when it is
// back.
#include "acquisition/station/station.hpp"

namespace axiscal {
void Station::judge_environment() {
    if (!config_.environment.stated()) return;
    const MonotonicTime now = scheduler_.now();
    if (const auto news = readings_.judge_limits(channels().environment(now), now))
        record_instrument(news->sentence, news->fault);
}

} // namespace axiscal
