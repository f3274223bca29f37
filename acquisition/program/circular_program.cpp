// Circles in LinuxCNC's dialect. Source: LinuxCNC 2.9 G-code reference (G2 G3 with centre words,
// incremental by G91.1, P turns; G17 G18 G19; M62..M68, M66; M67
// takes effect with the next motion). In every plane G3 turns the first
// axis to the second (X to Y, Z to X, Y to Z). Wiring as for the linear cycle (docs/trigger.md).
#include "acquisition/program/circular_program.hpp"

#include "acquisition/program/linuxcnc_handshake.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace axiscal {
namespace {

constexpr double one_degree = std::numbers::pi / 180;
constexpr double rest_s = 0.5; ///< before feed-in and after feed-out: the step is seen whole
constexpr double halt_s = 2;   ///< without a handshake
constexpr double least_arc_deg = 1e-9;

class CircleWriter {
public:
    explicit CircleWriter(const CircularOrder& order)
        : order_{order}
        , plan_{order.plan} {}

    std::string write() {
        head();
        for (const PlannedCircle& circle : planned_circles(plan_))
            drive(circle);
        request(static_cast<int>(planned_circles(plan_).size()) * requests() + 1);
        line("(end of cycle)");
        line("M2");
        return std::move(text_);
    }

private:
    void line(const std::string& words) { text_ += words + "\n"; }
    static std::string format(const char* pattern, double value) {
        std::array<char, 64> text{};
        std::snprintf(text.data(), text.size(), pattern, value == 0 ? 0.0 : value);
        return text.data();
    }
    void dwell(double seconds) { line(format("G4 P%.3f", seconds)); }
    [[nodiscard]] bool coil() const { return order_.shape == TriggerShape::coil_and_index; }
    [[nodiscard]] bool handshake() const { return order_.shape != TriggerShape::dwell; }

    [[nodiscard]] double rest_radius_mm() const {
        return plan_.nominal_radius_mm + (plan_.feed_in_outside ? 1 : -1) * plan_.feed_in_mm;
    }
    /// Index of the plane's first and second axis among X, Y, Z.
    [[nodiscard]] std::size_t axis(std::size_t which) const {
        return static_cast<std::size_t>(axes_of(plan_.plane)[which][0] - 'X');
    }
    [[nodiscard]] std::string word(std::size_t which, double value) const {
        return axes_of(plan_.plane)[which] + format("%.6f", value);
    }
    [[nodiscard]] std::string centre_word(std::size_t which, double value) const {
        return std::string{"IJK"[axis(which)]} + format("%.6f", value);
    }
    [[nodiscard]] std::string place(double radius_mm, double deg) const {
        const double angle = deg * one_degree;
        return word(0, plan_.centre_mm[axis(0)] + radius_mm * std::cos(angle)) + " " +
               word(1, plan_.centre_mm[axis(1)] + radius_mm * std::sin(angle));
    }

    [[nodiscard]] int requests() const { return requests_a_circle(plan_); }
    /// The number changes with the first servo cycle of the next way; nobody waits for an answer.
    void word_with_next_way(int sequence) {
        if (plan_.start == StartMethod::trigger) line("M67 E0 Q" + std::to_string(sequence));
    }

    void head() {
        line("(axiscal circular " + std::string{name_of(plan_.plane)} +
             format(" R%.4f", plan_.nominal_radius_mm) + format(" F%.1f", feed()) +
             " circles=" + std::to_string(planned_circles(plan_).size()) + ")");
        line("(first the machine goes to rest beside the circle and waits: run 'axiscal arm --pass "
             "circular' then)");
        const std::array planes{"G17", "G19", "G18"};
        line("G21 G90 G91.1 G94 G61 G40 G49 G80 " +
             std::string{planes[static_cast<std::size_t>(plan_.plane)]});
        line(format("F%.1f", feed()));
        if (coil()) line("M65 P0");
        here_deg_ = entry_deg(plan_, plan_.senses.front());
        line("G1 " + place(rest_radius_mm(), here_deg_));
        if (!handshake()) return;
        line("M68 E0 Q0");
        dwell(comparison_s);
        line("M66 " + std::string{coil() ? "P1 L3" : "P0 L3"} + format(" Q%.1f", arming_limit_s));
        abort_unless_answered("the station was not armed");
    }
    [[nodiscard]] double feed() const { return plan_.feed_mm_per_s * 60; }

    void drive(const PlannedCircle& circle) {
        const double from = entry_deg(plan_, circle.sense), to = exit_deg(plan_, circle.sense);
        line("(circle " + std::to_string(circle.number) + ": " +
             std::string{name_of(circle.sense)} + ", " + (circle.warm_up ? "warm-up " : "repeat ") +
             std::to_string(circle.repeat) + ")");
        if (std::fabs(std::remainder(from - here_deg_, 360)) > least_arc_deg)
            turn(rest_radius_mm(), from);
        here_deg_ = from;
        const int sequence = (circle.number - 1) * requests() + 1;
        request(sequence);
        dwell(handshake() ? rest_s : halt_s);
        line("G1 " + place(plan_.nominal_radius_mm, from));
        word_with_next_way(sequence + 1);
        turn(plan_.nominal_radius_mm, to);
        word_with_next_way(sequence + 2);
        line("G1 " + place(rest_radius_mm(), to));
        dwell(handshake() ? rest_s : halt_s);
    }

    /// One arc of as many turns as it takes (P), so that nothing brakes within.
    void turn(double radius_mm, double to_deg) {
        const double turned = to_deg - here_deg_, angle = here_deg_ * one_degree;
        here_deg_ = to_deg;
        if (std::fabs(turned) < least_arc_deg) return;
        const int turns = static_cast<int>(std::ceil(std::fabs(turned) / 360 - least_arc_deg));
        line((turned > 0 ? "G3 " : "G2 ") + place(radius_mm, to_deg) + " " +
             centre_word(0, -radius_mm * std::cos(angle)) + " " +
             centre_word(1, -radius_mm * std::sin(angle)) +
             (turns > 1 ? " P" + std::to_string(turns) : ""));
    }

    void request(int sequence) {
        if (!handshake()) return;
        line("M68 E0 Q" + std::to_string(sequence));
        dwell(comparison_s);
        if (coil()) line("M64 P0");
        const double limit_s = seconds_of(order_.answer_limit);
        line(format("M66 P0 L3 Q%.1f", limit_s));
        abort_unless_answered("no answer for request " + std::to_string(sequence));
        if (!coil()) return;
        line("M65 P0");
        line(format("M66 P0 L4 Q%.1f", limit_s));
        abort_unless_answered("the acknowledge stays high");
    }
    void abort_unless_answered(const std::string& complaint) {
        const std::string label = "o" + std::to_string(++labels_);
        line(label + " if [#5399 EQ -1]");
        line("  (ABORT,axiscal: " + complaint + ")");
        line(label + " endif");
    }

    const CircularOrder& order_;
    const CircularPlan& plan_;
    std::string text_;
    double here_deg_ = 0;
    int labels_ = 0;
};

} // namespace

std::string write_circular_linuxcnc(const CircularOrder& order) {
    return CircleWriter{order}.write();
}

} // namespace axiscal
