// LinuxCNC dialect. Source: LinuxCNC 2.9 G-code reference (M62..M68, M66, o-words, (ABORT,...)).
// Wiring in HAL (docs/trigger.md): analog-out-00 = sequence; digital-in-00 = answered (the echo
// equals the sequence, or the acknowledge bit); coil-and-index also digital-out-00 = trigger coil
// and digital-in-01 = "register equals sequence". sequence-block reads analog-out-01..05 as well;
// an indexing table is told its position by analog-out-06; analog-out-07 is CMD, where the program
// begins with prepare.
#include "acquisition/program/part_program.hpp"

#include "acquisition/program/linuxcnc_handshake.hpp"

#include <cstdio>
#include <utility>

namespace axiscal {
namespace {

class CycleWriter {
public:
    explicit CycleWriter(const ProgramOrder& order)
        : order_{order} {}

    std::string write() {
        head();
        std::uint16_t sequence = order_.last_request;
        bool begun = false;
        for (const ProgramMove& move : moves()) {
            if (move.point) announce(++sequence == 0 ? ++sequence : sequence, move);
            line("G1 " + coordinate_word(order_.axis, move.coordinate_mm));
            if (move.table_position) turn_table(*move.table_position);
            if (move.point)
                capture(sequence, move);
            else if (!std::exchange(begun, true)) {
                begin();
                if (order_.datum_by_cnc && !order_.retakes) prepare(++sequence, move);
            }
        }
        line("(end of cycle)");
        line("M2");
        return std::move(text_);
    }

private:
    void line(const std::string& words) { text_ += words + "\n"; }
    void dwell(double seconds) { line(format("G4 P%.3f", seconds)); }
    static std::string format(const char* pattern, double value) {
        char text[64];
        std::snprintf(text, sizeof text, pattern, value);
        return text;
    }
    [[nodiscard]] bool handshake() const { return order_.shape != TriggerShape::dwell; }
    [[nodiscard]] bool coil() const { return order_.shape == TriggerShape::coil_and_index; }

    [[nodiscard]] bool with_table() const {
        return order_.rotary && order_.rotary->method == AngleMethod::indexing_table;
    }
    [[nodiscard]] std::vector<ProgramMove> moves() const {
        return with_table() ? moves_with_table(order_.plan, *order_.rotary) : moves_of(order_.plan);
    }
    /// A driven table hears analog-out-06; a person reads the message and starts the program again.
    void turn_table(int position) {
        line("(MSG,axiscal: indexing table to position " + std::to_string(position) + ")");
        line("M68 E6 Q" + std::to_string(position));
        if (order_.rotary->by_hand)
            line("M0");
        else
            dwell(seconds_of(order_.rotary->turn_time));
    }

