#pragma once
// What the station says to people: in the log, and the last sentences in its status. What would be
// said again and again is said once. Loop-bound.

#include "analysis/quantity/result.hpp"
#include "drivers/loop/doorbell.hpp"
#include "drivers/loop/scheduler.hpp"

#include <cstdint>
#include <deque>
#include <string>

namespace axiscal {

class Notices {
public:
    /// @param bell  is rung by each sentence: what is worth one may be worth a look at the time
    Notices(Scheduler& scheduler, Doorbell& bell)
        : scheduler_{scheduler}
        , bell_{bell} {}

    void note(const std::string& sentence);
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
    std::deque<std::string> last_;
    std::string port_, refused_;
};

} // namespace axiscal
