#include "cnc/cnc_runner.hpp"

#include "cnc/linuxcnc_program.hpp"
#include "cnc/marlin_program.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace axiscal::simulate {

namespace {
/// The servo period of a CNC: how often a waiting program looks at its inputs.
constexpr double look_s = 0.001;
constexpr int table_output = 6;
} // namespace

Result<std::string> read_program(const std::string& path) {
    std::ifstream file{path};
    std::ostringstream text;
    if (!file || !(text << file.rdbuf()))
        return fail(Fault::not_found, "the part program " + path + " can not be read");
    return text.str();
}

bool is_marlin(const std::string& path) {
    return path.ends_with(".gcode") || path.ends_with(".marlin");
}

Result<ProgramRun>
parse_program(const std::string& text, bool marlin, char letter, const std::string& plane) {
    if (marlin) {
        AXISCAL_TRY(auto program, MarlinProgram::parse(text, letter));
        return [program = std::move(program)](MachineActions& machine) {
            return program.run(machine);
        };
    }
    AXISCAL_TRY(auto program, LinuxcncProgram::parse(text, letter, plane));
    return [program = std::move(program)](MachineActions& machine) { return program.run(machine); };
}

CncRunner::CncRunner(const Scenario& scenario,
                     CommandedAxis& axis,
                     CommandedPlane& plane,
                     CncLines& lines,
                     SimClock clock,
                     CommandedAxis* table)
    : scenario_{scenario}
    , axis_{axis}
    , plane_{plane}
    , lines_{lines}
    , clock_{clock}
    , table_{table}
    , motion_fault_{scenario.cnc ? scenario.cnc->motion_fault : ""} {}

CncRunner::~CncRunner() {
    stop();
    if (thread_.joinable()) thread_.join();
}

Result<void> CncRunner::start(const std::string& path) {
    AXISCAL_TRY(const std::string text, read_program(path));
    AXISCAL_TRY(auto program, parse_program(text, is_marlin(path), scenario_.axis.letter,
                                            scenario_.ballbar ? scenario_.ballbar->plane : ""));
    const std::lock_guard lock{mutex_};
    if (state_ == "running") return fail(Fault::busy, "a part program is running");
    if (thread_.joinable()) thread_.join();
    state_ = "running";
    message_.clear();
    stop_ = false;
    left_travel_ = false;
    line_ = 0;
    thread_ = std::thread{[this, run = std::move(program)] { finish(run(*this)); }};
    return {};
}

void CncRunner::finish(const Result<void>& outcome) {
    come_to_rest();
    const std::lock_guard lock{mutex_};
    state_ = !outcome || left_travel_ ? "failed" : stop_ ? "stopped" : "done";
    if (!outcome) message_ = outcome.error().detail;
}

void CncRunner::stop() {
    const std::lock_guard lock{mutex_};
    stop_ = true;
    wake_.notify_all();
}

bool CncRunner::stopped() {
    const std::lock_guard lock{mutex_};
    return stop_;
}

void CncRunner::at_line(int line) {
    const std::lock_guard lock{mutex_};
    line_ = line;
}

void CncRunner::message(const std::string& text) {
    const std::lock_guard lock{mutex_};
    message_ = text;
}

void CncRunner::inject(const std::string& motion_fault) {
    const std::lock_guard lock{mutex_};
    motion_fault_ = motion_fault;
}

void CncRunner::hold(int requests) {
    const std::lock_guard lock{mutex_};
    hold_at_ = requests;
    wake_.notify_all(); // a later hold lets go of an earlier one
}

void CncRunner::go() {
    const std::lock_guard lock{mutex_};
    hold_at_.reset();
    wake_.notify_all();
}

bool CncRunner::may_move() {
    std::unique_lock lock{mutex_};
    const auto held = [this] { return hold_at_ && lines_.requests() >= *hold_at_; };
    wake_.wait(lock, [&] { return stop_ || !held(); });
    return !stop_;
}

