#pragma once
// A hidden machine measured by a whole station in virtual time: a drift test as long as a run, a
// run, its certificate. Tests only.

#include "tests/unit/setups/hidden_machine.hpp"

#include <map>
#include <string>

namespace axiscal::hidden_truth_test {

/// One figure of the certificate beside the truth, um.
struct Compared {
    double truth = 0, value = 0, U = 0, low = 0, high = 0;
    [[nodiscard]] bool inside_U() const { return value - U <= truth && truth <= value + U; }
    [[nodiscard]] bool inside_interval() const { return low <= truth && truth <= high; }
};

struct MeasuredTruth {
    std::map<std::string, Compared> figures; ///< by the contract's keys
    std::string why_not;                     ///< what kept the station from a certificate
};

MeasuredTruth measure(HiddenMachine& machine);

} // namespace axiscal::hidden_truth_test
