#pragma once
// Runs a part program on the simulated machine in real time. start, stop and status are
// thread-safe.

#include "cnc/cnc_lines.hpp"
#include "cnc/commanded_axis.hpp"
#include "cnc/machine_actions.hpp"
#include "sim_clock.hpp"

#include <atomic>
#include <condition_variable>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

namespace axiscal::simulate {

/// A program that was understood; runs to its end. @errors refused where it aborts.
using ProgramRun = std::function<Result<void>(MachineActions&)>;
/// @errors bad_request with the number of the line that is not understood.
/// `plane`: of a machine with a ballbar.
Result<ProgramRun>
parse_program(const std::string& text, bool marlin, char letter, const std::string& plane = {});
Result<std::string> read_program(const std::string& path);
/// Told by the name of the file: .gcode and .marlin are Marlin's.
bool is_marlin(const std::string& path);

class CncRunner final : private MachineActions {
public:
    CncRunner(const Scenario& scenario,
              CommandedAxis& axis,
              CommandedPlane& plane,
              CncLines& lines,
              SimClock clock,
              CommandedAxis* table = nullptr);
    ~CncRunner() override;
    CncRunner(const CncRunner&) = delete;
    CncRunner& operator=(const CncRunner&) = delete;
    /// @errors busy; not_found; bad_request for a program that is not understood.
    Result<void> start(const std::string& path);
    void stop();
    [[nodiscard]] nlohmann::json status() const;
    void inject(const std::string& motion_fault);
    /// Feed hold: no move begins once the program has made this many requests, until go().
    void hold(int requests);
    void go();

private:
    void move(double target_mm, double feed_mm_per_min) override;
    void trace(const PlaneMove& way) override;
    void dwell(double seconds) override;
    void set_analog(int output, double value) override;
    void set_digital(int output, bool on) override;
    bool wait_input(int input, bool high, double timeout_s) override;
    [[nodiscard]] bool input(int input) override;
    void message(const std::string& text) override;
    void at_line(int line) override;
    [[nodiscard]] bool stopped() override;

    /// Sleeps to this instant; false when the operator stopped.
    bool sleep_until(double seconds);
    /// Waits for the last way's end; false when the operator stopped.
    bool come_to_rest();
    /// Waits while the feed is held; false when the operator stopped.
    bool may_move();
    [[nodiscard]] double physical_mm(double programmed_mm) const;
    void finish(const Result<void>& outcome);

    Scenario scenario_;
    CommandedAxis& axis_;
    CommandedPlane& plane_;
    CncLines& lines_;
    SimClock clock_;
    CommandedAxis* table_;     ///< the indexing table, which hears analog output 6
    double way_end_s_ = 0;     ///< of the last way in the plane; the program's own thread alone
    mutable std::mutex mutex_; ///< guards all below
    std::condition_variable wake_;
    std::string state_ = "idle", message_, motion_fault_;
    int line_ = 0;
    std::optional<int> hold_at_;
    bool stop_ = false;
    std::atomic<bool> left_travel_{false};
    std::thread thread_;
};

} // namespace axiscal::simulate
