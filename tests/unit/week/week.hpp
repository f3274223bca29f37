#pragma once
// Weeks of a station in virtual time: runs by day and by night, and what happens to a station.
// Everything random comes from one seed. Tests only.

#include "acquisition/publish/folder_destination.hpp"
#include "acquisition/publish/publisher.hpp"
#include "tests/support/report_script.hpp"
#include "tests/unit/station/station_bench.hpp"

#include <array>
#include <filesystem>
#include <malloc.h>
#include <map>
#include <random>
#include <set>
#include <vector>

namespace axiscal::testing {

enum class Trouble : std::uint8_t {
    none,
    laser_out,
    air_out,
    material_out,
    clock_steps,
    share_lost
};

/// Counted while the weeks go by; what ought to be 0 says so.
struct Tally {
    int armed = 0, complete = 0, requests = 0, acknowledged = 0, refused = 0;
    int unplugged = 0, steps = 0, losses = 0, published = 0, alarms = 0;
    int steps_while_waiting = 0; ///< with a result in the outbox
    int unanswered = 0;          ///< 0: neither done nor refused within the limit of a capture
    int refused_for_nothing = 0; ///< 0: while nothing was wrong
    int left_open = 0;           ///< 0: runs that did not come to their end
    int unseen = 0;              ///< 0: unplugged, and the station did not say so
    int late_back = 0;           ///< 0: not back within 5 s of the cable
    int disturbed = 0;           ///< 0: another instrument was opened anew
    int wrong_points = 0;        ///< 0: not what the laser showed in the point's window
    int wrong_dates = 0;         ///< 0: a run file whose UTC is not that of its arming
    int wrong_times = 0;         ///< 0: of an event or closing on paper, by a clock nobody sets
    int left_standing = 0;       ///< clock steps that stay from mid-run to behind the closing
    int untold_waits = 0;        ///< 0: results waited too long without an alarm
    int false_alarms = 0;        ///< 0: an alarm of few results that have not waited so long
    int too_many_notes = 0;      ///< 0: a list that grows
    std::map<std::string, int> faults;
    std::vector<std::size_t> bytes_at_midnight; ///< in use on the heap; 0 where it cannot be told
};

class Week {
public:
    Week(std::uint64_t seed, Duration laser_idle_period);
    /// One hour: a trouble at a random moment, or in mid-run; a run over the turn of the hour.
    void hour();
    [[nodiscard]] const Tally& tally() const { return tally_; }
    /// Everything published and every run file read.
    void settle();

private:
    struct Heard final : PublisherListener {
        int published_count = 0;
        void published(const PublishReceipt&) override { ++published_count; }
        void waiting(const std::string&, const Error&) override {}
        void destination_back() override {}
        void progress() override {}
    };

    void run(Duration span);
    void carry_to_share();
    void idle_trouble(Trouble trouble);
    void measure(Trouble trouble);
    bool take(int step, bool may_be_refused);
    void close_and_check(const std::string& path, bool all_taken, std::int64_t armed_utc_ns);
    void check_times(RunRecord record);
    void unplug(BenchInstrument& one);
    void plug_in(BenchInstrument& one);
    void step_clock(Duration by);
    void lose_share(bool lost);
    void judge_alarm();
    [[nodiscard]] std::int64_t utc_ns() const { return life_.scheduler.clock_tie().utc_ns; }
    [[nodiscard]] BenchInstrument* victim(Trouble trouble) const;
    [[nodiscard]] InstrumentState state_of(const BenchInstrument& one) const;
    [[nodiscard]] std::uint64_t restarts_but(const BenchInstrument& one) const;
    [[nodiscard]] Duration some(Duration least, Duration most);

    std::mt19937_64 dice_;
    Shop shop_;
    Life life_;
    Duration idle_period_;
    MonotonicTime hour_began_;
    int hours_ = 0;
    std::array<double, 10> stood_um_{}; ///< the laser at each point, without its drift
    Duration stepped_{};
    std::optional<MonotonicTime> waits_since_, share_back_at_;
    std::set<std::string> stamped_; ///< entries that got their virtual date
    FolderDestination share_;
    Heard heard_;
    Publisher publisher_;
    Tally tally_;
};

} // namespace axiscal::testing
