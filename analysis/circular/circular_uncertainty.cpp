#include "analysis/circular/circular_uncertainty.hpp"

#include "analysis/circular/circular_trials.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace axiscal {
namespace {

constexpr double millimetre = 1e-3;                    ///< of a micrometre
const double of_width = 1 / (2 * std::numbers::sqrt3); ///< rectangular, by its full width

Result<void> check_width(const std::optional<double>& value, double most, const char* key) {
    if (!value || (*value >= 0 && *value <= most)) return {};
    return refuse(Fault::bad_case, std::string{"uncertainty."} + key,
                  "must be no less than 0 and of a size that makes sense");
}

/// Widths of what only counts with temperatures.
Result<void> check_warmth(const CircularUncertaintyStatement& s, bool warm) {
    constexpr double most_kelvins = 50, most_alpha = 1e-4;
    struct Stated {
        const std::optional<double>& value;
        double most;
        const char* key;
    };
    for (const auto& [value, most, key] :
         {Stated{s.machine_temperature_width_K, most_kelvins, "machine_temperature_width_K"},
          Stated{s.bar_temperature_width_K, most_kelvins, "bar_temperature_width_K"},
          Stated{s.machine_alpha_width_per_K, most_alpha, "machine_expansion_width_per_K"},
          Stated{s.bar_alpha_width_per_K, most_alpha, "bar_expansion_width_per_K"}}) {
        if (value && !warm)
            return refuse(Fault::bad_case, std::string{"uncertainty."} + key,
                          "needs the case's temperature");
        AXISCAL_CHECK(check_width(value, most, key));
    }
    return {};
}

Result<void> check(const CircularUncertaintyStatement& s, bool warm) {
    constexpr double most_um = 1e4;
    AXISCAL_CHECK(check_width(s.device_width_um, most_um, "device_width_um"));
    AXISCAL_CHECK(check_width(s.calibration_U_um, most_um, "calibration_U_um"));
    AXISCAL_CHECK(check_width(s.repeatability_um, most_um, "repeatability_um"));
    AXISCAL_CHECK(check_width(s.eve_um, most_um, "eve_um"));
    AXISCAL_CHECK(check_width(s.centre_width_um, most_um, "centre_width_um"));
    AXISCAL_CHECK(check_warmth(s, warm));
    if (s.calibration_U_um.has_value() != s.calibration_k.has_value())
        return refuse(Fault::bad_case, "uncertainty.calibration_k",
                      "stands together with calibration_U_um");
    if (s.calibration_k && !(*s.calibration_k >= 1 && *s.calibration_k <= 10))
        return refuse(Fault::bad_case, "uncertainty.calibration_k", "must lie within 1 ... 10");
    if (s.runs < 1 || s.runs > 1000)
        return refuse(Fault::bad_case, "uncertainty.n", "must lie within 1 ... 1000");
    return {};
}

/// The terms in fixed order, each zero where it is not stated.
class Terms {
public:
    Terms(const CircularTest& test,
          const std::optional<BarExpansion>& bar,
          const CircularUncertaintyStatement& s,
          CircularBudget& out)
        : out_{out} {
        const BarExpansion warm = bar.value_or(BarExpansion{});
        const double radius = test.nominal_radius_mm, bar_length = warm.bar_length_mm;
        device_ =
            add("device", s.device_width_um, of_width * millimetre, "width / (2 sqrt 3)", "R");
        calibration_ = add("calibration", s.calibration_U_um,
                           millimetre / s.calibration_k.value_or(1), "U / k", "S");
        repeat_ = add("repeatability", s.repeatability_um, millimetre / std::sqrt(s.runs),
                      "s / sqrt(n)", "S");
        drift_ = add("environment", s.eve_um, of_width * millimetre / std::sqrt(s.runs),
                     "E_VE / (2 sqrt 3) / sqrt(n)", "R");
        warmth(add("machine_temperature", s.machine_temperature_width_K,
                   of_width * radius * std::fabs(warm.machine_alpha_per_K),
                   "R alpha_M width / (2 sqrt 3)", "R"));
        warmth(add("bar_temperature", s.bar_temperature_width_K,
                   of_width * bar_length * std::fabs(warm.bar_alpha_per_K),
                   "L alpha_B width / (2 sqrt 3)", "R"));
        warmth(add("machine_expansion", s.machine_alpha_width_per_K,
                   of_width * radius * std::fabs(warm.machine_degC - 20),
                   "R |theta_M - 20| width / (2 sqrt 3)", "R"));
        warmth(add("bar_expansion", s.bar_alpha_width_per_K,
                   of_width * bar_length * std::fabs(warm.bar_degC - 20),
                   "L |theta_B - 20| width / (2 sqrt 3)", "R"));
        centre_ = add("centre", s.centre_width_um, of_width * millimetre,
                      "width / (2 sqrt 3); F about the set-up centre", "R");
    }
    [[nodiscard]] double of_form() const {
        return std::sqrt(device_ * device_ + repeat_ * repeat_ + drift_ * drift_);
    }
    [[nodiscard]] double of_diameter() const {
        return std::sqrt(calibration_ * calibration_ + warmth_squared_ + repeat_ * repeat_ +
                         drift_ * drift_);
    }
    [[nodiscard]] double of_radius(RadialCentre centre) const {
        const double mounted = centre == RadialCentre::set_up ? centre_ : 0;
        const double diameter = of_diameter();
        return std::sqrt(diameter * diameter + device_ * device_ + mounted * mounted);
    }

private:
    double add(const char* term,
               const std::optional<double>& stated,
               double factor,
               const char* formula,
               const char* status) {
        if (!stated) {
            out_.not_stated.emplace_back(term);
            return 0;
        }
        out_.contributions.push_back({term, *stated * factor, formula, status, {}});
        return out_.contributions.back().u_mm;
    }
    void warmth(double u) { warmth_squared_ += u * u; }

