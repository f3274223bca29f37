#include "wire/simulated_sensors.hpp"

#include "simulated_machine.hpp"
#include "wire/simulated_text.hpp"
#include "wire/simulated_w1.hpp"

#include <bit>
#include <cmath>
#include <thread>

namespace axiscal::simulate {

namespace {

using std::chrono::milliseconds;

std::uint16_t tenths(double value) {
    return static_cast<std::uint16_t>(static_cast<std::int16_t>(std::lround(value * 10.0)));
}

/// ICP DAS tM-TH8: channels at wire 0..7 in FC 3 and 4, engineering format, 0.1 C; channels
/// without a sensor answer 0x7FFF.
RegisterBank tm_th8(const Scenario& s, double seconds) {
    RegisterBank bank;
    for (int channel = 0; channel < 8; ++channel)
        bank.input[channel] = 0x7FFF;
    const double material = s.thermal.material.at(seconds);
    for (std::size_t i = 0; i < s.thermal.sensor_difference_k.size() && i < 8; ++i)
        bank.input[static_cast<int>(i)] = tenths(material + s.thermal.sensor_difference_k[i]);
    const auto behind = s.thermal.sensor_difference_k.size();
    if (s.laser.resolution_um && behind < 8)
        bank.input[static_cast<int>(behind)] = tenths(scale_at(s.thermal, seconds).in_celsius());
    bank.holding = bank.input;
    for (int channel = 0; channel < 8; ++channel)
        bank.holding[256 + channel] = 0x60; // type code of each channel
    for (int channel = 0; channel < 8; ++channel)
        bank.holding[448 + channel] = 0; // temperature offset of each channel
    bank.coils[266] = true;              // Celsius
    bank.coils[268] = true;              // engineering format
    for (int channel = 0; channel < 8; ++channel)
        bank.discretes[128 + channel] = bank.input[channel] == 0x7FFF;
    return bank;
}

/// XY-MD02: FC 4, wire 1 temperature s16 0.1 C, wire 2 humidity 0.1 %.
RegisterBank xy_md02(const TrueAir& air, int unit) {
    RegisterBank bank;
    bank.functions = {3, 4, 6};
    bank.input = {{1, tenths(air.temperature.in_celsius())}, {2, tenths(air.humidity.in(percent))}};
    bank.holding = {
        {0x101, static_cast<std::uint16_t>(unit)}, {0x102, 9600}, {0x103, 0}, {0x104, 0}};
    return bank;
}

/// Comet T7510: FC 3 only; temperature, humidity, computed value, pressure in 0.1 hPa, dew point.
RegisterBank comet(const TrueAir& air, int first) {
    RegisterBank bank;
    bank.functions = {3};
    const double t = air.temperature.in_celsius();
    // Dew point by the Magnus form; shown only, nobody computes from it.
    const double h = std::log(air.humidity.si()) + 17.62 * t / (243.12 + t);
    const double dew = 243.12 * h / (17.62 - h);
    const std::uint16_t values[] = {tenths(t), tenths(air.humidity.in(percent)), tenths(dew),
                                    tenths(air.pressure.in(hectopascal)), tenths(dew)};
    for (int i = 0; i < 5; ++i)
        bank.holding[first + i] = values[i];
    bank.holding[first + 0x1004] = 0x0496; // serial number, BCD, high and low
    bank.holding[first + 0x1005] = 0x0123;
    return bank;
}

void put_float(RegisterBank& bank, int address, double value, bool low_word_first) {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
    const auto high = static_cast<std::uint16_t>(bits >> 16);
    const auto low = static_cast<std::uint16_t>(bits);
    bank.holding[address] = low_word_first ? low : high;
    bank.holding[address + 1] = low_word_first ? high : low;
}

/// Vaisala HMP, alone or behind an Indigo: FC 3, floats with the low word first; humidity at 0,
/// temperature at 2; status registers from 0200 hex.
RegisterBank vaisala_hmp(const TrueAir& air) {
    RegisterBank bank;
    bank.functions = {3};
    put_float(bank, 0, air.humidity.in(percent), true);
    put_float(bank, 2, air.temperature.in_celsius(), true);
    bank.holding[0x0200] = bank.holding[0x0201] = 1; // no errors, online
    for (int status = 0x0207; status <= 0x020A; ++status)
        bank.holding[status] = 0;
    return bank;
}

/// LabJack T7: FC 3, floats with the high word first; AIN0 (0 V), AIN#_EF_READ_A from 7000 for the
/// contact sensors, -9999 where there is none, thermocouples of type K in Celsius; serial number at
/// 60028.
RegisterBank labjack_t7(const Scenario& s, double seconds) {
    constexpr double no_reading = -9999;
    RegisterBank bank;
    bank.functions = {3};
    put_float(bank, 0, 0, false);
    const double material = s.thermal.material.at(seconds);
    for (std::size_t i = 0; i < 14; ++i) {
        const bool there = i < s.thermal.sensor_difference_k.size();
        put_float(bank, 7000 + 2 * static_cast<int>(i),
                  there ? material + s.thermal.sensor_difference_k[i] : no_reading, false);
        const auto high = 2 * static_cast<int>(i);
        bank.holding[9000 + high] = bank.holding[9300 + high] = 0;
        bank.holding[9001 + high] = 22; // AIN#_EF_INDEX
        bank.holding[9301 + high] = 1;  // AIN#_EF_CONFIG_A
    }
    bank.holding[60028] = 0x1C03; // 470 012 345
    bank.holding[60029] = 0xD1B9;
    return bank;
}

class SimulatedDracal final : public SimulatedDevice {
public:
    SimulatedDracal(const Scenario& scenario, const SensorScenario& sensor, SimClock clock, Pty pty)
        : SimulatedDevice{sensor.name}
        , scenario_{scenario}
        , path_{sensor.path}
        , clock_{clock}
        , pty_{std::move(pty)} {
        stick_.fraction_digits = sensor.fraction_digits;
    }
    void run(std::stop_token stop) override;
    [[nodiscard]] nlohmann::json place() const override { return {{"path", path_}}; }

private:
    void take_commands();
    void show();
    Scenario scenario_;
    std::string path_, typed_;
    SimClock clock_;
    Pty pty_;
    DracalStick stick_;
    std::uint64_t lines_ = 0;
};

void SimulatedDracal::take_commands() {
    typed_ += pty_.read(milliseconds{20});
    for (auto end = typed_.find_first_of("\r\n"); end != std::string::npos;
         end = typed_.find_first_of("\r\n")) {
        const std::string command = typed_.substr(0, end);
        typed_.erase(0, end + 1);
        if (!command.empty() && behaviour() != Behaviour::off)
            pty_.write(stick_.answer(command) + "\r\n");
    }
    if (typed_.size() > 256) typed_.clear();
}

void SimulatedDracal::show() {
    const TrueAir air = air_at(scenario_.air, clock_.now_s());
    const std::string line = stick_.data_line(air.pressure.in(pascal), air.temperature.in_celsius(),
                                              air.humidity.in(percent)) +
                             "\r\n";
    ++lines_;
    if (behaviour() == Behaviour::garbage) return pty_.write(garbage_bytes(scenario_.seed, lines_));
    if (behaviour() != Behaviour::off) pty_.write(line);
}

void SimulatedDracal::run(std::stop_token stop) {
    double next_s = clock_.now_s();
    while (!stop.stop_requested()) {
        take_commands();
        if (behaviour() == Behaviour::flood) {
            for (int i = 0; i < 100; ++i)
                show();
        } else if (stick_.poll_ms > 0 && clock_.now_s() >= next_s) {
            show();
            next_s = clock_.now_s() + stick_.poll_ms / 1000.0;
        }
    }
}

class SimulatedRtu final : public SimulatedDevice {
public:
    SimulatedRtu(const Scenario& scenario, const SensorScenario& sensor, SimClock clock, Pty pty)
        : SimulatedDevice{sensor.name}
        , scenario_{scenario}
        , sensor_{sensor}
        , clock_{clock}
        , pty_{std::move(pty)} {}
    void run(std::stop_token stop) override;
    [[nodiscard]] nlohmann::json place() const override { return {{"path", sensor_.path}}; }

private:
    void answer(std::span<const std::uint8_t> frame);
    void serve(Bytes& pending);
    Scenario scenario_;
    SensorScenario sensor_;
    SimClock clock_;
    Pty pty_;
    std::uint64_t answers_ = 0;
};

void SimulatedRtu::answer(std::span<const std::uint8_t> frame) {
    if (!rtu_crc_right(frame) || frame[0] != sensor_.unit) return;
    ++answers_;
    // Who babbles hears nothing: an answer amid the flood could still be found by its checksum.
    if (behaviour() == Behaviour::off || behaviour() == Behaviour::flood) return;
    if (behaviour() == Behaviour::garbage)
        return pty_.write(garbage_bytes(scenario_.seed, answers_));
    RegisterBank bank = sensor_bank(scenario_, sensor_, clock_.now_s());
    const Bytes reply =
        rtu_frame(sensor_.unit, answer_pdu(bank, frame.subspan(1, frame.size() - 3)));
    pty_.write({reinterpret_cast<const char*>(reply.data()), reply.size()});
}

void SimulatedRtu::serve(Bytes& pending) {
    while (const auto length = rtu_request_length(pending)) {
        if (*length == 0) return pending.clear();
        if (pending.size() < *length) return;
        answer(std::span{pending}.first(*length));
        pending.erase(pending.begin(), pending.begin() + static_cast<std::ptrdiff_t>(*length));
    }
}

void SimulatedRtu::run(std::stop_token stop) {
    Bytes pending;
    while (!stop.stop_requested()) {
        const std::string bytes = pty_.read(milliseconds{20});
        if (bytes.empty()) pending.clear(); // silence ends a frame
        pending.insert(pending.end(), bytes.begin(), bytes.end());
        serve(pending);
        if (behaviour() == Behaviour::flood) pty_.write(garbage_bytes(scenario_.seed, ++answers_));
    }
}

class SimulatedTcp final : public SimulatedDevice {
public:
    SimulatedTcp(const Scenario& scenario, const SensorScenario& sensor, SimClock clock)
        : SimulatedDevice{sensor.name}
        , scenario_{scenario}
        , sensor_{sensor}
        , clock_{clock} {}
    Result<void> open() {
        auto answer = [this](int, std::span<const std::uint8_t> pdu) { return reply(pdu); };
        AXISCAL_TRY(slave_, TcpSlave::listen(sensor_.port, answer));
        return {};
    }
    void run(std::stop_token stop) override { slave_->run(stop); }
    [[nodiscard]] nlohmann::json place() const override { return {{"port", slave_->port()}}; }

private:
    Bytes reply(std::span<const std::uint8_t> pdu) {
        ++answers_;
        if (behaviour() == Behaviour::off) return {};
        RegisterBank bank = sensor_bank(scenario_, sensor_, clock_.now_s());
        if (behaviour() == Behaviour::on) return answer_pdu(bank, pdu);
        const std::string noise = garbage_bytes(scenario_.seed, answers_);
        return {noise.begin(), noise.end()};
    }
    Scenario scenario_;
    SensorScenario sensor_;
    SimClock clock_;
    std::unique_ptr<TcpSlave> slave_;
    std::uint64_t answers_ = 0;
};

} // namespace

RegisterBank sensor_bank(const Scenario& scenario, const SensorScenario& sensor, double seconds) {
    if (sensor.kind == "tm-th8") return tm_th8(scenario, seconds);
    if (sensor.kind == "m-7015") return tm_th8(scenario, seconds); // the same map
    if (sensor.kind == "labjack-t7") return labjack_t7(scenario, seconds);
    const TrueAir air = air_at(scenario.air, seconds);
    if (sensor.kind == "vaisala-hmp") return vaisala_hmp(air);
    return sensor.kind == "comet" ? comet(air, sensor.first_register) : xy_md02(air, sensor.unit);
}

double temperature_step_k(const SensorScenario& sensor) {
    if (sensor.kind == "vaisala-hmp" || sensor.kind == "labjack-t7") return 1e-5; // a float
    if (sensor.kind == "vaisala" || sensor.kind == "temper-serial") return 0.01;
    if (sensor.kind == "ds18b20") return 0.0625;
    return sensor.kind == "dracal-vcp" ? std::pow(10.0, -sensor.fraction_digits) : 0.1;
}

Result<std::unique_ptr<SimulatedDevice>>
open_simulated_sensor(const Scenario& scenario,
                      const SensorScenario& sensor,
                      SimClock clock,
                      const std::function<double()>& slide_mm) {
    if (sensor.kind == "ds18b20") return open_simulated_w1(scenario, sensor, clock);
    if (is_text_kind(sensor.kind)) return open_simulated_text(scenario, sensor, clock, slide_mm);
    if (sensor.path.empty()) {
        auto face = std::make_unique<SimulatedTcp>(scenario, sensor, clock);
        auto opened = face->open();
        if (!opened) return tl::unexpected<Error>(opened.error());
        return face;
    }
    AXISCAL_TRY(Pty pty, Pty::open(sensor.path));
    if (sensor.kind == "dracal-vcp")
        return std::make_unique<SimulatedDracal>(scenario, sensor, clock, std::move(pty));
    return std::make_unique<SimulatedRtu>(scenario, sensor, clock, std::move(pty));
}

} // namespace axiscal::simulate
