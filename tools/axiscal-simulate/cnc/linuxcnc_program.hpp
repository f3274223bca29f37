#pragma once
// A part program in LinuxCNC's dialect, as far as the generated calibration programs use it:
// G0 G1 G4 G17 G21 G40 G49 G54 G61 G64 G80 G90 G94, F, one axis letter, M2 M30, M64 M65 M66 M67
// M68, parameters, expressions, o-words if/elseif/else/endif, while/endwhile, (ABORT,text),
// comments.
// Any other word is refused with its line number before anything moves.

#include "analysis/quantity/result.hpp"
#include "cnc/machine_actions.hpp"

#include <string>
#include <vector>

namespace axiscal::simulate {

class LinuxcncProgram {
public:
    /// @errors bad_request: "line 12: ...".
    /// `plane`: letters of two axes ("ZX") whose ways and arcs (G1 G2 G3 with both words, centre
    /// words relative to the begin) go to MachineActions::trace; "": none.
    static Result<LinuxcncProgram>
    parse(const std::string& text, char axis_letter, const std::string& plane = {});
    /// Runs to M2, the end of the file, (ABORT,...) or a stop. @errors refused for ABORT and for
    /// what only shows while running.
    Result<void> run(MachineActions& machine) const;

private:
    enum class Kind { words, assignments, abort, if_, elseif, else_, endif, while_, endwhile };
    struct Block {
        int line = 0;
        Kind kind = Kind::words;
        std::string text;     ///< without blanks and comments, lower case; ABORT: the message
        std::string label;    ///< of an o-word
        std::size_t jump = 0; ///< if/elseif/else: the next arm; endwhile: its while; while: its end
    };
    struct State;

    static Result<Block> read_o_word(const std::string& text, int line);
    Result<void> add_line(const std::string& line, int number);
    Result<void> match_o_words();
    [[nodiscard]] Result<void> check() const;
    Result<void> execute(const Block& block, State& state, MachineActions& machine) const;
    Result<void> execute_words(const Block& block, State& state, MachineActions& machine) const;
    static Result<void> assign(const Block& block, State& state);
    static Result<void> test(const Block& block, State& state);
    void skip_to_endif(State& state) const;

    char axis_letter_ = 'x';
    std::string plane_; ///< lower case; empty: one axis alone
    std::vector<Block> blocks_;
};

} // namespace axiscal::simulate
