#include "tests/unit/setups/measured_setup.hpp"

#include "analysis/positioning/positioning_certificate.hpp"
#include "tests/unit/station/station_bench.hpp"

namespace axiscal::setups_test {
namespace {

using namespace std::chrono_literals;
using testing::Life;
using testing::Shop;

constexpr Duration time_of_a_point = 15s;
constexpr int late_from = 2; // one step late between the third target and the ninth
constexpr int late_to = 8;

double in_seconds(MonotonicTime at) {
    return seconds_of(at - MonotonicTime{});
}

class Measurement {
public:
    explicit Measurement(RandomMachine& machine)
        : machine_{machine}
        , late_at_{static_cast<int>(machine.between(late_from, late_to + 1))}
        , inch_{machine.between(0, 1) < 0.5 ? 25.4 : 1 / 25.4} {
        state_in_station_file();
        shop_.reading_m = [this](MonotonicTime at) {
            return machine_.reading_m(shop_.axis.at(at) + off_mm_, in_seconds(at), datum_mm_,
                                      datum_s_);
        };
        shop_.shown_air = [this](int channel, MonotonicTime at) {
            return machine_.shown_air(channel, in_seconds(at));
        };
        shop_.shown_material = [this](int sensor, MonotonicTime at) {
            return machine_.shown_material_C(sensor, in_seconds(at));
        };
    }

    std::vector<Said> run() {
        Life life{shop_};
        datum_mm_ = shop_.plan().datum.in(mm);
        life.laser->send_every = 1s;
        life.run(shop_.config.preflight.soak_window + 30s);
        life.laser->send_every = 20ms;
        go(life, datum_mm_, true);
        life.run(shop_.config.preflight.drift_window + 10s);
        if (!arm(life) || !take_points(life)) return said_;
        tell_end(life.status().run->file);
        return said_;
    }

private:
    [[nodiscard]] bool is(Mistake mistake) const { return machine_.mistake() == mistake; }
    void say(std::string where, std::string words) {
        said_.push_back({std::move(where), std::move(words)});
    }

    void state_in_station_file() {
        StationConfig& config = shop_.config;
        config.preflight.soak_window = 10min;
        config.preflight.drift_window = 30s;
        config.preflight.soak_change = kelvin(0.8);
        config.axis.material.coefficient = per_kelvin(machine_.stated_expansion() * 1e-6);
        config.axis.dead_path = is(Mistake::no_dead_path) ? Length{} : mm(machine_.dead_path_mm());
        config.cycle.travel_high = mm(machine_.length_mm() + 40);
        config.cycle.interval = mm((machine_.length_mm() - 60) / 10);
        config.instruments.front().serial = is(Mistake::other_instrument) ? "S-2" : "S-1";
    }

    /// As the program says, in the unit that it is taken for.
    void go(Life& life, double to_mm, bool from_below) {
        if (is(Mistake::inch_for_millimetre)) to_mm = datum_mm_ + (to_mm - datum_mm_) * inch_;
        off_mm_ = machine_.stop_at(to_mm, from_below) - to_mm;
        const Duration needed = shop_.axis.time_to(to_mm, life.scheduler.now());
        shop_.axis.go(to_mm, life.scheduler.now());
        life.run(needed + 50ms);
    }

    bool arm(Life& life) {
        ArmRequest request;
        if (is(Mistake::wrong_expansion)) request.overrides["soak"] = "no better room";
        const auto checks = life.preflight(request);
        if (!checks) return say("arm", describe(checks.error())), false;
        for (const PreflightRecord& check : *checks)
            if (check.warning || (!check.passed && check.override_reason.empty()))
                say("arm", check.name + ": " + check.verdict);
        if (!open_objections(*checks).empty()) return false;
        datum_s_ = in_seconds(life.scheduler.now());
        const auto answer = life.begin_arm(request);
        life.run(3s);
        if (*answer && **answer) return true;
        say("arm", *answer ? describe((*answer)->error()) : "still arming");
        return false;
    }

    void drive(Life& life, const PlannedPoint& point) {
        if (is(Mistake::one_step_late) && point.step == late_at_) return;
        const RunPlan plan = shop_.plan();
        const double target = plan.targets[static_cast<std::size_t>(point.target_index)].in(mm);
        const bool exchanged = is(Mistake::exchanged_directions);
        const bool from_below = (point.direction == Direction::positive) != exchanged;
        const double way_mm = 1.5 * plan.overrun.in(mm) * (from_below ? 1 : -1);
        if (!is(Mistake::no_overrun)) go(life, target - way_mm, from_below);
        go(life, target, from_below);
    }

    bool take_points(Life& life) {
        std::uint16_t sequence = 0;
        for (const PlannedPoint& point : shop_.plan().points) {
            const MonotonicTime next = life.scheduler.now() + time_of_a_point;
            drive(life, point);
            life.ask(Life::request_for(point, ++sequence));
            for (int i = 0; i < 120 && life.port->done != sequence; ++i) {
                if (!life.port->refusals.empty()) break;
                life.run(100ms);
            }
            if (life.port->done != sequence) {
                say("point " + std::to_string(sequence), life.status().run->last_sentence);
                return false;
            }
            if (next > life.scheduler.now()) life.run(next - life.scheduler.now());
        }
        return true;
    }

    void tell_end(const std::string& file) {
        auto record = read_run_file(file);
        if (!record) return say("end", describe(record.error()));
        const auto certificate = make_certificate(*std::move(record), "");
        if (!certificate) return say("end", describe(certificate.error()));
        for (const SetupFinding& found : certificate->setup_findings)
            say("end", found.seen + " " + found.probably);
    }

    RandomMachine& machine_;
    int late_at_;
    double inch_;
    Shop shop_;
    double off_mm_ = 0, datum_mm_ = 0, datum_s_ = 0;
    std::vector<Said> said_;
};

} // namespace

std::vector<Said> measure(RandomMachine& machine) {
    return Measurement{machine}.run();
}

} // namespace axiscal::setups_test
