#pragma once
// One line of the daemon's log, and what it is about: systemd's journal keeps that in fields.

#include "analysis/quantity/result.hpp"

#include <string>
#include <utility>

namespace axiscal {

/// What whoever logs knows without guessing.
struct LogFacts {
    Fault fault = Fault::none;
    std::string run = {};        ///< its id; empty: none
    std::string instrument = {}; ///< its name in the station file; empty: none
    [[nodiscard]] bool any() const {
        return fault != Fault::none || !run.empty() || !instrument.empty();
    }
};

struct LogLine {
    std::string text; ///< with its newline
    int priority = 6; ///< as syslog(3) counts: 2 critical, 3 error, 4 warning, 6 information
    LogFacts facts;
};

/// While it lives, the lines of this thread are about `facts`, which must outlive it. Not across a
/// co_await: other tasks would speak under it.
class LogAbout {
public:
    explicit LogAbout(const LogFacts& facts)
        : before_{std::exchange(now_, &facts)} {}
    ~LogAbout() { now_ = before_; }
    LogAbout(const LogAbout&) = delete;
    LogAbout& operator=(const LogAbout&) = delete;

    [[nodiscard]] static LogFacts of_this_thread() { return now_ != nullptr ? *now_ : LogFacts{}; }

private:
    inline static constinit thread_local const LogFacts* now_ = nullptr;
    const LogFacts* before_;
};

} // namespace axiscal