    CircularBudget& out_;
    double device_ = 0, calibration_ = 0, repeat_ = 0, drift_ = 0, warmth_squared_ = 0, centre_ = 0;
};

circular::Disturbances disturbances_of(const CircularUncertaintyStatement& s) {
    const auto mm = [](const std::optional<double>& um) { return um.value_or(0) * millimetre; };
    return {mm(s.device_width_um),
            mm(s.calibration_U_um) / s.calibration_k.value_or(1),
            mm(s.repeatability_um),
            mm(s.eve_um),
            mm(s.centre_width_um),
            s.machine_temperature_width_K.value_or(0),
            s.bar_temperature_width_K.value_or(0),
            s.machine_alpha_width_per_K.value_or(0),
            s.bar_alpha_width_per_K.value_or(0),
            s.runs};
}

RadialCentre centre_of(const CircularParameters& parameters, const std::string& key) {
    return parameters.of(key.ends_with("_ccw") ? Sense::ccw : Sense::cw)->F.centre;
}

} // namespace

const CircularFigureUncertainty* CircularBudget::find(std::string_view key) const {
    const auto found = std::ranges::find(figures, key, &CircularFigureUncertainty::key);
    return found == figures.end() ? nullptr : &*found;
}

Result<CircularBudget> circular_budget(const CircularTest& test,
                                       RadialCentre f_centre,
                                       const std::optional<BarExpansion>& bar,
                                       const CircularUncertaintyStatement& statement,
                                       int trials,
                                       std::uint64_t seed) {
    AXISCAL_CHECK(check(statement, bar.has_value()));
    AXISCAL_TRY(const CircularParameters parameters, evaluate_circular(test, f_centre, bar));
    CircularBudget out;
    out.runs = statement.runs;
    out.trials = trials;
    const Terms terms{test, bar, statement, out};
    for (const auto& [key, value] : circular::figures_by_key(parameters)) {
        double u = terms.of_form();
        if (key == "D") u = terms.of_diameter();
        if (key.starts_with('F')) u = terms.of_radius(centre_of(parameters, key));
        out.figures.push_back({key, u, out.coverage * u, {}});
    }
    if (trials <= 0) return out;
    AXISCAL_TRY(const auto tried, circular::try_circular(test, f_centre, bar,
                                                         disturbances_of(statement), trials, seed));
    for (CircularFigureUncertainty& figure : out.figures)
        if (const auto found = tried.find(figure.key); found != tried.end())
            figure.monte_carlo_u_mm = found->second;
    return out;
}

} // namespace axiscal
