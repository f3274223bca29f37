#include "truth.hpp"

#include "injected_process.hpp"
#include "laser_count.hpp"
#include "simulated_machine.hpp"
#include "squareness_truth.hpp"
#include "straightness_truth.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace axiscal::simulate {

namespace {

double mean_of(const std::vector<double>& row) {
    double sum = 0;
    for (const double x : row)
        sum += x;
    return sum / static_cast<double>(row.size());
}

double deviation_of(const std::vector<double>& row, double mean) {
    double squares = 0;
    for (const double x : row)
        squares += (x - mean) * (x - mean);
    return std::sqrt(squares / static_cast<double>(row.size() - 1));
}

/// Largest minus smallest of all that was put in.
struct Range {
    double low = 1e300, high = -1e300;
    void put(double x) { low = std::min(low, x), high = std::max(high, x); }
    [[nodiscard]] double width() const { return high - low; }
};

struct OneWay {
    std::vector<double> mean_um, s_um;
    Range means, band;
    double R_um = 0;
};

OneWay one_way(const Readings& table) {
    OneWay way;
    for (const auto& row : table) {
        const double mean = mean_of(row);
        const double s = row.size() > 1 ? deviation_of(row, mean) : 0;
        way.mean_um.push_back(mean);
        way.s_um.push_back(s);
        way.means.put(mean);
        way.band.put(mean - 2 * s);
        way.band.put(mean + 2 * s);
        way.R_um = std::max(way.R_um, 4 * s);
    }
    return way;
}

void add_two_way(std::map<std::string, double>& p, const OneWay& up, const OneWay& down) {
    Range means, middle, band;
    double largest_reversal = 0, sum_of_reversals = 0, repeatability = 0;
    for (std::size_t i = 0; i < up.mean_um.size(); ++i) {
        const double reversal = up.mean_um[i] - down.mean_um[i];
        largest_reversal = std::max(largest_reversal, std::abs(reversal));
        sum_of_reversals += reversal;
        middle.put(0.5 * (up.mean_um[i] + down.mean_um[i]));
        const double su = up.s_um[i], sd = down.s_um[i];
        repeatability =
            std::max({repeatability, 2 * su + 2 * sd + std::abs(reversal), 4 * su, 4 * sd});
    }
    for (const OneWay* way : {&up, &down}) {
        means.put(way->means.low), means.put(way->means.high);
        band.put(way->band.low), band.put(way->band.high);
    }
    p["E"] = means.width();
    p["M"] = middle.width();
    p["B"] = largest_reversal;
    p["B_mean"] = sum_of_reversals / static_cast<double>(up.mean_um.size());
    p["R"] = repeatability;
    p["A"] = band.width();
}

/// The injected means at 20 C, one row per target.
Readings means_of(const Scenario& scenario, const TruthPlan& plan, int direction) {
    const TrueErrors errors{scenario.errors};
    Readings table;
    for (const double target : plan.targets_mm)
        table.push_back({errors.deviation_um(target, direction)});
    return table;
}

/// What a sine averaged over T keeps at most: A / (pi f T). For the bound it counts like a sigma.
double bound_sigma_um(const Scenario& s) {
    const double rest_of_vibration =
        s.errors.vibration_um / (std::numbers::pi * s.truth.window_s * s.errors.vibration_hz);
    return std::hypot(capture_sigma_um(s), rest_of_vibration);
}

/// What the sensors' resolution and the differences of admissible formulas can shift, um.
struct Systematic {
    double material_scale = 0, material_step = 0, air = 0, formula = 0, first_order = 0,
           counting = 0, drift = 0, fixed_point = 0;
    /// Over the length of the axis (E, M, A).
    [[nodiscard]] double along() const {
        return material_scale + air + formula + first_order + counting + drift + fixed_point;
    }
    /// Between two readings at one place (B): a scale error is the same for both, but a sensor may
    /// step to its next digit between them.
    [[nodiscard]] double between() const {
        return material_step + air + counting + drift + fixed_point;
    }
    /// What no draw can hold, of R and A: the rounding to whole counts, at most half a count c of
    /// each reading. s moves by at most its own s, c/2 sqrt(n/(n-1)); R, or A over the axis, has
    /// four s and the difference of two means.
    [[nodiscard]] double rounding_um(int approaches) const {
        const double n = approaches;
        return counting * (1 + 2 * std::sqrt(n / (n - 1)));
    }
};

/// Half a step of each air quantity in index of refraction (sensitivities near 20 C).
double air_step_index(const Scenario& s) {
    const AirSteps steps = air_steps(s);
    return 0.5 * (0.94e-6 * steps.temperature_k + 2.68e-9 * steps.pressure_pa +
                  8.5e-9 * steps.humidity_percent);
}

/// Two accepted equations for n differ by at most this near 20 C, RH up to 100 %.
constexpr double equations_differ = 6e-8;

/// Behind an indexing table the laser measures the rest alone, at most half a step at each of two
/// targets; a um stands for a thousandth of a degree.
Systematic systematic_of_angle(const Scenario& s, const TableScenario& table) {
    const double rest = table.step_deg / 2 * 1e3;
    const double reflectors_um_per_mdeg = table.arm_mm * std::numbers::pi / 180.0;
    Systematic sys;
    sys.air = 2 * rest * 2 * air_step_index(s);
    sys.formula = 2 * rest * equations_differ;
    sys.counting = count_um(s.laser) / reflectors_um_per_mdeg;
    sys.drift = std::abs(s.errors.drift_um_per_hour) * s.truth.duration_s / 3600.0;
    return sys;
}

/// An autocollimator shows hundredths of a second of arc, and no air acts on what it shows.
Systematic systematic_of_polygon(const Scenario& s) {
    constexpr double shown_arcsec = 0.01, arcsec_per_mdeg = 3.6;
    Systematic sys;
    sys.counting = shown_arcsec / arcsec_per_mdeg;
    sys.drift = std::abs(s.errors.drift_um_per_hour) * s.truth.duration_s / 3600.0;
    return sys;
}

/// The scale's sensor shows its temperature in steps, and its lines move about its zero; no air
/// acts.
void replace_air_by_scale(
    Systematic& sys, const Scenario& s, double span_um, const Range& shown, const Range& material) {
    const double alpha = s.laser.scale_expansion_um_per_m_k * 1e-6;
    sys.air = sys.formula = 0;
    sys.material_scale += span_um * alpha * std::max(std::abs(shown.low), std::abs(shown.high));
    sys.material_step += span_um * alpha * shown.width();
    sys.fixed_point += std::abs(s.axis.start_mm - s.laser.zero_mm) * 1e3 * alpha * material.width();
}

Systematic systematic_of(const Scenario& s, const TruthPlan& plan) {
    if (s.indexing_table) return systematic_of_angle(s, *s.indexing_table);
    if (s.polygon) return systematic_of_polygon(s);
    const double span_um = (plan.targets_mm.back() - plan.targets_mm.front()) * 1e3;
    const double beam_um = span_um + s.laser.dead_path_mm * 1e3;
    const double alpha = s.thermal.expansion_um_per_m_k * 1e-6;
    Range shown, material, scale_shown;
    for (int i = 0; i <= 1000; ++i) {
        const Weather weather = weather_at(s, s.truth.duration_s * i / 1000.0);
        shown.put(weather.material_error_k);
        material.put(weather.material_c);
        scale_shown.put(weather.scale_error_k);
    }
    const double from_20 = std::max(std::abs(material.low - 20), std::abs(material.high - 20));
    const double off_mm = std::max(std::abs(s.axis.start_mm - s.thermal.fixed_point_mm),
                                   std::abs(plan.targets_mm.front() - s.thermal.fixed_point_mm));
    Systematic sys;
    sys.material_scale = span_um * alpha * std::max(std::abs(shown.low), std::abs(shown.high));
    sys.material_step = span_um * alpha * shown.width();
    sys.air = beam_um * 2 * air_step_index(s);
    sys.formula = span_um * equations_differ;
    sys.first_order = span_um * alpha * alpha * from_20 * from_20;
    sys.counting = count_um(s.laser);
    sys.drift = std::abs(s.errors.drift_um_per_hour) * s.truth.duration_s / 3600.0;
    sys.fixed_point = off_mm * 1e3 * alpha * material.width();
    if (s.laser.resolution_um) replace_air_by_scale(sys, s, span_um, scale_shown, material);
    return sys;
}

struct Quantiles {
    double low, median, high;
};

/// 10 000 runs of the injected process, seeded; the middle 99.9 % of each parameter.
std::map<std::string, Quantiles> draw(const Scenario& s, const TruthPlan& plan) {
    const InjectedProcess process{s, plan};
    std::map<std::string, std::vector<double>> drawn;
    for (int k = 0; k < s.truth.draws; ++k) {
        const auto run = process.draw(static_cast<std::uint64_t>(k));
        for (const auto& [key, value] : evaluate_truth(run.forward, run.backward))
            drawn[key].push_back(value);
    }
    std::map<std::string, Quantiles> quantiles;
    for (auto& [key, values] : drawn) {
        std::sort(values.begin(), values.end());
        const auto at = [&sorted = values](double share) {
            return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
        };
        quantiles[key] = {at(0.0005), at(0.5), at(0.9995)};
    }
    return quantiles;
}

/// How the noise of one capture reaches a parameter of means: its factor on sigma / sqrt(n).
double noise_factor(const std::string& key, std::size_t targets) {
    if (key == "B") return std::sqrt(2.0);                                     // B_i
    if (key == "B_mean") return std::sqrt(2.0 / static_cast<double>(targets)); // mean of B_i
    if (key == "M") return 2.0 / std::sqrt(2.0);                               // two middles
    return 2.0;                                                                // two means
}

const char* const bound_formula =
    "E, M, B, B_mean: bound = k sigma/sqrt(n) z + systematic; z = sqrt(2 ln(2 m / 0.001)) holds "
    "for all 2 m means at 99.9 %; k: E 2, M sqrt 2, B sqrt 2, B_mean sqrt(2/m); sigma^2 = "
    "approach^2 + noise^2/(window rate) + (vibration/(pi f window))^2. systematic along the axis "
    "(E, M): span alpha |shown - true| (of a linear scale its own beside it, and no air) + (span + "
    "dead path) air steps + span 6e-8 + span (alpha "
    "dT)^2 + count + drift time + fixed point; between readings at one place (B, B_mean): the "
    "material sensor's change of error in place of the scale terms. Of a rotary axis (mm stands "
    "for degree): 2 rests of half a step times (2 air steps + 6e-8) + count / (arm pi / 180) + "
    "drift time; before an autocollimator 0.01 arcsec + drift time, and the rate is that of its "
    "answers. R, A: the middle 99.9 % of the draws, in which noise, vibration, drift, the "
    "sensors' steps and the pace of the run are drawn; beside it count (1 + 2 sqrt(n/(n-1))), and "
    "for A span 6e-8 + span (alpha dT)^2: the formulas of air and of expansion are not drawn.";

bool is_between(const std::string& key) {
    return key.starts_with("B");
}

} // namespace

