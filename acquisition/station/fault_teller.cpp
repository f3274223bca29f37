#include "acquisition/station/fault_teller.hpp"

#include "acquisition/events/event_folder.hpp"

#include <utility>

namespace axiscal {

bool is_told(Fault fault) {
    switch (fault) {
    case Fault::none:
    case Fault::busy:
    case Fault::bad_request:
    case Fault::not_found:
    case Fault::no_run_armed: return false;
    default: return true;
    }
}

Result<void> FaultTeller::open() {
    const auto& webhook = config_.webhook;
    if (!webhook) {
        close_events(config_.state_directory);
        return {};
    }
    return open_events(config_.state_directory,
                       {config_.station, webhook->on_complete, webhook->on_fault});
}

void FaultTeller::take(const std::string& sentence, const LogFacts& about) {
    if (!config_.webhook || !config_.webhook->on_fault) return;
    if (about.run.empty() || !is_told(about.fault)) return;
    if (about.run != std::exchange(run_, about.run)) told_.clear();
    if (!told_.insert(about.fault).second) return;
    StationEvent event;
    event.about = StationEvent::About::fault;
    event.when_utc = iso8601_utc(scheduler_.clock_tie().utc_ns);
    event.run_id = about.run;
    event.fault = about.fault;
    event.sentence = sentence;
    // A disk that fails is told by the journal of the run; nobody waits for this.
    thread_.post([state = config_.state_directory, event = std::move(event)] {
        static_cast<void>(lay_event(state, event));
    });
}

} // namespace axiscal
