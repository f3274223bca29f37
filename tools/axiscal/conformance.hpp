#pragma once
// `axiscal conformance`: this program, or another, held against cases with known figures.

#include <chrono>
#include <string>
#include <vector>

namespace axiscal {

struct ConformanceOrder {
    std::string command; ///< another program, by `sh -c`; empty: this one, in process
    std::string folder;  ///< of cases; empty: find_conformance_folder()
    std::vector<std::string> only;
    double seconds = 60; ///< a case, for another program
    bool brief = false;  ///< print only what disagrees
};

/// exit_ok: every figure agrees. exit_disagrees: at least one does not, or a case has no answer.
/// exit_refused: a file is no case (nothing is run then). exit_failed: a file or the folder cannot
/// be read. exit_usage: `only` fits no case.
int command_conformance(const ConformanceOrder& order, bool json);

} // namespace axiscal
