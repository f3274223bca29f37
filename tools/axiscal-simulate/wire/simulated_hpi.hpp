#pragma once
// The simulated machine seen by a Lasertex HPI-3D on its pty, with its sensors of air and material.

#include "sim_clock.hpp"
#include "simulated_machine.hpp"
#include "wire/hpi_device.hpp"
#include "wire/pty.hpp"
#include "wire/simulated_device.hpp"

#include <functional>
#include <mutex>

namespace axiscal::simulate {

class SimulatedHpi final : public SimulatedDevice {
public:
    /// drive(seconds): where the drive is commanded; must be thread-safe.
    SimulatedHpi(const Scenario& scenario,
                 Pty pty,
                 SimClock clock,
                 std::function<double(double)> drive);
    /// Free running: distance k belongs to the instant k / 25 Hz, however late the thread wakes.
    void run(std::stop_token stop) override;
    [[nodiscard]] nlohmann::json place() const override;
    void set_beam(bool on);
    void restart();
    void steer(double angle_rad);

private:
    [[nodiscard]] std::string next_frames(); // one distance, and the sensors when they are due
    [[nodiscard]] std::string sensors(double seconds) const;
    void write(const std::string& frames);

    Scenario scenario_;
    std::mutex mutex_; ///< guards all below
    Pty pty_;
    SimClock clock_;
    std::function<double(double)> drive_;
    SimulatedMachine machine_;
    HpiDevice device_;
    std::string typed_;
    std::uint64_t sample_ = 0;
};

} // namespace axiscal::simulate
