#pragma once
// A random machine measured by a whole station in virtual time, from the warm-up of the sensors to
// the certificate: what the station says of the set-up, and where. Tests only.

#include "tests/unit/setups/random_machine.hpp"

#include <string>
#include <vector>

namespace axiscal::setups_test {

/// One thing that the station said.
struct Said {
    std::string where; ///< "arm" | "point 12" | "end"
    std::string words;
};

/// What a technician would read, in order; empty where nothing is wrong. It ends with the first
/// refusal: he mends it, and begins again.
std::vector<Said> measure(RandomMachine& machine);

} // namespace axiscal::setups_test
