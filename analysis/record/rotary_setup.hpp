#pragma once
// How the angle of a rotary axis is measured. Pure data.

#include "analysis/quantity/quantity.hpp"
#include "analysis/quantity/time.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

enum class AngleMethod : std::uint8_t { indexing_table, polygon };
std::string_view name_of(AngleMethod method); ///< "indexing_table" | "polygon"

/// Of the instrument's range plans and programs use this share: the rest is for the errors of the
/// axis and of the set-up.
inline constexpr double usable_share_of_range = 0.95;

/// An indexing table under an angular interferometer, or a polygon before an autocollimator.
struct RotarySetup {
    AngleMethod method = AngleMethod::indexing_table;
    double step_deg = 1;   ///< between two positions of the table, or two faces of the polygon
    Length arm;            ///< between the two reflectors of the interferometer; 0: a polygon
    double range_deg = 10; ///< largest angle, either way, that the instrument can show
    Duration turn_time{};  ///< how long a part program halts while the table is turned
    bool by_hand = false;  ///< the table is turned by a person, who then starts the program again
    /// Certified deviations of all positions of a turn, that of position 0 first; empty: not
    /// stated, taken as 0.
    std::vector<double> deviations_arcsec;
    /// A positive certified deviation stands turned in the positive direction of the axis.
    bool certificate_with_axis = true;
    std::string run_out; ///< of the set-up, as a person states it; empty prints "not stated"
};

} // namespace axiscal
