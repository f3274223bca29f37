#include "analysis/uncertainty/budget.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace axiscal {
namespace {

/// Standard uncertainty of a rectangular distribution of full width `width`.
double rectangular(double width) {
    return width / (2 * std::sqrt(3.0));
}

Contribution device_of(const UncertaintyStatement& s) {
    if (s.device_width)
        return {UncertaintyTerm::device, rectangular(*s.device_width), "R_D / (2 sqrt 3)",
                "S (text), R (formula)"};
    return {UncertaintyTerm::device, *s.device_U / *s.device_k, "U_cal / k",
            "S (text), R (formula)", Distribution::normal};
}

/// One-sided: the beam reads short by something between nothing and dL, so the full width is dL.
Contribution misalignment_of(const UncertaintyStatement& s) {
    constexpr double um_per_m = 1e6;
    if (s.misalignment_mm) // mm^2 / m is um
        return {UncertaintyTerm::misalignment,
                rectangular(*s.misalignment_mm * *s.misalignment_mm / (2 * *s.length_m)),
                "(e^2 / (2 L)) / (2 sqrt 3)", "R"};
    // 1 - cos delta without its cancellation
    const double half = std::sin(*s.misalignment_rad / 2);
    return {UncertaintyTerm::misalignment, rectangular(*s.length_m * um_per_m * 2 * half * half),
            "L (1 - cos delta) / (2 sqrt 3)", "R"};
}

std::vector<Contribution> contributions_of(const UncertaintyStatement& s) {
    using enum UncertaintyTerm;
    std::vector<Contribution> terms;
    if (s.device_U || s.device_width) terms.push_back(device_of(s));
    if (s.misalignment_mm || s.misalignment_rad) terms.push_back(misalignment_of(s));
    if (s.temperature_width_K)
        terms.push_back({machine_temperature,
                         rectangular(*s.alpha_um_per_m_K * *s.length_m * *s.temperature_width_K),
                         "alpha L R(theta) / (2 sqrt 3)", "R"});
    if (s.alpha_width_um_per_m_K)
        terms.push_back({machine_expansion,
                         rectangular(*s.length_m * std::fabs(*s.temperature_offset_K) *
                                     *s.alpha_width_um_per_m_K),
                         "L dT R(alpha) / (2 sqrt 3)", "R"});
    if (s.device_temperature_width_K)
        terms.push_back(
            {device_temperature,
             rectangular(*s.device_alpha_um_per_m_K * *s.length_m * *s.device_temperature_width_K),
             "alpha_D L R(theta_D) / (2 sqrt 3)", "S (text), R (formula)"});
    if (s.device_alpha_width_um_per_m_K)
        terms.push_back({device_expansion,
                         rectangular(*s.length_m * std::fabs(*s.device_temperature_offset_K) *
                                     *s.device_alpha_width_um_per_m_K),
                         "L dT_D R(alpha_D) / (2 sqrt 3)", "S (text), R (formula)"});
    if (s.eve) terms.push_back({environment, rectangular(*s.eve), "E_VE / (2 sqrt 3)", "R"});
    return terms;
}

/// Factors of u_EVE for n approaches, m targets and the edition's k.
struct EnvironmentFactors {
    double repeatability, reversal, mean_reversal, systematic_square, mean_square;
};

EnvironmentFactors factors_of(EveModel model, int approaches, int targets, double k) {
    const double n = approaches;
    const double often = model == EveModel::difference ? 2 : 1;
    return {approaches > 1 ? 2 * k / std::sqrt(n - 1) : 0, std::sqrt(2 / n),
            std::sqrt(2 / (n * targets)), often / n, often / (2 * n)};
}

ParameterUncertainty combined(
    std::string key, double u_systematic, double systematic, double environment, double u_eve) {
    ParameterUncertainty figure;
    figure.key = std::move(key);
    figure.systematic = systematic;
    figure.environment = environment;
    figure.u = std::sqrt(systematic * u_systematic * u_systematic +
                         environment * u_eve * environment * u_eve);
    return figure;
}

ParameterUncertainty
with_words(ParameterUncertainty figure, double coverage, std::string formula, std::string status) {
    figure.expanded = coverage * figure.u;
    figure.formula = std::move(formula);
    figure.status = std::move(status);
    return figure;
}

/// "" for both directions, "_forward", "_backward".
const std::vector<std::string>& directions() {
    static const std::vector<std::string> names{"", "_forward", "_backward"};
    return names;
}

void add_accuracy(UncertaintyBudget& budget,
                  const EnvironmentFactors& factor,
                  double u_systematic,
                  double u_eve) {
    const double both =
        std::sqrt(factor.systematic_square + factor.repeatability * factor.repeatability);
    for (const std::string& direction : directions())
        budget.parameters.push_back(
            with_words(combined("A" + direction, u_systematic, 1, both, u_eve), budget.coverage,
                       "sqrt(u(E)^2 + u(R_forward)^2)", "S"));
}

void add_means(UncertaintyBudget& budget,
               const EnvironmentFactors& factor,
               double u_systematic,
               double u_eve) {
    const bool twice = budget.eve_model == EveModel::difference;
    const std::string systematic = "sqrt(sum of the systematic u^2 + c u_EVE^2), c = ";
    for (const std::string& direction : directions())
        budget.parameters.push_back(with_words(
            combined("E" + direction, u_systematic, 1, std::sqrt(factor.systematic_square), u_eve),
            budget.coverage, systematic + (twice ? "2/n" : "1/n"), "R"));
    budget.parameters.push_back(
        with_words(combined("M", u_systematic, 1, std::sqrt(factor.mean_square), u_eve),
                   budget.coverage, systematic + (twice ? "1/n" : "1/(2n)"), "R"));
}

/// What the draws of k s, k s and |B| give when each counts once and none is taken as common.
double strict_repeatability(double k, int approaches, double u_eve) {
    const double n = approaches;
    return u_eve * std::sqrt(2 * k * k / (n - 1) + 2 / n);
}

void add_repeatability(UncertaintyBudget& budget,
                       const EnvironmentFactors& factor,
                       double k,
                       double u_eve) {
    const double both =
        std::sqrt(factor.reversal * factor.reversal + factor.repeatability * factor.repeatability);
    ParameterUncertainty two_way = with_words(combined("R", 0, 0, both, u_eve), budget.coverage,
                                              "sqrt(u(B)^2 + u(R_forward)^2)", "S (structure)");
    two_way.strict_u = strict_repeatability(k, budget.approaches, u_eve);
    budget.parameters.push_back(std::move(two_way));
    for (const char* key : {"R_forward", "R_backward"})
        budget.parameters.push_back(with_words(combined(key, 0, 0, factor.repeatability, u_eve),
                                               budget.coverage, "2 k u_EVE / sqrt(n - 1)",
                                               k == 2 ? "S" : "R"));
}

void add_reversal(UncertaintyBudget& budget, const EnvironmentFactors& factor, double u_eve) {
    budget.parameters.push_back(with_words(combined("B", 0, 0, factor.reversal, u_eve),
                                           budget.coverage, "u_EVE sqrt(2/n)", "R"));
    budget.parameters.push_back(
        with_words(combined("B_mean", 0, 0, factor.mean_reversal, u_eve), budget.coverage,
                   "u_EVE sqrt(2/(n m)), the mean of m independent B_i", "R (not in the source)"));
}

void add_parameters(UncertaintyBudget& budget, int targets, double k) {
    double square = 0, u_eve = 0;
    for (const Contribution& term : budget.contributions)
        if (term.term == UncertaintyTerm::environment)
            u_eve = term.u;
        else
            square += term.u * term.u;
    const double systematic = std::sqrt(square);
    const auto factor = factors_of(budget.eve_model, budget.approaches, targets, k);
    if (budget.approaches > 1) add_accuracy(budget, factor, systematic, u_eve);
    add_means(budget, factor, systematic, u_eve);
    if (budget.approaches > 1) add_repeatability(budget, factor, k, u_eve);
    add_reversal(budget, factor, u_eve);
}

/// Device temperature and expansion are no part of this: a laser has none.
std::vector<std::string> missing_terms(const UncertaintyBudget& budget) {
    using enum UncertaintyTerm;
    std::vector<UncertaintyTerm> wanted{device, environment};
    if (budget.axis_kind == AxisKind::linear)
        wanted = {device, misalignment, machine_temperature, machine_expansion, environment};
    std::vector<std::string> missing;
    for (const UncertaintyTerm term : wanted)
        if (!budget.find(term)) missing.emplace_back(name_of(term));
    return missing;
}

} // namespace

