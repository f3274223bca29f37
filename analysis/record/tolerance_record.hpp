#pragma once
// The limits that a customer and a maker agreed on, and the rule by which a figure with an
// uncertainty is held against them. Pure data.

#include "analysis/record/limit_quantity.hpp"
#include "analysis/record/test_kind.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

/// How much of the uncertainty the decision takes into account. ISO/IEC 17025:2017, 7.8.6: who
/// states conformity documents the rule; without one nothing is decided.
enum class DecisionRule : std::uint8_t {
    none,
    iso_14253_1_2017, ///< each side proves its case with a probability of 95 %
    guard_U,          ///< each side proves its case by the expanded uncertainty
    simple            ///< the bare numbers
};
constexpr std::string_view name_of(DecisionRule rule) {
    switch (rule) {
    case DecisionRule::none: return "none";
    case DecisionRule::iso_14253_1_2017: return "14253-1:2017";
    case DecisionRule::guard_U: return "guard-U";
    case DecisionRule::simple: return "simple";
    }
    return "none";
}
inline constexpr std::array stated_rules{DecisionRule::iso_14253_1_2017, DecisionRule::guard_U,
                                         DecisionRule::simple};

/// A parameter must not exceed `limit` on an axis whose travel is at most `travel_up_to`.
struct ToleranceLimit {
    std::string parameter;              ///< "A", "R_forward", "U_max", "G_b", "E_VE", ...
    std::optional<double> travel_up_to; ///< mm or degrees; absent: any travel
    double limit = 0;                   ///< > 0, in the unit of the set
};

struct ToleranceRecord {
    std::string name, source; ///< what the set is, where its numbers are from
    std::string unit;         ///< of the limits: "mm" | "um" | "m" | "deg" | "arcsec" | "um/m"
    DecisionRule rule = DecisionRule::none;
    bool to_be_checked = false; ///< nobody has compared the numbers with their source
    std::vector<ToleranceLimit> limits;
};

/// The figures of one kind of test that a limit can name.
struct JudgedFigures {
    std::span<const std::string_view> names; ///< for positioning those of every standard
    LimitQuantity limit = LimitQuantity::length;
    bool by_travel = false; ///< a limit may hold for axes up to a travel
};
const JudgedFigures& judged_figures(TestKind kind);
/// Those that the figure is one of; null where no kind of test has it.
const JudgedFigures* judged_with(std::string_view parameter);

/// The set with the limits of this kind alone, in their unit; nothing where it has none.
/// @param rotary  the axis turns
std::optional<ToleranceRecord>
limits_of_kind(const ToleranceRecord& set, TestKind kind, bool rotary);

} // namespace axiscal
