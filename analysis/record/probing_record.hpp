#pragma once
// A probing test as it was made on the machine: every touch with what the control latched. Pure.

#include "analysis/quantity/quantity.hpp"
#include "analysis/record/limit_quantity.hpp"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

/// One touch of a face of the block.
struct ProbingTouch {
    std::array<double, 3> direction{}; ///< of approach, in X, Y, Z
    bool reference = false;            ///< one of those from one and the same distance
    Length approach;                   ///< from the start to the zeroed face
    std::array<Length, 3> latched{};   ///< X, Y, Z of the control at the touch
    bool operator==(const ProbingTouch&) const = default;
};

struct ProbingRecord {
    double feed_mm_per_min = 0;
    std::string probe, signal_path;    ///< as stated: type and stylus; skip input, PLC
    std::vector<ProbingTouch> touches; ///< in the order in which they were made

    static constexpr LimitQuantity judged_in = LimitQuantity::length;
    static constexpr std::array<std::string_view, 7> judged{
        "E_TD,X", "E_TD,Y", "E_TD,Z", "E_TD,XY", "E_TD,XZ", "E_TD,YZ", "E_TD,XYZ"};
};

} // namespace axiscal
