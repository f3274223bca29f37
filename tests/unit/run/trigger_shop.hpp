#pragma once
// A shop floor in virtual time: the real run machine behind the real register maps and the Modbus
// codec, a disk that takes its time, and an axis that stands where its CNC put it. The wire
// carries bytes. What the axis truly did is kept apart from what the station recorded.

#include "bench.hpp"

#include "acquisition/run/resume.hpp"
#include "drivers/trigger/coil_and_index_map.hpp"
#include "drivers/trigger/mbap_framer.hpp"
#include "drivers/trigger/sequence_block_map.hpp"
#include "drivers/trigger/single_register_map.hpp"
#include "tests/support/raw_modbus_client.hpp"

#include <algorithm>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace axiscal::testing {

using std::chrono::milliseconds;

/// Events in the order of their time; equal times in the order in which they were given.
class VirtualClock {
public:
    [[nodiscard]] MonotonicTime now() const { return now_; }
    void at(MonotonicTime when, std::function<void()> action) {
        queue_.emplace(std::max(when, now_), std::move(action));
    }
    void after(Duration span, std::function<void()> action) { at(now_ + span, std::move(action)); }
    /// False when nothing is left to happen.
    bool step() {
        if (queue_.empty()) return false;
        auto first = queue_.extract(queue_.begin());
        now_ = first.key();
        first.mapped()();
        return true;
    }

private:
    MonotonicTime now_ = at_s(100);
    std::multimap<MonotonicTime, std::function<void()>> queue_;
};

class Dice {
public:
    explicit Dice(std::uint64_t seed)
        : random_{seed} {}
    bool one_in(unsigned sides) { return random_() % sides == 0; }
    int between(int low, int high) {
        return low + static_cast<int>(random_() % static_cast<unsigned>(high - low + 1));
    }
    Duration span(int low_ms, int high_ms) { return milliseconds{between(low_ms, high_ms)}; }

private:
    std::mt19937_64 random_;
};

/// Where the axis truly is.
struct Axis {
    Length place;
    MonotonicTime still_since;
    bool moving = false;
};

/// A trigger port without its socket.
struct PortOnPaper {
    std::unique_ptr<RegisterMap> map;
    std::function<void(std::uint16_t)> finish;
};

/// Opens `finish`, which the product reaches only with a receipt.
template <class Map> class OpenMap : public Map {
public:
    using Map::finish;
    using Map::Map;
};

template <class Map, class... Args> PortOnPaper port_of(Args... args) {
    auto map = std::make_unique<OpenMap<Map>>(args...);
    auto* raw = map.get();
    return {std::move(map), [raw](std::uint16_t sequence) { raw->finish(sequence); }};
}

inline PortOnPaper port_of(TriggerShape shape, Duration index_grace) {
    if (shape == TriggerShape::single_register) return port_of<SingleRegisterMap>();
    if (shape == TriggerShape::coil_and_index) return port_of<CoilAndIndexMap>(index_grace);
    return port_of<SequenceBlockMap>(false, false);
}

/// The daemon as the run machine sees it. Dying loses all but the disk.
class Station {
public:
    static constexpr Duration woken_late = milliseconds{10}; ///< for what is due

    /// `index_grace`: longer than one pass of the client, as docs/trigger.md asks.
    Station(VirtualClock& on, Dice& with, Axis& watched, TriggerShape of_shape, Duration grace)
        : clock{on}
        , dice{with}
        , axis{watched}
        , shape{of_shape}
        , index_grace{grace}
        , port{port_of(of_shape, grace)}
        , machine{setup} {
        disk.plan = setup.plan;
        disk.laser = small_laser();
        feed(EnvironmentNow{air_index_minus_1});
        tick();
    }

    void arm() { feed(Arm{clock.now(), true}); }

    /// kill -9. A commit under way may be on the disk or not; the port is back after `away`.
    void die(Duration away) {
        ++life;
        open = false;
        if (commit && dice.one_in(2)) commit();
        commit = nullptr;
        window = 0;
        inputs.clear();
        clock.after(away, [this] { come_back(); });
    }

    /// What a client's frame does; empty when it gets no answer.
    std::optional<RegisterImage> serve(const std::vector<std::uint8_t>& frame) {
        const auto request =
            parse_modbus_request({frame.data() + mbap_header, frame.size() - mbap_header});
        const auto verdict = request ? port.map->space().check(*request) : request.error();
        if (verdict != ModbusException::none) return std::nullopt;
        if (!request->values.empty()) {
            deliver(port.map->write(*request, clock.now()));
            if (shape == TriggerShape::coil_and_index) tick_map_later();
        }
        return port.map->image();
    }

