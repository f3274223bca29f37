#include "wire/simulated_laser.hpp"

#include <cmath>
#include <thread>

namespace axiscal::simulate {

namespace {
/// A flooding counter sends each record this often: about 300 kB/s.
constexpr int flood_factor = 10;
} // namespace

SimulatedLaser::SimulatedLaser(const Scenario& scenario,
                               Pty pty,
                               SimClock clock,
                               std::function<double(double)> drive,
                               std::function<double(double)> table)
    : SimulatedDevice{"laser"}
    , scenario_{scenario}
    , pty_{std::move(pty)}
    , clock_{clock}
    , drive_{std::move(drive)}
    , table_{std::move(table)}
    , machine_{scenario}
    , counter_{scenario.laser} {
    if (scenario.straightness) across_.emplace(scenario);
    if (scenario.laser.kind == "umd0") pty_.write("\r\nMinimalist Homodyne Test:\r\n");
    if (scenario.laser.partial_first_line) pty_.write("45 3 0 4097 0 0\r\n");
}

void SimulatedLaser::write(const std::string& record) {
    switch (behaviour()) {
    case Behaviour::on: return pty_.write(record);
    case Behaviour::off: return;
    case Behaviour::garbage: return pty_.write(garbage_bytes(scenario_.seed, sample_));
    case Behaviour::flood:
        for (int i = 0; i < flood_factor; ++i)
            pty_.write(record);
    }
}

void SimulatedLaser::step(double drive_mm) {
    const std::lock_guard lock{mutex_};
    const double seconds = static_cast<double>(sample_) / counter_.rate_hz();
    slide_mm_ = machine_.slide_mm(drive_mm, seconds, sample_);
    const UmdRecord record = counter_.next(cycles_now(drive_mm, seconds));
    ++sample_;
    write(encode(record));
}

double SimulatedLaser::cycles_now(double drive_mm, double seconds) {
    if (across_) return across_->cycles(drive_mm, seconds, sample_);
    if (scenario_.indexing_table) return cycles_over_table(seconds);
    return machine_.cycles(slide_mm_, seconds);
}

/// The optics are square at the begin of the run, where the table stands at its position 0.
double SimulatedLaser::cycles_over_table(double seconds) {
    const TableScenario& table = *scenario_.indexing_table;
    const double table_deg = table_ ? table_(seconds) : 0;
    const double rest = rest_deg(table, slide_mm_ - scenario_.axis.start_mm, table_deg);
    counter_.set_beam(beam_ && std::abs(rest) <= table.range_deg);
    return machine_.cycles_of_rest(rest, seconds);
}

void SimulatedLaser::run(std::stop_token stop) {
    while (!stop.stop_requested()) {
        const double due_s = static_cast<double>(sample_) / counter_.rate_hz();
        std::this_thread::sleep_until(clock_.at(due_s));
        step(drive_(due_s));
    }
}

void SimulatedLaser::feed(double drive_mm) {
    step(drive_mm);
}

double SimulatedLaser::next_s() const {
    const std::lock_guard lock{mutex_};
    return static_cast<double>(sample_) / counter_.rate_hz();
}

nlohmann::json SimulatedLaser::place() const {
    return {{"path", scenario_.laser.path}};
}

nlohmann::json SimulatedLaser::status() const {
    const std::lock_guard lock{mutex_};
    return {{"path", scenario_.laser.path},
            {"samples", sample_},
            {"dropped", pty_.dropped()},
            {"records_dropped", pty_.lines_dropped()},
            {"slide_mm", slide_mm_}};
}

double SimulatedLaser::slide_mm() const {
    const std::lock_guard lock{mutex_};
    return slide_mm_;
}

void SimulatedLaser::set_beam(bool on) {
    const std::lock_guard lock{mutex_};
    beam_ = on;
    counter_.set_beam(on);
}

void SimulatedLaser::restart_counter() {
    const std::lock_guard lock{mutex_};
    counter_.restart();
    machine_.zero_counter();
    if (across_) across_->zero_counter();
}

void SimulatedLaser::skip_records(int count) {
    const std::lock_guard lock{mutex_};
    counter_.skip(count);
}

void SimulatedLaser::set_fields(int fields) {
    const std::lock_guard lock{mutex_};
    counter_.set_fields(fields);
}

void SimulatedLaser::steer(double angle_rad) {
    const std::lock_guard lock{mutex_};
    machine_.steer(angle_rad);
}

void SimulatedLaser::move_optic(double by_mm) {
    const std::lock_guard lock{mutex_};
    machine_.move_optic(by_mm);
}

void SimulatedLaser::set_error_mask(int mask) {
    const std::lock_guard lock{mutex_};
    counter_.set_error_mask(mask);
}

} // namespace axiscal::simulate
