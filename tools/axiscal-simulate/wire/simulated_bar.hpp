#pragma once
// A ballbar whose length a µMD counter reads, by a laser or a glass scale, on its pty: the
// simulated machine's circle with its hidden errors. The counter was zeroed at the nominal radius.

#include "cnc/commanded_plane.hpp"
#include "seeded_noise.hpp"
#include "sim_clock.hpp"
#include "simulated_machine.hpp"
#include "wire/pty.hpp"
#include "wire/simulated_device.hpp"
#include "wire/umd_counter.hpp"

#include <mutex>

namespace axiscal::simulate {

/// What the bar sees of two axes with errors. One thread.
class TrueCircle {
public:
    TrueCircle(const BallbarScenario& bar, std::uint64_t seed);
    /// Length of the bar minus the nominal radius when the drives stand here, mm.
    double reading_mm(PlanePoint drive, std::uint64_t sample);

private:
    BallbarScenario bar_;
    SeededNoise noise_;
    Play first_, second_;
};

class SimulatedBar final : public SimulatedDevice {
public:
    SimulatedBar(const Scenario& scenario, Pty pty, SimClock clock, const CommandedPlane& plane);
    /// Free running: record k belongs to the instant k / rate, however late the thread wakes. What
    /// comes within a millisecond is written together.
    void run(std::stop_token stop) override;
    /// One record of a machine that somebody else drives, in place of run().
    void feed(PlanePoint drive);
    /// So many records are counted and never sent: their buffer was full.
    void leave_out(std::uint64_t records);
    [[nodiscard]] nlohmann::json place() const override { return {{"path", path_}}; }
    [[nodiscard]] nlohmann::json status() const override;

private:
    std::string record(PlanePoint drive);

    std::string path_;
    mutable std::mutex mutex_; ///< guards all below while it runs
    Pty pty_;
    SimClock clock_;
    const CommandedPlane& plane_;
    TrueCircle circle_;
    LaserScenario laser_;
    double cycles_per_mm_;
    UmdCounter counter_;
    std::uint64_t sample_ = 0; ///< written by its own thread alone
    std::uint64_t left_out_ = 0;
    double latest_s_ = 0; ///< frame, after its time
};

} // namespace axiscal::simulate