std::map<std::string, double> evaluate_truth(const Readings& forward_um,
                                             const Readings& backward_um) {
    std::map<std::string, double> p;
    const auto add = [&](const OneWay& way, const std::string& name) {
        p["E" + name] = way.means.width();
        p["R" + name] = way.R_um;
        p["A" + name] = way.band.width();
    };
    const OneWay up = one_way(forward_um);
    add(up, "_forward");
    if (!backward_um.empty()) {
        const OneWay down = one_way(backward_um);
        add(down, "_backward");
        add_two_way(p, up, down);
    }
    if (forward_um.front().size() < 2)
        std::erase_if(p, [](const auto& entry) {
            return entry.first.starts_with("R") || entry.first.starts_with("A");
        });
    return p;
}

nlohmann::json truth_of(const Scenario& scenario, const TruthPlan& plan) {
    if (scenario.squareness) return squareness_truth_of(scenario, plan);
    if (scenario.straightness) return straightness_truth_of(scenario, plan);
    const double sigma_um = bound_sigma_um(scenario);
    const Systematic sys = systematic_of(scenario, plan);
    const auto m = static_cast<double>(plan.targets_mm.size());
    const double z = std::sqrt(2.0 * std::log(2.0 * m / 0.001));
    const double noise_um = z * sigma_um / std::sqrt(plan.approaches);
    const auto exact =
        evaluate_truth(means_of(scenario, plan, +1),
                       plan.bidirectional ? means_of(scenario, plan, -1) : Readings{});
    nlohmann::json parameters;
    for (const auto& [key, um] : exact) {
        const double systematic = is_between(key) ? sys.between() : sys.along();
        const double bound = noise_factor(key, plan.targets_mm.size()) * noise_um + systematic;
        parameters[key] = {{"value", um * 1e-3}, {"bound", bound * 1e-3}};
    }
    if (plan.approaches > 1)
        for (const auto& [key, q] : draw(scenario, plan)) {
            if (!key.starts_with("R") && !key.starts_with("A")) continue;
            const double formulas = key.starts_with("A") ? sys.formula + sys.first_order : 0;
            const double beside = sys.rounding_um(plan.approaches) + formulas;
            parameters[key] = {{"value", q.median * 1e-3},
                               {"low", std::max(0.0, q.low - beside) * 1e-3},
                               {"high", (q.high + beside) * 1e-3},
                               {"draw_low", q.low * 1e-3},
                               {"draw_high", q.high * 1e-3}};
        }
    return {{"format", "axiscal.truth/1"},
            {"unit", "mm"},
            {"targets", plan.targets_mm},
            {"approaches", plan.approaches},
            {"draws", scenario.truth.draws},
            {"parameters", parameters},
            {"formula", bound_formula},
            {"terms_um",
             {{"sigma", sigma_um},
              {"z", z},
              {"material_scale", sys.material_scale},
              {"material_step", sys.material_step},
              {"air", sys.air},
              {"formula", sys.formula},
              {"first_order", sys.first_order},
              {"counting", sys.counting},
              {"drift", sys.drift},
              {"fixed_point", sys.fixed_point}}}};
}

} // namespace axiscal::simulate
