#pragma once
// What waits for the share, how long, and what the publisher says about it. Reads names and two
// small files of this PC's own disk, never the share, and those only when they changed. Loop-bound.

#include "config/station_config.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace axiscal {

struct OutboxView {
    int waiting = 0;
    std::optional<double>
        oldest_s; ///< since the oldest was finished, by the wall clock; none: empty
    bool publisher_runs = false;
    /// The publisher's own words (publisher.json); empty before it spoke. state: idle | publishing
    /// | waiting | nowhere.
    std::string destination, state, reason, since_utc;
    std::string alarm; ///< one sentence for people; empty: all is well
};

class OutboxWatch {
public:
    OutboxWatch(const std::string& state_directory, PublishConfig config);
    /// @param utc_ns now. A clock set back makes nothing older: ages end at 0.
    [[nodiscard]] OutboxView look(std::int64_t utc_ns);

private:
    void scan(std::int64_t utc_ns);
    void listen(std::int64_t utc_ns);
    [[nodiscard]] bool publisher_runs() const;
    [[nodiscard]] std::string alarm_of(const OutboxView& view) const;

    std::string outbox_, report_, lock_;
    PublishConfig config_;
    OutboxView known_;
    std::optional<std::int64_t> oldest_ns_;
    std::int64_t scanned_change_ns_ = -1, read_change_ns_ = -1;
};

/// "12 results wait", "1 result waits".
std::string waiting_words(int count);
/// "40 s", "22 min", "5 h", "3 d".
std::string age_words(double seconds);

} // namespace axiscal
