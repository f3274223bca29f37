#pragma once
// What the station says to people: in the log, and the last sentences in its status. What would be
// said again and again is said once. Loop-bound.

#include "analysis/quantity/result.hpp"
#include "drivers/loop/doorbell.hpp"
#include "drivers/loop/log_line.hpp"
#include "drivers/loop/scheduler.hpp"

#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <utility>

namespace axiscal {

class Notices {
public:
    /// @param bell  is rung by each sentence: what is worth one may be worth a look at the time
    Notices(Scheduler& scheduler, Doorbell& bell)
        : scheduler_{scheduler}
        , bell_{bell} {}

    /// @param id  is asked at each sentence for the run that is open, "" for none: of a sentence
    ///            that names no other it is the run
    void ask_for_run(std::function<std::string()> id) { open_run_ = std::move(id); }

    /// @param listener  hears each sentence with what it is about, on the loop
    void tell_too(std::function<void(const std::string&, const LogFacts&)> listener) {
        listener_ = std::move(listener);
    }

    /// @param facts  for the fields of the log
    void note(const std::string& sentence, LogFacts facts = {});
    /// Of the trigger port: the same again, as of an address that is tried each second, is not.
    void note_port(Fault fault, std::string sentence);
    void port_works() { port_.clear(); }
    /// Of a request: the CNC may repeat itself as fast as it likes.
    void note_refusal(std::uint16_t sequence, const Error& error);
    void nothing_refused() { refused_.clear(); }

    /// With their times, the newest last.
    [[nodiscard]] const std::deque<std::string>& last() const { return last_; }
    /// What the port said last; empty: it works.
    [[nodiscard]] const std::string& port() const { return port_; }

private:
    Scheduler& scheduler_;
    Doorbell& bell_;
    std::function<std::string()> open_run_;
    std::function<void(const std::string&, const LogFacts&)> listener_; ///< empty: nobody
    std::deque<std::string> last_;
    std::string port_, refused_;
};

} // namespace axiscal
