#include "analysis/straightness/straightness_budget.hpp"

#include "analysis/checked_numbers.hpp"
#include "analysis/straightness/sensitivity.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace axiscal {
namespace {

constexpr double root_3 = std::numbers::sqrt3;
constexpr double um_a_metre = 1e6;

Result<void> check_stated(const std::optional<double>& value, const std::string& field) {
    if (!value) return {};
    AXISCAL_CHECK(check_case_number(*value, field));
    if (*value < 0) return refuse(Fault::bad_case, field, "is negative");
    return {};
}

Result<void> check_inputs(const StraightnessInputs& in) {
    AXISCAL_CHECK(check_stated(in.factor_u, "factor_u"));
    AXISCAL_CHECK(check_stated(in.mirror_limit_um_per_m2, "mirror_limit_um_per_m2"));
    AXISCAL_CHECK(check_stated(in.angle_u_rad, "angle_u_rad"));
    AXISCAL_CHECK(check_stated(in.base_u, "base_u"));
    AXISCAL_CHECK(check_stated(in.resolution, "resolution"));
    AXISCAL_CHECK(check_stated(in.eve, "eve"));
    AXISCAL_CHECK(check_stated(in.scatter, "scatter"));
    if (!in.wollaston) AXISCAL_CHECK(check_positive(in.base_um, "base_um"));
    if (in.readings_a_mean < 1)
        return refuse(Fault::bad_case, "readings_a_mean", "must be at least 1");
    return {};
}

/// One term with what it gives of a straightness; no value: not stated.
struct Term {
    StraightnessTerm term = StraightnessTerm::factor;
    std::optional<double> u_um;
    std::string formula;
};

/// The straightness and how independent errors of its readings reach it.
struct Reached {
    double straightness_um = 0, length_m = 0;
    double by_reading = 0; ///< um of straightness for an error of 1 of each reading by itself
};

Reached
reach_of(const StraightnessLine& line, const StraightnessInputs& in, LineReference reference) {
    const auto w = sensitivity_of(line.line, line.against, reference);
    Reached out;
    out.straightness_um = line.straightness_um(reference);
    out.length_m = (line.line.positions.back() - line.line.positions.front()) / um_a_metre;
    out.by_reading = in.wollaston ? std::sqrt(sum_of_squares(w))
                                  : in.base_um * std::sqrt(sum_of_squares(sensitivity_to_steps(w)));
    return out;
}

/// The given value times `factor`, where there is one.
std::optional<double> times(const std::optional<double>& value, double factor) {
    return value ? std::optional{*value * factor} : std::nullopt;
}

std::optional<double> mirror_u(const StraightnessInputs& in, const Reached& reached) {
    if (in.mirror_reversed) return 0.0;
    return times(in.mirror_limit_um_per_m2, reached.length_m * reached.length_m / root_3);
}

/// The scatter of the readings holds the environment; E_VE alone may have been taken on a calm day.
std::optional<double> environment_u(const StraightnessInputs& in, const Reached& reached) {
    if (!in.eve) return std::nullopt;
    const double one = std::max(*in.eve / (2 * root_3), in.scatter.value_or(0));
    return one / std::sqrt(static_cast<double>(in.readings_a_mean)) * reached.by_reading;
}

std::vector<Term> terms_of(const StraightnessInputs& in, const Reached& reached) {
    const std::string spread = in.wollaston ? "sqrt(sum w^2)" : "b sqrt(sum g^2)";
    std::vector<Term> terms;
    if (in.wollaston) {
        terms.push_back(
            {StraightnessTerm::factor, times(in.factor_u, reached.straightness_um), "P u(f)/f"});
        terms.push_back({StraightnessTerm::mirror, mirror_u(in, reached),
                         in.mirror_reversed ? "0: mean of both positions" : "a L^2/sqrt(3)"});
    } else {
        terms.push_back({StraightnessTerm::angle, times(in.angle_u_rad, reached.by_reading),
                         "u(angle) " + spread});
        terms.push_back(
            {StraightnessTerm::base, times(in.base_u, reached.straightness_um), "P u(b)/b"});
    }
    terms.push_back({StraightnessTerm::resolution,
                     times(in.resolution, reached.by_reading / (2 * root_3)),
                     "q/(2 sqrt(3)) " + spread});
    terms.push_back({StraightnessTerm::environment, environment_u(in, reached),
                     "max(E_VE/(2 sqrt(3)), s)/sqrt(N) " + spread});
    return terms;
}

StraightnessUncertainty combined(std::vector<Term> terms,
                                 const Reached& reached,
                                 LineReference reference,
                                 double coverage) {
    StraightnessUncertainty out;
    out.reference = reference;
    out.straightness_um = reached.straightness_um;
    double squares = 0;
    bool whole = true;
    for (Term& term : terms) {
        whole = whole && term.u_um.has_value();
        if (!term.u_um) continue;
        squares += *term.u_um * *term.u_um;
        out.contributions.push_back({term.term, *term.u_um, std::move(term.formula)});
    }
    if (!whole) return out;
    out.u_um = std::sqrt(squares);
    out.expanded_um = coverage * *out.u_um;
    return out;
}

std::vector<std::string> names_of_missing(const std::vector<Term>& terms) {
    std::vector<std::string> names;
    for (const Term& term : terms)
        if (!term.u_um) names.emplace_back(name_of(term.term));
    return names;
}

} // namespace

std::string_view name_of(StraightnessTerm term) {
    switch (term) {
    case StraightnessTerm::factor: return "factor";
    case StraightnessTerm::mirror: return "mirror";
    case StraightnessTerm::angle: return "angle";
    case StraightnessTerm::base: return "base";
    case StraightnessTerm::resolution: return "resolution";
    case StraightnessTerm::environment: return "environment";
    }
    return "?";
}

Result<StraightnessBudget> make_straightness_budget(const StraightnessLine& line,
                                                    const StraightnessInputs& inputs) {
    AXISCAL_CHECK(check_inputs(inputs));
    StraightnessBudget budget;
    budget.by_scatter =
        inputs.eve && inputs.scatter && *inputs.scatter > *inputs.eve / (2 * root_3);
    constexpr std::array references{LineReference::end_points, LineReference::least_squares,
                                    LineReference::minimum_zone};
    for (std::size_t k = 0; k < references.size(); ++k) {
        const Reached reached = reach_of(line, inputs, references[k]);
        std::vector<Term> terms = terms_of(inputs, reached);
        if (k == 0) budget.not_stated = names_of_missing(terms);
        budget.by_reference[k] =
            combined(std::move(terms), reached, references[k], budget.coverage);
    }
    return budget;
}

} // namespace axiscal
