// Source: LinuxCNC 2.9 G-code reference: G38.2 (stops with an error when nothing is touched, #5061
// to #5063 hold the touched point in the current coordinate system, #5070 is 1 where it touched),
// G10 L2, (LOGOPEN,), (LOG,). (PROBEOPEN) will not do: it leaves out a touch that was latched where
// the one before was.
#include "acquisition/program/probing_program.hpp"

#include "acquisition/program/part_program.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <sstream>

namespace axiscal {
namespace {

constexpr double settle_s = 0.2; // a probe and its spindle swing out
constexpr std::array<const char*, 3> axes{"X", "Y", "Z"};

std::string decimal(double value, int digits) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.*f", digits, value);
    return text.data();
}

double distance_mm(const ProbingPlan& plan, int touch) {
    return plan.first_mm + plan.step_mm * touch;
}

Result<void> check_plan(const ProbingPlan& plan) {
    const auto bad = [](const char* what) { return fail(Fault::bad_request, what); };
    if (!(plan.feed_mm_per_min >= 1 && plan.feed_mm_per_min <= 10'000))
        return bad("the probing feed must lie between 1 and 10000 mm/min");
    if (!(plan.first_mm >= 0.05 && plan.first_mm <= 50))
        return bad("the first approach distance must lie between 0.05 and 50 mm");
    if (!(plan.step_mm >= 0.0001 && plan.step_mm <= 5))
        return bad("the step of the approach distance must lie between 0.0001 and 5 mm");
    if (plan.touches < 2 || plan.touches > 200 || plan.references < 0 || plan.references > 200)
        return bad("2 to 200 touches and 0 to 200 references are possible");
    if (!(plan.clear_mm > 2 && plan.clear_mm <= 100 && plan.inset_mm > 0 && plan.inset_mm <= 100))
        return bad("clear must lie between 2 and 100 mm, inset between 0 and 100 mm");
    if (distance_mm(plan, plan.touches - 1) > plan.clear_mm)
        return bad("the longest approach distance is more than clear: begin nearer, or clear more");
    if (!(plan.travel_feed_mm_per_min >= 1 && plan.travel_feed_mm_per_min <= 100'000))
        return bad("the travel feed must lie between 1 and 100000 mm/min");
    return {};
}

class ProbingWriter {
public:
    ProbingWriter(const ProbingPlan& plan, const std::string& log)
        : plan_{plan}
        , log_{log} {}

    std::string write() {
        head();
        for (std::size_t axis = 0; axis < 3; ++axis)
            zero(axis);
        line("(LOGOPEN," + log_ + ")");
        for (std::size_t axis = 0; axis < 3; ++axis)
            measure(axis);
        line("(LOGCLOSE)");
        above();
        line("M2");
        return std::move(text_);
    }

private:
    void line(const std::string& words) { text_ += words + "\n"; }
    void go(std::size_t axis, double to_mm) {
        line("G1 " + coordinate_word(axes[axis], to_mm) + " F" +
             decimal(plan_.travel_feed_mm_per_min, 1));
    }
    void head() {
        line("(axiscal probing " + probing_id(plan_) + ")");
        line("(rough zero of G54 first: X0 Y0 Z0 at the corner where the three faces meet, tip of "
             "the probe)");
        touched();
        line("G21 G90 G94 G17 G61 G40 G49 G80 G54");
        above();
    }
    /// LinuxCNC up to 2.9 may read on while the probe still moves (its issue 3650): what stands in
    /// #5061 to #5063 is then of an earlier touch, and a zero set by it drives into the block.
    /// #5070 is cleared before each G38.2 and 1 once the probe has spoken.
    void touched() {
        line("o<touched> sub");
        line("o<early> if [#5070 EQ 0]");
        line("(MSG,LinuxCNC read on before the probe had spoken, its issue 3650. Start again)");
        line("M2");
        line("o<early> endif");
        line("o<touched> endsub");
    }
    void above() { go(2, plan_.clear_mm); }
    /// Opposite the point of its face, `distance_mm` from it; round the block's upper side.
    void face(std::size_t axis) {
        above();
        for (const std::size_t other : {std::size_t{0}, std::size_t{1}})
            go(other, other == axis ? plan_.clear_mm : -plan_.inset_mm);
        if (axis != 2) go(2, -plan_.inset_mm);
    }
    void touch(std::size_t axis, double from_mm) {
        go(axis, from_mm);
        line("G4 P" + decimal(settle_s, 1));
        line("G38.2 " + coordinate_word(axes[axis], -plan_.clear_mm / 2) + " F" +
             decimal(plan_.feed_mm_per_min, 4));
        line("o<touched> call");
    }
    void logged_touch(std::size_t axis, const char* kind, double from_mm) {
        touch(axis, from_mm);
        line(std::string{"(LOG,-"} + axes[axis] + " " + kind + " " + decimal(from_mm, 4) +
             " #5061 #5062 #5063)");
    }
    /// The touched point becomes the zero: the offset of G54 stands in #5221 to #5223.
    void zero(std::size_t axis) {
        face(axis);
        touch(axis, plan_.clear_mm);
        const std::string number = std::to_string(axis + 1);
        line(std::string{"G10 L2 P1 "} + axes[axis] + "[#522" + number + " + #506" + number + "]");
        go(axis, plan_.clear_mm);
    }
    void measure(std::size_t axis) {
        face(axis);
        for (int i = 0; i < plan_.references; ++i)
            logged_touch(axis, "reference", plan_.first_mm);
        for (int i = 0; i < plan_.touches; ++i)
            logged_touch(axis, "touch", distance_mm(plan_, i));
        go(axis, plan_.clear_mm);
    }

    const ProbingPlan& plan_;
    const std::string& log_;
    std::string text_;
};

/// The number behind `key=` in the program's first lines.
template <class Number>
bool read_number(const std::string& text, const std::string& key, Number& value) {
    const auto at = text.find(" " + key + "=");
    if (at == std::string::npos) return false;
    const char* begin = text.data() + at + key.size() + 2;
    return std::from_chars(begin, text.data() + text.size(), value).ec == std::errc{};
}

/// What the program touches as its `number`-th, from 0, but for what was latched.
ProbingTouch planned_touch(const ProbingPlan& plan, int number) {
    const int of_direction = plan.references + plan.touches;
    const int place = number % of_direction;
    ProbingTouch touch;
    touch.direction[static_cast<std::size_t>(number / of_direction)] = -1;
    touch.reference = place < plan.references;
    touch.approach =
        mm(touch.reference ? plan.first_mm : distance_mm(plan, place - plan.references));
    return touch;
}

bool is_planned(const ProbingTouch& touch, const ProbingTouch& planned) {
    constexpr double rounding_mm = 6e-5; // the program writes four decimals
    return touch.direction == planned.direction && touch.reference == planned.reference &&
           std::fabs((touch.approach - planned.approach).in(mm)) < rounding_mm;
}

/// "-X touch 2.0016 0.027000 -10.000000 -10.000000"
Result<ProbingTouch> read_touch(const std::string& line, std::size_t number) {
    std::istringstream words{line};
    std::string direction, kind;
    double approach_mm = 0;
    std::array<double, 3> latched_mm{};
    words >> direction >> kind >> approach_mm >> latched_mm[0] >> latched_mm[1] >> latched_mm[2];
    const bool known = direction == "-X" || direction == "-Y" || direction == "-Z";
    bool whole = words && known && (kind == "touch" || kind == "reference");
    for (const double value : latched_mm)
        whole = whole && std::isfinite(value);
    if (!whole || !std::isfinite(approach_mm))
        return fail(Fault::bad_request, "line " + std::to_string(number) + " of the log, '" + line +
                                            "', is no touch: it says '-X touch 2.0016' and the "
                                            "latched X, Y, Z");
    ProbingTouch touch;
    touch.direction[static_cast<std::size_t>(direction[1] - 'X')] = -1;
    touch.reference = kind == "reference";
    touch.approach = mm(approach_mm);
    touch.latched = {mm(latched_mm[0]), mm(latched_mm[1]), mm(latched_mm[2])};
    return touch;
}

} // namespace

std::string probing_id(const ProbingPlan& plan) {
    char text[160];
    std::snprintf(text, sizeof text, "feed=%.10g first=%.10g step=%.10g touches=%d references=%d",
                  plan.feed_mm_per_min, plan.first_mm, plan.step_mm, plan.touches, plan.references);
    return text;
}

Result<ProbingPlan> read_probing_id(const std::string& program) {
    const auto begin = program.find("(axiscal probing ");
    const auto end = program.find(')', begin == std::string::npos ? 0 : begin);
    const std::string head =
        begin == std::string::npos ? std::string{} : program.substr(begin, end - begin);
    ProbingPlan plan;
    const bool whole = read_number(head, "feed", plan.feed_mm_per_min) &&
                       read_number(head, "first", plan.first_mm) &&
                       read_number(head, "step", plan.step_mm) &&
                       read_number(head, "touches", plan.touches) &&
                       read_number(head, "references", plan.references);
    if (!whole)
        return fail(Fault::bad_request, "this is no program of 'axiscal probing program': its "
                                        "first line names no probing test");
    AXISCAL_CHECK(check_plan(plan));
    return plan;
}

Result<std::string> write_probing_linuxcnc(const ProbingPlan& plan, const std::string& log) {
    AXISCAL_CHECK(check_plan(plan));
    if (log.empty() || log.find_first_of("()\r\n ") != std::string::npos)
        return fail(Fault::bad_request, "the log's name '" + log +
                                            "' has a blank or a bracket: LinuxCNC cannot take it");
    return ProbingWriter{plan, log}.write();
}

Result<ProbingRecord> read_probing_log(const ProbingPlan& plan, const std::string& log) {
    ProbingRecord record;
    record.feed_mm_per_min = plan.feed_mm_per_min;
    std::istringstream lines{log};
    std::size_t number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
        AXISCAL_TRY(ProbingTouch touch, read_touch(line, number));
        record.touches.push_back(touch);
    }
    const int due = 3 * (plan.references + plan.touches);
    if (static_cast<int>(record.touches.size()) != due)
        return fail(Fault::bad_request,
                    "the log holds " + std::to_string(record.touches.size()) +
                        " touches; the program makes " + std::to_string(due) +
                        ": was it stopped, or is it the log of another program?");
    for (int i = 0; i < due; ++i)
        if (!is_planned(record.touches[static_cast<std::size_t>(i)], planned_touch(plan, i)))
            return fail(Fault::bad_request,
                        "touch " + std::to_string(i + 1) +
                            " of the log is not the one that the program makes: is it the log of "
                            "another program?");
    return record;
}

} // namespace axiscal
