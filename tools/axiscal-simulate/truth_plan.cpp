// The measured points of a part program, found by running it on paper.
#include "truth.hpp"

#include "cnc/cnc_runner.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace axiscal::simulate {

namespace {

/// A machine of paper: every input comes at once, every point is noted.
class PaperMachine final : public MachineActions {
public:
    struct Visits {
        int up = 0, down = 0;
    };
    /// Keyed by the position in nanometres.
    using Points = std::map<long, Visits>;

    void move(double target_mm, double) override {
        if (target_mm != position_mm_) up_ = target_mm > position_mm_;
        position_mm_ = target_mm;
    }
    void dwell(double) override { note(dwelled_); }
    void set_analog(int output, double value) override {
        if (output == command_output) command_ = value;
        const bool ties_datum = command_ == command_prepare; // no point is taken
        if (output == 0 && value != 0 && value != sequence_ && !ties_datum) note(sequenced_);
        if (output == 0) sequence_ = value;
    }
    void set_digital(int output, bool on) override {
        if (output == 0 && on) note(pulsed_);
    }
    bool wait_input(int, bool high, double) override { return input_ = high, true; }
    [[nodiscard]] bool input(int) override { return input_; }
    void message(const std::string&) override {}
    void at_line(int) override { ++lines_; }
    [[nodiscard]] bool stopped() override { return lines_ > line_limit; }

    /// A coil is the trigger where there is one; then the index register; else the dwells.
    [[nodiscard]] Points points() const {
        if (!pulsed_.empty()) return pulsed_;
        if (!sequenced_.empty()) return sequenced_;
        int most = 0;
        for (const auto& [position, v] : dwelled_)
            most = std::max(most, v.up + v.down);
        Points measured;
        for (const auto& [position, v] : dwelled_)
            if (v.up + v.down == most) measured.emplace(position, v);
        return measured;
    }

private:
    /// No calibration program is that long; an endless loop on paper ends here.
    static constexpr int line_limit = 1000000;
    void note(Points& points) const {
        Visits& visits = points[std::lround(position_mm_ * 1e6)];
        ++(up_ ? visits.up : visits.down);
    }
    Points pulsed_, sequenced_, dwelled_;
    double position_mm_ = 0, sequence_ = -1, command_ = 0;
    bool up_ = true, input_ = false;
    int lines_ = 0;
};

} // namespace

Result<TruthPlan> plan_of_program(const std::string& text, bool marlin, const Scenario& scenario) {
    PaperMachine machine;
    AXISCAL_TRY(const auto run, parse_program(text, marlin, scenario.axis.letter));
    const auto ran = run(machine);
    if (!ran) return tl::unexpected<Error>(ran.error());
    TruthPlan plan;
    bool down = false;
    for (const auto& [position, visits] : machine.points()) {
        plan.targets_mm.push_back(static_cast<double>(position) * 1e-6);
        plan.approaches = std::max(visits.up, visits.down);
        down = down || (visits.down > 0 && visits.up > 0);
    }
    plan.bidirectional = down;
    if (plan.targets_mm.empty())
        return fail(Fault::incomplete_run, "the part program asks for no capture");
    return plan;
}

} // namespace axiscal::simulate
