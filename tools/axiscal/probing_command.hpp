#pragma once
// `axiscal probing`: the part program of a probing test, and its log as a run file. Needs no
// daemon.

#include "acquisition/program/probing_program.hpp"

#include <string>

namespace axiscal {

struct ProbingOrder {
    std::string action = "program"; ///< program | record
    ProbingPlan plan;
    std::string log = "probing.txt"; ///< written by the control, read by `record`
    std::string program = "probing.ngc";
    std::string config, out = ".";
    std::string probe, signal_path, operator_name;
};
int command_probing(const ProbingOrder& order, bool json);

} // namespace axiscal
