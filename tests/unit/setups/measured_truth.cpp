#include "tests/unit/setups/measured_truth.hpp"

#include "analysis/drift/run_drift.hpp"
#include "analysis/positioning/positioning_certificate.hpp"
#include "tests/unit/station/station_bench.hpp"

#include <chrono>
#include <variant>

namespace axiscal::hidden_truth_test {
namespace {

using namespace std::chrono_literals;
using testing::Life;
using testing::Shop;

constexpr Duration of_a_point = 15s, of_a_run = of_a_point * 110;

class Measurement {
public:
    explicit Measurement(HiddenMachine& machine)
        : machine_{machine} {
        state_in_station_file();
        for (auto& side : stops_)
            side.resize(shop_.plan().targets.size());
        shop_.reading_m = [this](MonotonicTime at) {
            return machine_.reading_m(shop_.axis.at(at) + off_um_ * 1e-3, in_seconds(at), datum_mm_,
                                      datum_s_);
        };
        shop_.shown_air = [this](int channel, MonotonicTime at) {
            return machine_.shown_air(channel, in_seconds(at));
        };
        shop_.shown_material = [this](int sensor, MonotonicTime at) {
            return machine_.shown_material_C(sensor, in_seconds(at));
        };
    }

    MeasuredTruth run() {
        MeasuredTruth out;
        datum_mm_ = shop_.plan().datum.in(mm);
        if (measure_drift(out.why_not) && measure_points(out.why_not)) compare(out);
        return out;
    }

private:
    static double in_seconds(MonotonicTime at) { return seconds_of(at - MonotonicTime{}); }

    void state_in_station_file() {
        const Stated& stated = machine_.stated();
        StationConfig& config = shop_.config;
        config.axis.material.coefficient = per_kelvin(stated.expansion * 1e-6);
        config.axis.dead_path = mm(stated.dead_path_mm);
        config.cycle.travel_high = mm(stated.length_mm + 40);
        config.cycle.interval = mm((stated.length_mm - 60) / 10);
        config.preflight.soak_change = kelvin(0.8);
        UncertaintySetup known;
        known.device_U.per_length = ppm(stated.laser_U_um_per_m);
        known.misalignment = mm(stated.beam_offset_mm);
        known.temperature_width = kelvin(stated.temperature_width_K);
        known.expansion_width = per_kelvin(stated.expansion_width * 1e-6);
        config.uncertainty = known;
    }

    void go(Life& life, double to_mm) {
        const Duration needed = shop_.axis.time_to(to_mm, life.scheduler.now());
        shop_.axis.go(to_mm, life.scheduler.now());
        life.run(needed + 50ms);
    }

    bool measure_drift(std::string& why_not) {
        Life life{shop_};
        life.laser->send_every = 20ms;
        datum_s_ = in_seconds(life.scheduler.now());
        go(life, shop_.config.cycle.travel_high.in(mm));
        DriftRequest request;
        request.duration = of_a_run;
        request.interval = 10s;
        const auto begun = life.begin_drift(request);
        life.run(of_a_run + 30s);
        if (!*begun || !**begun) return why_not = "the drift test did not begin", false;
        const auto file = read_run_file_contents(shop_.run_files().back());
        if (!file) return why_not = describe(file.error()), false;
        const auto drift = evaluate_drift(file->run, std::get<DriftSetup>(file->attachments.setup));
        if (!drift) return why_not = describe(drift.error()), false;
        shop_.config.uncertainty->eve = um(drift->eve.range);
        return true;
    }

    bool measure_points(std::string& why_not) {
        Life life{shop_};
        life.laser->send_every = 20ms;
        go(life, datum_mm_);
        life.run(20s);
        datum_s_ = in_seconds(life.scheduler.now());
        const auto armed = life.begin_arm();
        life.run(3s);
        if (!*armed || !**armed)
            return why_not = *armed ? describe((*armed)->error()) : "still arming", false;
        std::uint16_t sequence = 0;
        for (const PlannedPoint& point : shop_.plan().points) {
            const MonotonicTime next = life.scheduler.now() + of_a_point;
            drive(life, point);
            life.ask(Life::request_for(point, ++sequence));
            for (int i = 0; i < 120 && life.port->done != sequence; ++i)
                life.run(100ms);
            if (life.port->done != sequence)
                return why_not = life.status().run->last_sentence, false;
            if (next > life.scheduler.now()) life.run(next - life.scheduler.now());
        }
        file_ = life.status().run->file;
        return true;
    }

    /// With the overrun, to the target; where it stops is the truth of this approach.
    void drive(Life& life, const PlannedPoint& point) {
        const RunPlan plan = shop_.plan();
        const auto target = static_cast<std::size_t>(point.target_index);
        const bool up = point.direction == Direction::positive;
        const double at_mm = plan.targets[target].in(mm);
        go(life, at_mm - 1.5 * plan.overrun.in(mm) * (up ? 1 : -1));
        off_um_ = machine_.stop_um(at_mm, up);
        stops_[up ? 0 : 1][target].push_back(off_um_);
        go(life, at_mm);
    }

    void compare(MeasuredTruth& out) {
        auto record = read_run_file(file_);
        if (!record) return void(out.why_not = describe(record.error()));
        const auto certificate = make_certificate(*std::move(record), "");
        if (!certificate) return void(out.why_not = describe(certificate.error()));
        const RunUncertainty& known = certificate->uncertainty;
        if (!known.budget || !known.true_figures) return void(out.why_not = "no budget");
        const PositioningParameters& p = certificate->result.parameters;
        const std::map<std::string, double> values{{"A", *p.A},
                                                   {"A_forward", *p.A_forward},
                                                   {"A_backward", *p.A_backward},
                                                   {"E", *p.E},
                                                   {"E_forward", *p.E_forward},
                                                   {"E_backward", *p.E_backward},
                                                   {"M", *p.M},
                                                   {"R", *p.R},
                                                   {"R_forward", *p.R_forward},
                                                   {"R_backward", *p.R_backward},
                                                   {"B", *p.B},
                                                   {"B_mean", *p.B_mean}};
        for (const auto& [key, truth] : true_figures_of(stops_)) {
            const TrueFigure* lies_in = known.true_figures->find(key);
            const ParameterUncertainty* formula = known.budget->find(key);
            if (!lies_in || !formula) return void(out.why_not = "no U of " + key);
            out.figures[key] = {truth, values.at(key) * 1e3, formula->expanded,
                                lies_in->interval.low * 1e3, lies_in->interval.high * 1e3};
        }
    }

    HiddenMachine& machine_;
    Shop shop_;
    Stops stops_;
    double off_um_ = 0, datum_mm_ = 0, datum_s_ = 0;
    std::string file_;
};

} // namespace

MeasuredTruth measure(HiddenMachine& machine) {
    return Measurement{machine}.run();
}

} // namespace axiscal::hidden_truth_test
