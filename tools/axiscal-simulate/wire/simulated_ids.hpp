#pragma once
// The simulated machine seen by an attocube IDS3010 on TCP.

#include "sim_clock.hpp"
#include "simulated_machine.hpp"
#include "wire/ids_device.hpp"
#include "wire/simulated_device.hpp"

#include <atomic>
#include <functional>
#include <map>
#include <memory>

namespace axiscal::simulate {

class SimulatedIds final : public SimulatedDevice {
public:
    /// drive(seconds): where the drive is commanded; must be thread-safe. Listens on 127.0.0.1.
    /// @errors io: the port is taken.
    static Result<std::unique_ptr<SimulatedIds>>
    open(const Scenario& scenario, SimClock clock, std::function<double(double)> drive);
    ~SimulatedIds() override;
    SimulatedIds(const SimulatedIds&) = delete;
    SimulatedIds(SimulatedIds&&) = delete;
    SimulatedIds& operator=(const SimulatedIds&) = delete;
    SimulatedIds& operator=(SimulatedIds&&) = delete;
    void run(std::stop_token stop) override;
    [[nodiscard]] nlohmann::json place() const override { return {{"port", port_}}; }
    /// Thread-safe: holds from the next answer on.
    void steer(double angle_rad) { beam_angle_rad_ = angle_rad; }

private:
    SimulatedIds(const Scenario& scenario,
                 SimClock clock,
                 std::function<double(double)> drive,
                 int listener,
                 int port);
    bool serve(int socket, std::string& pending);
    IdsReading read_now();

    Scenario scenario_;
    SimClock clock_;
    std::function<double(double)> drive_;
    SimulatedMachine machine_;
    IdsDevice device_;
    std::atomic<double> beam_angle_rad_;
    int listener_, port_;
    std::map<int, std::string> clients_; ///< socket -> bytes not yet a request
    std::uint64_t answers_ = 0;
};

} // namespace axiscal::simulate
