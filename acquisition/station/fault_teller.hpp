#pragma once
// Makes an event of a sentence that tells of a fault in a run, for whoever the webhook tells
// (acquisition/events). The loop never waits for it: a thread lays it down. Loop-bound.

#include "config/station_config.hpp"
#include "drivers/loop/log_line.hpp"
#include "drivers/loop/scheduler.hpp"
#include "drivers/loop/work_thread.hpp"

#include <set>
#include <string>

namespace axiscal {

class FaultTeller {
public:
    FaultTeller(Scheduler& scheduler, const StationConfig& config)
        : scheduler_{scheduler}
        , config_{config} {}

    /// Once, at the start: the folder of events as the station file asks for it, or none. Blocks
    /// for some synced writes. @errors Fault::io.
    Result<void> open();
    /// A fault is told once a run, however often it is said: news, not record. Where the daemon
    /// dies before it is on the disk, the next one tells it if it lasts.
    void take(const std::string& sentence, const LogFacts& about);

private:
    Scheduler& scheduler_;
    const StationConfig& config_;
    std::string run_; ///< of which `told_` is
    std::set<Fault> told_;
    WorkThread thread_{WorkThread::End::left_behind}; ///< an idle one costs nothing
};

/// What is no news to a shop: orders that were refused, and what passes by itself.
bool is_told(Fault fault);

} // namespace axiscal
