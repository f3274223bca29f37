#include "wire/simulated_text.hpp"

#include "simulated_machine.hpp"
#include "wire/elcomat_line.hpp"
#include "wire/gauge_line.hpp"
#include "wire/pty.hpp"
#include "wire/temper_line.hpp"
#include "wire/vaisala_line.hpp"

#include <functional>
#include <set>

namespace axiscal::simulate {

namespace {

constexpr std::size_t longest_request = 256;

const std::set<std::string> gauge_kinds{"nd-28x", "mitutoyo", "sylvac"};

/// Hears requests and answers them; flooding repeats the last answer without being asked.
class SimulatedText final : public SimulatedDevice {
public:
    /// Takes from the typed bytes what it has understood and gives the answer at this time.
    using Answer = std::function<std::string(std::string& typed, double seconds)>;
    SimulatedText(
        const SensorScenario& sensor, std::uint64_t seed, SimClock clock, Pty pty, Answer answer)
        : SimulatedDevice{sensor.name}
        , path_{sensor.path}
        , seed_{seed}
        , clock_{clock}
        , pty_{std::move(pty)}
        , answer_{std::move(answer)} {}
    void run(std::stop_token stop) override;
    [[nodiscard]] nlohmann::json place() const override { return {{"path", path_}}; }

private:
    void send(const std::string& answer);

    std::string path_;
    std::uint64_t seed_, answers_ = 0;
    SimClock clock_;
    Pty pty_;
    Answer answer_;
};

void SimulatedText::send(const std::string& answer) {
    ++answers_;
    if (behaviour() == Behaviour::off) return;
    pty_.write(behaviour() == Behaviour::garbage ? garbage_bytes(seed_, answers_) : answer);
}

void SimulatedText::run(std::stop_token stop) {
    std::string typed, last;
    while (!stop.stop_requested()) {
        typed += pty_.read(std::chrono::milliseconds{20});
        const std::string answer = answer_(typed, clock_.now_s());
        if (typed.size() > longest_request) typed.clear();
        if (!answer.empty()) send(last = answer);
        for (int i = 0; i < 100 && behaviour() == Behaviour::flood; ++i)
            pty_.write(last);
    }
}

} // namespace

bool is_text_kind(const std::string& kind) {
    return kind == "vaisala" || kind == "temper-serial" || kind == "elcomat" ||
           gauge_kinds.contains(kind);
}

double gauge_reading_mm(const Scenario& scenario, double seconds) {
    const ThermalScenario& thermal = scenario.thermal;
    const double warmer_k = thermal.material.at(seconds) - thermal.material.at(0);
    return thermal.expansion_um_per_m_k * 1e-3 * warmer_k;
}

namespace {

/// Its probe lies on the machine, beside the first contact sensor.
std::string answer_of_temper(const Scenario& scenario, std::string& typed, double seconds) {
    const TrueAir air = air_at(scenario.air, seconds);
    const auto& differences_k = scenario.thermal.sensor_difference_k;
    const double off_k = differences_k.empty() ? 0 : differences_k.front();
    const TemperTruth truth{air.temperature.in_celsius(), air.humidity.in(percent),
                            scenario.thermal.material.at(seconds) + off_k};
    return temper_answer(typed, truth);
}

SimulatedText::Answer answer_of(const Scenario& scenario,
                                const std::string& kind,
                                const std::function<double()>& slide_mm) {
    if (kind == "elcomat")
        return [polygon = scenario.polygon.value_or(PolygonScenario{}),
                slide_mm](std::string& typed, double /*seconds*/) {
            return elcomat_answer(typed, face_arcsec(polygon, slide_mm()), polygon.y_arcsec);
        };
    if (kind == "temper-serial")
        return [scenario](std::string& typed, double seconds) {
            return answer_of_temper(scenario, typed, seconds);
        };
    if (kind != "vaisala")
        return [scenario, kind](std::string& typed, double seconds) {
            return gauge_answer(kind, typed, gauge_reading_mm(scenario, seconds));
        };
    return [scenario, transmitter = VaisalaTransmitter{}](std::string& typed,
                                                          double seconds) mutable {
        const TrueAir air = air_at(scenario.air, seconds);
        return transmitter.answer(typed, {air.pressure.in(hectopascal),
                                          air.temperature.in_celsius(), air.humidity.in(percent)});
    };
}

} // namespace

Result<std::unique_ptr<SimulatedDevice>>
open_simulated_text(const Scenario& scenario,
                    const SensorScenario& sensor,
                    SimClock clock,
                    const std::function<double()>& slide_mm) {
    AXISCAL_TRY(Pty pty, Pty::open(sensor.path));
    return std::make_unique<SimulatedText>(sensor, scenario.seed, clock, std::move(pty),
                                           answer_of(scenario, sensor.kind, slide_mm));
}

} // namespace axiscal::simulate