    VirtualClock& clock;
    Dice& dice;
    Axis& axis;
    RunSetup setup = small_setup();
    TriggerShape shape;
    Duration index_grace;
    RunRecord disk; ///< survives
    PortOnPaper port;
    RunMachine machine;
    int life = 0;
    bool open = true, closed = false, complete = false;
    std::string closing_reason;
    std::set<std::string> refusals; ///< sentences, of all lives

private:
    void come_back() {
        port = port_of(shape, index_grace);
        machine = RunMachine{setup, disk, 1, clock.now()};
        open = true;
        feed(EnvironmentNow{air_index_minus_1});
        const auto last = last_durable_request(disk);
        if (last.sequence == 0)
            port.map->arm();
        else
            port.finish(last.sequence);
        tick();
    }

    void tick() {
        clock.after(milliseconds{500}, [this, of = life] {
            if (of != life || closed) return;
            feed(Tick{clock.now()});
            tick();
        });
    }
    /// Only an edge of the coil waits for time to pass.
    void tick_map_later() {
        clock.after(index_grace + woken_late, [this, of = life] {
            if (of == life) deliver(port.map->tick(clock.now()));
        });
    }

    void deliver(const MapNews& news) {
        for (const auto& event : news.events)
            feed(event);
    }

    void feed(const RunInput& input) {
        inputs.push_back(input);
        if (std::exchange(feeding, true)) return;
        while (!inputs.empty()) {
            const RunInput next = std::move(inputs.front());
            inputs.pop_front();
            for (const auto& action : machine.handle(next))
                std::visit([this](const auto& step) { perform(step); }, action);
        }
        feeding = false;
    }

    void perform(const PublishArmed&) { port.map->arm(); }
    void perform(const OpenWindow& action) {
        window = action.window;
        look(action);
    }
    void perform(const CloseWindow&) { window = 0; }
    void perform(const CommitPoint& action) {
        write([this, point = action.point] { disk.points.push_back(point); }, action.point.sequence,
              action.point.step);
    }
    void perform(const CommitDatum& action) {
        write([this, datum = action.datum] { disk.datums.push_back(datum); }, action.datum.sequence,
              -1);
    }
    void perform(const CommitEvent& action) {
        write([this, event = action.event] { disk.events.push_back(event); }, action.event.sequence,
              action.step);
    }
    void perform(const Acknowledge& action) { port.finish(action.sequence); }
    void perform(const RepublishDone& action) { port.finish(action.sequence); }
    void perform(const Refuse& action) {
        refusals.insert(action.sentence);
        port.map->refuse(action.sequence, action.fault);
    }
    void perform(const RecordEvent& /*action*/) {}
    void perform(const RecordRetake& /*action*/) {}
    void perform(const RecordExclusion& /*action*/) {}
    void perform(const SetState& /*action*/) {}
    void perform(const Close& action) {
        closed = true;
        complete = action.complete;
        closing_reason = action.reason;
        if (!action.complete)
            port.map->end_run(action.answers_cnc ? RunEnd::once_answered : RunEnd::at_once);
    }

    /// Still for half a second after the trigger, or given up at the deadline.
    void look(const OpenWindow& wanted) {
        if (window != wanted.window) return;
        const auto now = clock.now();
        const auto since = std::max(axis.still_since, wanted.from);
        if (!axis.moving && now - since >= milliseconds{500}) {
            window = 0;
            return feed(WindowResult{wanted.window, capture(now), now});
        }
        if (now >= wanted.deadline) {
            window = 0;
            return feed(WindowResult{wanted.window, fail(Fault::not_still, "It moved."), now});
        }
        clock.after(milliseconds{50}, [this, wanted, of = life] {
            if (of == life) look(wanted);
        });
    }

    [[nodiscard]] Capture capture(MonotonicTime now) const {
        Capture capture;
        capture.begin = now - milliseconds{500};
        capture.end = now;
        capture.mean = reading_of(axis.place);
        capture.n = 500;
        capture.epoch = 1;
        capture.approach_travel = setup.plan.overrun;
        return capture;
    }

    void write(std::function<void()> put, std::uint16_t sequence, int step) {
        commit = std::move(put);
        clock.after(dice.span(1, dice.one_in(10) ? 800 : 20), [this, sequence, step, of = life] {
            if (of != life || !commit) return;
            std::exchange(commit, nullptr)();
            feed(Committed{sequence, step, clock.now()});
        });
    }

public:
    [[nodiscard]] Length reading_of(Length coordinate) const {
        return 3.0_mm +
               (coordinate - setup.plan.datum) * (setup.reading->sign() * (1 + air_index_minus_1));
    }

private:
    std::function<void()> commit; ///< under way
    std::uint64_t window = 0;
    std::deque<RunInput> inputs;
    bool feeding = false;
};

} // namespace axiscal::testing
