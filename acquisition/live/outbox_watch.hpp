#pragma once
// What waits for the share, how long, and what the publisher says about it. Reads names and two
// small files of this PC's own disk, never the share, and those only when they changed. Loop-bound.

#include "analysis/quantity/time.hpp"
#include "config/station_config.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace axiscal {

struct OutboxView {
    int waiting = 0;
    std::optional<double> oldest_s; ///< since the oldest was finished; none: empty. Never negative
    bool publisher_runs = false;
    /// The publisher's own words (publisher.json); empty before it spoke. state: idle | publishing
    /// | waiting | nowhere.
    std::string destination, state, reason, since_utc;
    std::string alarm; ///< one sentence for people; empty: all is well
};

/// Ages are counted by the monotonic clock from when an entry was first seen, so that a clock that
/// is set makes no result older or younger. What it was older then is told by its file's time, as
/// far as that is plausible: between 0 and the time since the look before, which did not see it;
/// at the first look between 0 and a year, else 0.
class OutboxWatch {
public:
    OutboxWatch(const std::string& state_directory, PublishConfig config);
    /// @param now both clocks; the monotonic one never goes back from look to look.
    [[nodiscard]] OutboxView look(const ClockTie& now);

    /// Looks at most every ten seconds. @returns a sentence when the alarm begins and when it is
    /// over, however the count goes meanwhile.
    [[nodiscard]] std::optional<std::string> judge(const ClockTie& now);
    /// judge() looks from ten seconds after this on.
    void begin_judging(MonotonicTime now) { judged_ = now; }
    /// When judge() may have a sentence that no ring announces; never without a destination.
    [[nodiscard]] std::optional<MonotonicTime> due() const;

private:
    /// Of a file that may change: its stamp, and since when it has borne it.
    struct Stamp {
        std::int64_t changed_ns = -1;
        MonotonicTime seen;
        bool settled = false; ///< what it says was read when it could not change unseen any more
        /// @returns whether it has to be read at `now`.
        bool renew(const std::string& path, MonotonicTime now);
    };
    void scan(const ClockTie& now);
    void listen(MonotonicTime now);
    [[nodiscard]] MonotonicTime finished(const std::string& folder, const ClockTie& now) const;
    [[nodiscard]] bool publisher_runs() const;
    [[nodiscard]] std::string alarm_of(const OutboxView& view) const;

    std::string outbox_, report_, lock_;
    PublishConfig config_;
    OutboxView known_;
    std::map<std::string, MonotonicTime> finished_; ///< by name of the entry
    std::optional<MonotonicTime> looked_;           ///< none: this is the first look
    Stamp outbox_stamp_, report_stamp_;
    MonotonicTime judged_{};
    std::string alarm_; ///< as the last sentence of judge() had it
    int waiting_ = 0;   ///< when judge() last looked
};

/// "12 results wait", "1 result waits".
std::string waiting_text(int count);
/// "40 s", "22 min", "5 h", "3 d".
std::string rounded_age(double seconds);

} // namespace axiscal