    void head() {
        line("(axiscal " + program_id(order_.plan) + ")");
        if (order_.retakes)
            line("(points taken again: the station is armed; requests count on from " +
                 std::to_string(order_.last_request) + ")");
        else if (order_.datum_by_cnc)
            line("(first the axis goes to its datum and waits for 'axiscal arm --datum-by-cnc', "
                 "then request 1 ties the reading there)");
        else if (!handshake())
            line("(" + std::string{waits_for_nobody} + ")");
        else
            line("(first the axis goes to its datum and waits there: run 'axiscal arm' then)");
        line("G21 G90 G94 G17 G61 G40 G49 G80");
        line(format("F%.1f", order_.feed.in(mm_per_minute)));
        if (coil()) line("M65 P0");
    }
    /// Writes 0 and waits until the station shows done = 0: it is armed then. Of points taken
    /// again: the last durable request, which the station answers by publishing its done once more.
    void begin() {
        if (!handshake()) return dwell(seconds_of(order_.dwell));
        line("M68 E0 Q" + std::to_string(order_.last_request));
        dwell(comparison_s);
        wait(coil() ? "P1 L3" : "P0 L3", arming_limit_s,
             order_.retakes ? "the station's last request is another one"
                            : "the station was not armed");
    }
    /// Ties the reading to the datum. Where the station withholds, because the axis was not at
    /// rest or a reading was missing, asks once more.
    void prepare(std::uint16_t sequence, const ProgramMove& datum) {
        const std::string complaint =
            "the datum was not tied by request " + std::to_string(sequence);
        line("(datum)");
        for (const char* unsaid : {"M68 E1 Q0", "M68 E2 Q0", "M68 E4 Q0"})
            line(unsaid);
        line(format("M68 E3 Q%.4f", datum.coordinate_mm));
        line("M68 E7 Q1");
        dwell(seconds_of(order_.dwell));
        ask(sequence);
        const std::string again = next_label();
        line(again + " if [#5399 EQ -1]");
        line("(MSG,axiscal: " + complaint + ", it is asked for again)");
        line("M68 E0 Q0");
        dwell(seconds_of(order_.dwell));
        ask(sequence);
        abort_unless_answered(complaint);
        line(again + " endif");
        line("M68 E7 Q2");
    }
    /// Words that the station may check against its plan; all before the sequence number.
    void announce(std::uint16_t sequence, const ProgramMove& move) {
        line("(P" + std::to_string(move.point->target_index + 1) +
             (move.point->direction == Direction::positive ? " up " : " down ") +
             std::to_string(move.point->approach + 1) + ")");
        if (order_.shape == TriggerShape::coil_and_index)
            line("M68 E0 Q" + std::to_string(sequence));
        if (order_.shape != TriggerShape::sequence_block) return;
        line("M68 E1 Q" + std::to_string(move.point->target_index));
        line(std::string{"M68 E2 Q"} + (move.point->direction == Direction::positive ? "1" : "2"));
        line(format("M68 E3 Q%.4f", move.coordinate_mm));
        line("M68 E4 Q" + std::to_string(move.point->approach));
        line(format("M68 E5 Q%.1f", order_.feed.in(mm_per_minute)));
    }
    /// Asks; where the station withholds, comes to the target once more and asks again. One
    /// disturbed halt (a beam crossed, a PC that stood still) must not cost the whole program.
    void capture(std::uint16_t sequence, const ProgramMove& move) {
        dwell(seconds_of(order_.dwell));
        if (!handshake()) return;
        const std::string complaint = "no answer for request " + std::to_string(sequence);
        ask(sequence);
        const std::string again = next_label();
        line(again + " if [#5399 EQ -1]");
        line("(MSG,axiscal: " + complaint + ", the target is approached again)");
        come_again(move);
        ask(sequence);
        abort_unless_answered(complaint);
        line(again + " endif");
        if (!coil()) return;
        line("M65 P0");
        wait("P0 L4", seconds_of(order_.answer_limit), "the acknowledge stays high");
    }
    void ask(std::uint16_t sequence) {
        if (coil())
            line("M64 P0");
        else {
            line("M68 E0 Q" + std::to_string(sequence));
            dwell(comparison_s);
        }
        line(format("M66 P0 L3 Q%.1f", seconds_of(order_.answer_limit)));
    }
    /// Takes the request back, as a repeated one needs it, and approaches from the planned side.
    void come_again(const ProgramMove& move) {
        line(coil() ? "M65 P0" : "M68 E0 Q0");
        const double side = move.point->direction == Direction::positive ? 1 : -1;
        const double behind_mm = move.coordinate_mm - side * order_.plan.overrun.in(mm);
        line("G1 " + coordinate_word(order_.axis, behind_mm));
        line("G1 " + coordinate_word(order_.axis, move.coordinate_mm));
        dwell(seconds_of(order_.dwell));
    }
    void wait(const std::string& input, double limit_s, const std::string& complaint) {
        line("M66 " + input + format(" Q%.1f", limit_s));
        abort_unless_answered(complaint);
    }
    void abort_unless_answered(const std::string& complaint) {
        const std::string label = next_label();
        line(label + " if [#5399 EQ -1]");
        line("  (ABORT,axiscal: " + complaint + ")");
        line(label + " endif");
    }
    std::string next_label() { return "o" + std::to_string(++labels_); }

    const ProgramOrder& order_;
    std::string text_;
    int labels_ = 0;
};

} // namespace

Result<std::string> write_linuxcnc(const ProgramOrder& order) {
    if (auto fits = check_prepare(order); !fits) return tl::unexpected<Error>(fits.error());
    AXISCAL_CHECK(check_answer_limit(order.answer_limit, order.capture_timeout));
    if (order.shape == TriggerShape::dwell && order.dwell < order.least_halt)
        return fail(Fault::bad_request,
                    "a dwell of " + std::to_string(seconds_of(order.dwell)) +
                        " s is shorter than the station needs to see the halt (" +
                        std::to_string(seconds_of(order.least_halt)) + " s): lengthen cycle.dwell");
    if (order.retakes && order.rotary && order.rotary->method == AngleMethod::indexing_table)
        return fail(
            Fault::bad_request,
            "nobody tells a program where the indexing table stands now: drive to the points "
            "by hand, from the asked side, and take them with 'axiscal trigger'");
    return CycleWriter{order}.write();
}

} // namespace axiscal
