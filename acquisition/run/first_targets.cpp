#include "acquisition/run/first_targets.hpp"

#include "acquisition/capture/wording.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

namespace axiscal {
namespace {

struct KnownRatio {
    double ratio;
    std::string_view cause;
};

constexpr std::array known_ratios{
    KnownRatio{25.4, "an inch is taken for a millimetre (unit of the part program)"},
    KnownRatio{1 / 25.4, "a millimetre is taken for an inch (unit of the part program)"},
    KnownRatio{2.0, "the optics are set to half of their passes or counts (optical fold), or the "
                    "program counts radius where the control takes diameter"},
    KnownRatio{0.5, "the optics are set to twice their passes or counts (optical fold), or the "
                    "axis is programmed in diameter"},
    KnownRatio{4.0, "the optics are set to a quarter of their passes or counts (optical fold, "
                    "counts per cycle)"},
    KnownRatio{0.25, "the optics are set to four times their passes or counts (optical fold, "
                     "counts per cycle)"},
};

using Claims = std::span<const ClaimedTarget>;

bool close(Length seen, Length predicted) {
    return abs(seen - predicted) <= std::max(50.0_um, abs(predicted) * 0.005);
}

bool ratio_fits(Length datum, Claims claims, double ratio) {
    return std::ranges::all_of(claims, [&](const ClaimedTarget& claim) {
        return close(claim.measured - datum, (claim.target - datum) * ratio);
    });
}

/// Two claims at least: with one, a shift cannot be told from a scale.
bool shift_fits(Claims claims) {
    const auto shift = claims.front().measured - claims.front().target;
    return std::ranges::all_of(claims, [&](const ClaimedTarget& claim) {
        return close(claim.measured - claim.target, shift);
    });
}

/// The targets before were right, this one is off: what a shift in mid-program leaves.
bool shift_is_new(Claims claims) {
    const auto before = claims.first(claims.size() - 1);
    return std::ranges::all_of(before, [](const ClaimedTarget& claim) {
        return abs(claim.measured - claim.target) <= 50.0_um;
    });
}

/// The axis has not left the target before, where it was right.
bool is_one_step_late(Claims claims) {
    const auto& before = claims.front();
    const auto& last = claims.back();
    return abs(last.measured - before.measured) <= 50.0_um &&
           abs(before.measured - before.target) < abs(last.target - before.target) / 2;
}

std::string joined(const std::vector<std::string>& causes) {
    std::string text;
    for (const auto& cause : causes)
        text += (text.empty() ? "" : "; or ") + cause;
    return text;
}

/// Causes with a name of their own: no motion, turned sign, known ratios.
std::vector<std::string> named_causes(Length datum, Claims claims, Fault& fault) {
    std::vector<std::string> causes;
    const auto add = [&](Fault of_cause, std::string cause) {
        if (causes.empty()) fault = of_cause;
        causes.push_back(std::move(cause));
    };
    if (ratio_fits(datum, claims, 0))
        add(Fault::wrong_target, "another axis is measured, the axis does not move, or the program "
                                 "asks one step early");
    if (ratio_fits(datum, claims, -1))
        add(Fault::wrong_direction, "the sign is turned (set axis.sign to its opposite)");
    for (const auto& known : known_ratios)
        for (const double sign : {1.0, -1.0})
            if (ratio_fits(datum, claims, sign * known.ratio))
                add(sign > 0 ? Fault::outside_window : Fault::wrong_direction,
                    std::string{known.cause} + (sign > 0 ? "" : ", and the sign is turned"));
    return causes;
}

std::string scale_cause(double ratio) {
    return "the scale is wrong by the factor " + plain_number(ratio, 4) +
           " (optics, wavelength, unit or gear of the axis)";
}

/// What one target alone makes likely: beyond it the axis stood elsewhere, known ratios apart.
bool is_likely_scale(double ratio) {
    return std::abs(ratio - 1) < 0.5;
}

std::string shift_cause(Length shift) {
    return "the datum is shifted by " + in_mm(shift);
}

/// The readings cannot tell a run armed elsewhere from a shift of the program.
std::string off_the_datum(Length shift) {
    return "the axis stood " + in_mm(abs(shift)) +
           " from its datum when the run was armed (abort, go to the datum and arm again), or " +
           shift_cause(shift);
}

/// With one target a shift cannot be told from a scale: the likelier one comes first.
void add_causes_of_one(std::vector<std::string>& causes, Length shift, double ratio, Fault fault) {
    const bool unnamed = causes.empty();
    // Nothing moved is no shift: a shift would have to equal the move by chance.
    if (fault != Fault::wrong_target) causes.push_back(off_the_datum(shift));
    if (unnamed && is_likely_scale(ratio)) causes.push_back(scale_cause(ratio));
}

void add_causes_of_two(std::vector<std::string>& causes, Length datum, Claims claims) {
    const auto& last = claims.back();
    const auto shift = last.measured - last.target;
    const double ratio = (last.measured - datum) / (last.target - datum);
    if (shift_fits(claims))
        causes.push_back(off_the_datum(shift));
    else if (causes.empty() && ratio_fits(datum, claims, ratio))
        causes.push_back(scale_cause(ratio));
    if (is_one_step_late(claims))
        causes.emplace_back("the axis still stands at the target before: it did not move (slip "
                            "between scale and spindle), or the program asks one step early");
    else if (shift_is_new(claims))
        causes.push_back(shift_cause(shift) + " since the target before");
}

} // namespace

Error diagnose_first_targets(Length datum, std::span<const ClaimedTarget> claims) {
    if (claims.empty()) return {Fault::outside_window, "Nothing was measured yet.", {}, {}};
    const auto& last = claims.back();
    const auto claimed = last.target - datum, seen = last.measured - datum;
    auto fault = Fault::outside_window;
    auto causes = named_causes(datum, claims, fault);
    if (claims.size() > 1)
        add_causes_of_two(causes, datum, claims);
    else
        add_causes_of_one(causes, last.measured - last.target, seen / claimed, fault);
    if (causes.empty()) causes.emplace_back("the axis stands at another place than the program");
    return {fault,
            "From the datum at " + in_mm(datum) + " the program claims a move of " +
                in_mm(claimed) + ", the readings show " + in_mm(seen) + ": " + joined(causes) + ".",
            {},
            {}};
}

} // namespace axiscal
