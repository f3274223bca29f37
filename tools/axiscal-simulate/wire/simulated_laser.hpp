#pragma once
// The laser on its pty: samples the simulated machine at the counter's rate and writes records.

#include "sim_clock.hpp"
#include "simulated_machine.hpp"
#include "straightness_optics.hpp"
#include "wire/pty.hpp"
#include "wire/simulated_device.hpp"
#include "wire/umd_counter.hpp"

#include <functional>
#include <mutex>
#include <optional>

namespace axiscal::simulate {

class SimulatedLaser final : public SimulatedDevice {
public:
    /// drive(seconds): where the drive is commanded; must be thread-safe. table(seconds): the same
    /// of the indexing table, where there is one.
    SimulatedLaser(const Scenario& scenario,
                   Pty pty,
                   SimClock clock,
                   std::function<double(double)> drive,
                   std::function<double(double)> table = {});

    /// Free running: record k belongs to the instant k / rate, however late the thread wakes.
    void run(std::stop_token stop) override;
    /// Driven from outside instead of run(): the next sample of an external position stream.
    void feed(double drive_mm);
    /// The instant of the next record, seconds from the first one.
    [[nodiscard]] double next_s() const;

    [[nodiscard]] nlohmann::json place() const override;
    [[nodiscard]] nlohmann::json status() const override;
    /// Where the slide is, of the last sample.
    [[nodiscard]] double slide_mm() const;
    void set_beam(bool on);
    void restart_counter();
    void skip_records(int count);
    void set_fields(int fields);
    void set_error_mask(int mask);
    void steer(double angle_rad);
    void move_optic(double by_mm);

private:
    void step(double drive_mm);
    double cycles_over_table(double seconds);
    /// What its optics show of this sample.
    double cycles_now(double drive_mm, double seconds);
    void write(const std::string& record);

    Scenario scenario_;
    mutable std::mutex mutex_; ///< guards all below
    Pty pty_;
    SimClock clock_;
    std::function<double(double)> drive_, table_;
    SimulatedMachine machine_;
    std::optional<StraightnessOptics> across_;
    UmdCounter counter_;
    std::uint64_t sample_ = 0;
    double slide_mm_ = 0;
    bool beam_ = true; ///< as commanded; it is lost beyond the range of an angular interferometer
};

} // namespace axiscal::simulate
