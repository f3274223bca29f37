#include "wire/simulated_w1.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <thread>

namespace axiscal::simulate {

namespace {

constexpr auto period = std::chrono::milliseconds{100};

unsigned crc8_maxim(const unsigned (&bytes)[8]) {
    unsigned crc = 0;
    for (const unsigned byte : bytes) {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit)
            crc = (crc & 1U) != 0 ? (crc >> 1) ^ 0x8CU : crc >> 1;
    }
    return crc;
}

class SimulatedW1 final : public SimulatedDevice {
public:
    SimulatedW1(const Scenario& scenario, const SensorScenario& sensor, SimClock clock)
        : SimulatedDevice{sensor.name}
        , scenario_{scenario}
        , folder_{sensor.path}
        , clock_{clock} {}
    /// @errors io.
    Result<void> show();
    void run(std::stop_token stop) override;
    [[nodiscard]] nlohmann::json place() const override { return {{"path", folder_.string()}}; }

private:
    Result<void> write(const std::filesystem::path& path, const std::string& text);
    Scenario scenario_;
    std::filesystem::path folder_;
    SimClock clock_;
    std::uint64_t rounds_ = 0;
};

/// A reader finds the old text or the new one, never half of it.
Result<void> SimulatedW1::write(const std::filesystem::path& path, const std::string& text) {
    const std::filesystem::path fresh{path.string() + ".new"};
    std::ofstream{fresh} << text;
    std::error_code error;
    std::filesystem::rename(fresh, path, error);
    if (error) return fail(Fault::io, path.string() + " can not be written", error);
    return {};
}

Result<void> SimulatedW1::show() {
    ++rounds_;
    std::error_code error;
    const double material = scenario_.thermal.material.at(clock_.now_s());
    for (std::size_t i = 0; i < scenario_.thermal.sensor_difference_k.size(); ++i) {
        char name[24];
        std::snprintf(name, sizeof name, "28-%012zx", i + 1);
        const auto place = folder_ / name;
        if (behaviour() == Behaviour::off) {
            std::filesystem::remove_all(place, error);
            continue;
        }
        std::filesystem::create_directories(place, error);
        std::string text = w1_slave_text(material + scenario_.thermal.sensor_difference_k[i]);
        if (behaviour() == Behaviour::garbage) text = garbage_bytes(scenario_.seed, rounds_);
        AXISCAL_CHECK(write(place / "w1_slave", text));
        AXISCAL_CHECK(write(place / "temperature", text.substr(text.rfind("t=") + 2)));
    }
    return {};
}

void SimulatedW1::run(std::stop_token stop) {
    while (!stop.stop_requested()) {
        (void)show(); // a folder that went away is a sensor that went away
        std::this_thread::sleep_for(period);
    }
}

} // namespace

std::string w1_slave_text(double celsius) {
    const long raw = std::lround(celsius * 16);
    const unsigned bytes[8] = {static_cast<unsigned>(raw) & 0xFFU,
                               (static_cast<unsigned>(raw) >> 8) & 0xFFU,
                               0x4B,
                               0x46,
                               0x7F,
                               0xFF,
                               0x0C,
                               0x10};
    const unsigned crc = crc8_maxim(bytes);
    std::string pad;
    char hex[16];
    for (const unsigned byte : bytes) {
        std::snprintf(hex, sizeof hex, "%02x ", byte);
        pad += hex;
    }
    std::snprintf(hex, sizeof hex, "%02x", crc);
    pad += hex;
    return pad + " : crc=" + hex + " YES\n" + pad + " t=" + std::to_string(raw * 1000 / 16) + "\n";
}

Result<std::unique_ptr<SimulatedDevice>>
open_simulated_w1(const Scenario& scenario, const SensorScenario& sensor, SimClock clock) {
    auto face = std::make_unique<SimulatedW1>(scenario, sensor, clock);
    auto shown = face->show();
    if (!shown) return tl::unexpected<Error>(shown.error());
    return face;
}

} // namespace axiscal::simulate
