#pragma once
// A station on paper: keeps what the machine asked for and answers it. No clock, no wire.

#include "acquisition/run/cycle_plan.hpp"
#include "acquisition/run/run_machine.hpp"

#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace axiscal::testing {

inline MonotonicTime at_s(double seconds) {
    return MonotonicTime{from_seconds(seconds)};
}

inline constexpr double air_index_minus_1 = 2.7e-4;

/// Five targets, one approach each way: ten points, datum at 0 mm.
inline RunPlan small_plan() {
    CycleConfig config;
    config.travel_low = 0.0_mm;
    config.travel_high = 500.0_mm;
    config.targets = std::vector<Length>{20.0_mm, 120.0_mm, 220.0_mm, 320.0_mm, 420.0_mm};
    config.overrun = 10.0_mm;
    config.approaches = 1;
    return plan_passes(config, 1)->front();
}

inline LaserSetup small_laser(int sign = 1) {
    LaserSetup laser;
    laser.instrument = "laser";
    laser.sign = sign;
    return laser;
}

inline RunSetup small_setup() {
    RunSetup setup;
    setup.plan = small_plan();
    setup.reading = along_the_axis(small_laser());
    setup.laser_serial = "UMD-17";
    return setup;
}

class Bench {
public:
    explicit Bench(RunSetup of_run = small_setup())
        : setup{std::move(of_run)}
        , machine{setup} {
        give(EnvironmentNow{air_index_minus_1});
    }

    template <class Action> [[nodiscard]] std::vector<Action> all() const {
        std::vector<Action> found;
        for (const auto& action : last)
            if (const auto* one = std::get_if<Action>(&action)) found.push_back(*one);
        return found;
    }
    template <class Action> [[nodiscard]] bool saw() const { return !all<Action>().empty(); }
    template <class Action> [[nodiscard]] Action the() const {
        const auto found = all<Action>();
        return found.empty() ? Action{} : found.front();
    }

    /// Feeds one input; `last` is what came of it. An order is on disk at once, if `keeps_orders`.
    Bench& give(const RunInput& input) {
        last = machine.handle(input);
        if (keeps_orders && (saw<RecordRetake>() || saw<RecordExclusion>()))
            for (RunAction& action : machine.handle(RevisionKept{tick()}))
                last.push_back(std::move(action));
        for (const auto& action : last)
            note(action);
        return *this;
    }

    static TriggerEvent request(std::uint16_t sequence,
                                TriggerCommand command = TriggerCommand::capture) {
        TriggerEvent event;
        event.sequence = sequence;
        event.command = command;
        return event;
    }
    Bench& trigger(std::uint16_t sequence, TriggerCommand command = TriggerCommand::capture) {
        return trigger(request(sequence, command));
    }
    Bench& trigger(TriggerEvent event) {
        event.at = tick();
        return give(event);
    }

    /// The reading of an axis that stands at `coordinate`, in vacuum wavelengths.
    [[nodiscard]] Length reading_at(Length coordinate) const {
        return reading_zero +
               (coordinate - setup.plan.datum) * (setup.reading->sign() * (1 + air_index_minus_1));
    }
    [[nodiscard]] Capture capture_at(Length coordinate) const {
        Capture capture;
        capture.begin = at_s(now_s);
        capture.end = at_s(now_s + 0.5);
        capture.mean = reading_at(coordinate);
        capture.n = 500;
        capture.epoch = epoch;
        capture.device_count = 77;
        capture.samples = {{capture.begin, capture.mean.si(), 70}, {capture.end, 0, 77}};
        capture.approach_travel = setup.plan.overrun;
        return capture;
    }
    Bench& window(Result<Capture> capture) {
        now_s += 0.5;
        return give(WindowResult{open_window.window, std::move(capture), tick()});
    }
    /// The axis stands where the open window expects it.
    Bench& window_here() { return window(capture_at(open_window.expected)); }
    Bench& commit() { return give(Committed{commit_sequence, commit_step, tick()}); }

    Bench& arm() { return give(Arm{tick(), true}).window_here().commit(); }
    /// One point, start to end.
    Bench& point(std::uint16_t sequence) { return trigger(sequence).window_here().commit(); }

    MonotonicTime tick() { return at_s(now_s += 0.01); }

    RunSetup setup;
    RunMachine machine;
    RunActions last;
    bool keeps_orders = true;
    double now_s = 100;
    Length reading_zero = 3.0_mm;
    std::uint32_t epoch = 1;
    OpenWindow open_window;
    std::uint16_t commit_sequence = 0;
    int commit_step = -1;
    std::vector<std::uint16_t> acknowledged;
    std::vector<PointRecord> points; ///< asked to be committed

private:
    void note(const RunAction& action) {
        if (const auto* open = std::get_if<OpenWindow>(&action)) open_window = *open;
        if (const auto* datum = std::get_if<CommitDatum>(&action))
            commit_sequence = datum->datum.sequence, commit_step = -1;
        if (const auto* event = std::get_if<CommitEvent>(&action))
            commit_sequence = event->event.sequence, commit_step = event->step;
        if (const auto* point = std::get_if<CommitPoint>(&action)) {
            commit_sequence = point->point.sequence, commit_step = point->point.step;
            points.push_back(point->point);
        }
        if (const auto* done = std::get_if<Acknowledge>(&action))
            acknowledged.push_back(done->sequence);
    }
};

/// The last input was refused for `fault`, with `words` in the sentence, and nothing acknowledged.
inline void expect_refused(const Bench& bench, Fault fault, const std::string& words = {}) {
    ASSERT_TRUE(bench.saw<Refuse>());
    const auto refusal = bench.the<Refuse>();
    EXPECT_EQ(refusal.fault, fault) << refusal.sentence;
    EXPECT_NE(refusal.sentence.find(words), std::string::npos) << refusal.sentence;
    EXPECT_FALSE(bench.saw<Acknowledge>());
}

} // namespace axiscal::testing
