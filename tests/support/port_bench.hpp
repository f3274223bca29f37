#pragma once
// A trigger port under a scheduler, its station replaced by a list. Tests only.

#include "drivers/trigger/trigger_port.hpp"

#include <boost/asio/bind_cancellation_slot.hpp>
#include <boost/asio/cancellation_signal.hpp>
#include <boost/asio/co_spawn.hpp>

#include <exception>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace axiscal::testing {

class RecordingSink final : public TriggerSink {
public:
    void on_trigger(const TriggerEvent& event) override { events.push_back(event); }
    void on_cnc_silent(bool silent) override { silences.push_back(silent); }
    void on_port_note(Fault fault, std::string sentence) override {
        notes.emplace_back(fault, std::move(sentence));
    }
    std::vector<TriggerEvent> events;
    std::vector<bool> silences;
    std::vector<std::pair<Fault, std::string>> notes;
};

/// Runs a port on the scheduler's loop; `result` is filled when it has ended.
class RunningPort {
public:
    RunningPort(TriggerPort& port, Scheduler& scheduler) {
        const TriggerContext context{&scheduler, &sink};
        boost::asio::co_spawn(
            scheduler.executor(), port.run(context),
            boost::asio::bind_cancellation_slot(
                cancel_.slot(), [this](std::exception_ptr escaped, Result<void> ended) {
                    threw = escaped != nullptr;
                    result = std::move(ended);
                }));
    }
    void cancel() { cancel_.emit(boost::asio::cancellation_type::all); }

    RecordingSink sink;
    std::optional<Result<void>> result;
    bool threw = false;

private:
    boost::asio::cancellation_signal cancel_;
};

} // namespace axiscal::testing
