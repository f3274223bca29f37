// Ten thousand runs against CNCs that double, repeat, come late, leave their coil up, are slow,
// lose the daemon in mid-request, or break the contract. Seeded: a failing run is told by its seed
// and comes again with it.
//   AXISCAL_SEED=N   the N-th ten thousand behind the ones that are always played (tools/soak)
#include "tests/support/asked_seed.hpp"
#include "trigger_cnc.hpp"

#include <gtest/gtest.h>

#include <array>
#include <iostream>

namespace axiscal::trigger_sequences_test {
namespace {

using testing::Axis;
using testing::Cnc;
using testing::Dice;
using testing::Kind;
using testing::Mischief;
using testing::Station;
using testing::VirtualClock;

constexpr int sequences = 10'000;
constexpr Duration quick_grace = std::chrono::milliseconds{50};
constexpr Duration slow_grace = std::chrono::seconds{4};

struct Row {
    const char* name;
    std::set<Kind> kinds;
    bool must_finish;
    std::vector<std::string> phrases; ///< that name what was broken: one of them must come
};

const std::array rows{
    Row{"doubled", {Kind::doubled}, true, {}},
    Row{"repeated", {Kind::repeated}, true, {}},
    Row{"late", {Kind::late}, true, {}},
    Row{"stale coil", {Kind::stale_coil}, true, {}},
    Row{"slow client", {Kind::slow_client}, true, {}},
    Row{"daemon restart", {Kind::daemon_restart}, true, {}},
    Row{"doubled, repeated, restart",
        {Kind::doubled, Kind::repeated, Kind::daemon_restart},
        true,
        {}},
    Row{"missed", {Kind::missed}, false, {"was missed"}},
    Row{"out of order", {Kind::out_of_order}, false, {"missed", "came late"}},
    Row{"restarted counter", {Kind::restarted_counter}, false, {"counter was restarted"}},
};

struct Outcome {
    bool finished = false;
    std::string complaint; ///< empty: all is as promised
};

TriggerShape shape_for(const Row& row, Dice& dice) {
    if (row.kinds.contains(Kind::stale_coil)) return TriggerShape::coil_and_index;
    constexpr std::array shapes{TriggerShape::single_register, TriggerShape::coil_and_index,
                                TriggerShape::sequence_block};
    return shapes[static_cast<std::size_t>(dice.between(0, 2))];
}

/// Every recorded point is the next one of the plan, under the number the CNC gave, and holds what
/// the axis truly showed there.
std::string what_is_wrong(const Station& station, const Cnc& cnc) {
    const auto& points = station.disk.points;
    const auto& plan = station.setup.plan;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::string which = "point " + std::to_string(i + 1);
        if (points[i].step != static_cast<int>(i) || points[i].planned != plan.points[i])
            return which + " is not the plan's";
        if (points[i].sequence != i + 1)
            return which + " has number " + std::to_string(points[i].sequence);
        const auto truth =
            plan.targets[static_cast<std::size_t>(plan.points[i].target_index)] + cnc.errors()[i];
        if (abs(points[i].reading - station.reading_of(truth)) > 1.0_nm)
            return which + " was not read where the axis stood";
    }
    return cnc.broken_promise;
}

bool named(const Station& station, const Row& row) {
    return std::ranges::any_of(row.phrases, [&](const std::string& phrase) {
        return std::ranges::any_of(station.refusals, [&](const std::string& sentence) {
            return sentence.find(phrase) != std::string::npos;
        });
    });
}

Outcome play(const Row& row, std::uint64_t seed) {
    Dice dice{seed};
    VirtualClock clock;
    Axis axis;
    const bool slow = row.kinds.contains(Kind::late) || row.kinds.contains(Kind::slow_client);
    const auto shape = shape_for(row, dice);
    Station station{clock, dice, axis, shape, slow ? slow_grace : quick_grace};
    Mischief mischief{row.kinds};
    if (!row.must_finish) // the counter must have got somewhere to be seen to begin again
        mischief.breaks_at =
            dice.between(2, static_cast<int>(station.setup.plan.points.size()) - 2);
    Cnc cnc{station, mischief};
    clock.after(dice.span(1000, 6000), [&] { station.arm(); });
    const auto end = clock.now() + std::chrono::minutes{20};
    while (!cnc.at_end() && !cnc.held() && clock.now() < end)
        clock.step();
    const auto settled =
        clock.now() + std::chrono::seconds{2}; // the file is closed after the last answer
    while (!station.closed && clock.now() < settled)
        clock.step();
    Outcome outcome;
    const bool whole = station.disk.points.size() == station.setup.plan.points.size();
    outcome.finished = cnc.at_end() && station.closed && station.complete && whole;
    outcome.complaint = what_is_wrong(station, cnc);
    if (!outcome.complaint.empty()) return outcome;
    if (row.must_finish && !outcome.finished)
        outcome.complaint = "stopped after " + std::to_string(station.disk.points.size()) +
                            " points: " + station.closing_reason +
                            (station.refusals.empty() ? "" : " " + *station.refusals.begin());
    if (!row.must_finish && !outcome.finished && !named(station, row))
        outcome.complaint = "stopped, and no message names it: " +
                            (station.refusals.empty() ? "silence" : *station.refusals.begin());
    return outcome;
}

TEST(TriggerSequences, TenThousandFuzzedOnesFinishUnlessTheContractIsBrokenAndThenSayHow) {
    std::array<int, rows.size()> played{}, finished{};
    int told = 0;
    const std::uint64_t first = testing::asked_seed().value_or(0) * sequences + 1;
    for (int i = 0; i < sequences; ++i) {
        const auto kind = static_cast<std::size_t>(i) % rows.size();
        const auto seed = first + static_cast<std::uint64_t>(i);
        const auto outcome = play(rows[kind], seed);
        ++played[kind];
        finished[kind] += outcome.finished ? 1 : 0;
        if (outcome.complaint.empty() || ++told > 10) continue;
        ADD_FAILURE() << rows[kind].name << ", seed " << seed << ": " << outcome.complaint;
    }
    for (std::size_t kind = 0; kind < rows.size(); ++kind) {
        std::cout << rows[kind].name << ": " << finished[kind] << " of " << played[kind]
                  << " finished" << (rows[kind].must_finish ? "" : ", the others named the reason")
                  << "\n";
        if (rows[kind].must_finish) {
            EXPECT_EQ(finished[kind], played[kind]) << rows[kind].name;
        }
    }
}

TEST(TriggerSequences, ACounterThatBeginsAgainAfterItsFirstPointIsARepeatAndStopsByThePlace) {
    testing::Bench bench;
    bench.arm().point(1);
    bench.trigger(1);
    EXPECT_TRUE(bench.saw<RepublishDone>());
    bench.trigger(2).window(bench.capture_at(220.0_mm)); // the CNC is one target ahead
    ASSERT_TRUE(bench.saw<Refuse>());
    EXPECT_EQ(bench.points.size(), 1u);
}

} // namespace
} // namespace axiscal::trigger_sequences_test
