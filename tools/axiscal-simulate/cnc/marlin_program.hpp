#pragma once
// A part program in Marlin's dialect, for printers that move and dwell and know no inputs:
// G0 G1 with one axis letter and F, G4 P milliseconds or S seconds, G21, G90, M84 S0, M117 text,
// M400, comments after ';'. Any other word is refused with its line number before anything moves.

#include "analysis/quantity/result.hpp"
#include "cnc/machine_actions.hpp"

#include <string>
#include <vector>

namespace axiscal::simulate {

class MarlinProgram {
public:
    /// @errors bad_request: "line 12: ...".
    static Result<MarlinProgram> parse(const std::string& text, char axis_letter);
    Result<void> run(MachineActions& machine) const;

private:
    struct Step {
        enum Kind { move, dwell, message } kind = move;
        int line = 0;
        double value = 0, feed_mm_per_min = 0; ///< mm, or seconds
        std::string text = {};
    };
    Result<void> add_line(const std::string& line, int number, char axis, double& feed);
    std::vector<Step> steps_;
};

} // namespace axiscal::simulate