std::string_view name_of(Distribution distribution) {
    return distribution == Distribution::normal ? "normal" : "rectangular";
}

std::string_view name_of(UncertaintyTerm term) {
    switch (term) {
    case UncertaintyTerm::device: return "device";
    case UncertaintyTerm::misalignment: return "misalignment";
    case UncertaintyTerm::machine_temperature: return "machine_temperature";
    case UncertaintyTerm::machine_expansion: return "machine_expansion";
    case UncertaintyTerm::device_temperature: return "device_temperature";
    case UncertaintyTerm::device_expansion: return "device_expansion";
    case UncertaintyTerm::environment: return "environment";
    }
    return "environment";
}

const ParameterUncertainty* UncertaintyBudget::find(std::string_view key) const {
    const auto found = std::ranges::find(parameters, key, &ParameterUncertainty::key);
    return found == parameters.end() ? nullptr : &*found;
}

const Contribution* UncertaintyBudget::find(UncertaintyTerm term) const {
    const auto found = std::ranges::find(contributions, term, &Contribution::term);
    return found == contributions.end() ? nullptr : &*found;
}

Result<UncertaintyBudget>
make_budget(const UncertaintyStatement& statement, int approaches, int targets, double edition_k) {
    if (approaches < 1) return refuse(Fault::bad_case, "n", "must be 1 or more approaches");
    if (targets < 1) return refuse(Fault::bad_case, "targets", "must be 1 or more");
    AXISCAL_CHECK(check_statement(statement));
    UncertaintyBudget budget;
    budget.axis_kind = statement.axis_kind;
    budget.eve_model = statement.eve_model;
    budget.approaches = approaches;
    budget.length_m = statement.length_m;
    budget.contributions = contributions_of(statement);
    budget.not_stated = missing_terms(budget);
    add_parameters(budget, targets, edition_k);
    return budget;
}

const std::vector<std::string>& uncertain_parameters() {
    static const std::vector<std::string> keys{positioning_parameters.begin(),
                                               positioning_parameters.end()};
    return keys;
}

double budget_units_per(std::string_view unit) {
    constexpr double um_per_mm = 1e3, um_per_m = 1e6, arcsec_per_deg = 3600;
    if (unit == "mm") return um_per_mm;
    if (unit == "m") return um_per_m;
    return unit == "deg" ? arcsec_per_deg : 1;
}

} // namespace axiscal
