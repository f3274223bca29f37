#pragma once
// How near figures computed anew must come to those that were written down. Pure.

#include "analysis/record/run_record.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace axiscal {

/// Both 0: the same number. Text, structure and whole numbers agree only when they are the same.
struct FigureAgreement {
    double absolute = 0; ///< in the figure's own unit
    double relative = 0; ///< of the larger of the two
    [[nodiscard]] bool holds(double written, double anew) const;
};

/// Of figures made with + - * / and sqrt alone: any amd64 processor gives the same bits.
inline constexpr FigureAgreement same_bits{};

/// Of figures in which a sine, an arc sine or an exponential of the C library stands. It takes
/// another path on a processor with fused multiply-add, and its last bit may change: 2^-52 of a
/// coordinate of 1 m is 2.3e-13 mm, of 360 degrees 8e-14 degrees. A fit on an arc enlarges that by
/// its condition, which is below 1e4 where a figure is printed: 2.3e-9 mm. 1e-8 (mm, degree, um or
/// ms) holds that, is what the digest of a circular test is rounded to, and lies far below what any
/// instrument resolves. The relative part is for what is large itself: a condition number c errs by
/// c * 2^-52 of itself, up to 1e-10 for one of 4e5.
inline constexpr FigureAgreement rounding_of_the_library{1e-8, 1e-10};

/// Of a positioning or drift run: same_bits, except for a rotary axis behind an indexing table (arc
/// sine), air below 0 degC (exponential of the vapour pressure over ice) and a misalignment stated
/// as an angle (sine, in the uncertainties).
FigureAgreement agreement_of(const RunRecord& run);

/// JSON pointers to what `anew` does not agree with in `written`, in the order of nlohmann's diff.
std::vector<std::string> disagreements(const nlohmann::ordered_json& written,
                                       const nlohmann::ordered_json& anew,
                                       const FigureAgreement& agreement);

} // namespace axiscal