bool CncRunner::sleep_until(double seconds) {
    std::unique_lock lock{mutex_};
    return !wake_.wait_until(lock, clock_.at(seconds), [this] { return stop_; });
}

/// Where the measured axis goes when the program says so; a set-up fault moves it elsewhere.
double CncRunner::physical_mm(double programmed_mm) const {
    const std::lock_guard lock{mutex_};
    if (motion_fault_ == "diameter") return programmed_mm / 2;
    if (motion_fault_ == "inch") return programmed_mm / 25.4;
    if (motion_fault_ == "swapped-sign") return -programmed_mm;
    if (motion_fault_ == "wrong-axis") return scenario_.axis.start_mm;
    if (motion_fault_ == "shifted-datum" && lines_.requests() > 0)
        return programmed_mm + (scenario_.cnc ? scenario_.cnc->shift_mm : 0);
    return programmed_mm;
}

void CncRunner::move(double target_mm, double feed_mm_per_min) {
    const AxisScenario& axis = scenario_.axis;
    if (target_mm < axis.travel_low_mm || target_mm > axis.travel_high_mm) {
        message("the move to " + std::to_string(target_mm) + " mm leaves the travel");
        left_travel_ = true;
        return stop();
    }
    if (!come_to_rest() || !may_move()) return;
    const double fastest = axis.rapid_mm_per_min;
    const double feed = feed_mm_per_min > 0 ? std::min(feed_mm_per_min, fastest) : fastest;
    const double end_s = axis_.move(clock_.now_s(), physical_mm(target_mm), feed / 60.0);
    if (!sleep_until(end_s)) axis_.halt(clock_.now_s());
}

/// A CNC looks ahead: the next way is told before this one ends, and begins where and when it does.
/// Told afterwards, the machine would halt between the two for as long as a busy computer likes.
void CncRunner::trace(const PlaneMove& way) {
    constexpr double ahead_s = 0.5;
    if (!may_move()) return;
    way_end_s_ = plane_.move(std::max(clock_.now_s(), way_end_s_), way);
    sleep_until(way_end_s_ - ahead_s);
}

bool CncRunner::come_to_rest() {
    return sleep_until(way_end_s_);
}

void CncRunner::dwell(double seconds) {
    come_to_rest();
    sleep_until(clock_.now_s() + seconds);
}

bool CncRunner::input(int input) {
    come_to_rest();
    return lines_.input(input);
}

void CncRunner::set_analog(int output, double value) {
    come_to_rest();
    if (output == table_output && table_ != nullptr && scenario_.indexing_table) {
        const TableScenario& table = *scenario_.indexing_table;
        table_->move(clock_.now_s(), value * table.step_deg, table.turn_deg_per_s);
        return;
    }
    lines_.set_analog(output, value, clock_.now_s());
}

void CncRunner::set_digital(int output, bool on) {
    come_to_rest();
    lines_.set_digital(output, on, clock_.now_s());
}

bool CncRunner::wait_input(int input, bool high, double timeout_s) {
    come_to_rest();
    const double end_s = clock_.now_s() + timeout_s;
    while (lines_.input(input) != high) {
        const double now_s = clock_.now_s();
        if (now_s >= end_s || !sleep_until(now_s + look_s)) return false;
    }
    return true;
}

nlohmann::json CncRunner::status() const {
    const CncAnswer answer = lines_.answer();
    const double drive_mm = axis_.position_mm(clock_.now_s());
    const ShownPath axis = axis_.shown(), plane = plane_.shown();
    const std::lock_guard lock{mutex_};
    nlohmann::json status{{"program", state_},
                          {"line", line_},
                          {"message", message_},
                          {"requests", lines_.requests()},
                          {"drive_mm", drive_mm},
                          {"result", answer.result},
                          {"fault_sequence", answer.fault_sequence},
                          {"late_moves", axis.late() + plane.late()},
                          {"latest_move_s", std::max(axis.latest_s(), plane.latest_s())}};
    status["done"] = answer.done ? nlohmann::json(*answer.done) : nlohmann::json();
    return status;
}

} // namespace axiscal::simulate
