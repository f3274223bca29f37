#pragma once
// Which turned-away clients are worth a sentence. A monitor that knocks each second must fill
// neither the log nor the few notes of the status. Loop-bound.

#include "analysis/quantity/time.hpp"

#include <optional>
#include <string>
#include <vector>

namespace axiscal {

class TurnedAway {
public:
    /// An address is told once a day, and of a day the first four.
    /// @returns the words behind "turned", e.g. "192.168.10.7 away"; empty: nothing is to be told.
    std::optional<std::string> take(const std::string& address, MonotonicTime now);

private:
    std::vector<std::string> told_;
    std::optional<MonotonicTime> since_; ///< of the day's first
};

} // namespace axiscal
