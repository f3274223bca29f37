#include "analysis/uncertainty/run_uncertainty.hpp"

#include "analysis/uncertainty/calibrated_terms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

namespace axiscal {
namespace {

struct NeededTerm {
    const char* name;
    const char* words;
};
constexpr std::array needed_terms{
    NeededTerm{"device", "the expanded uncertainty of the laser system"},
    NeededTerm{"alignment", "the misalignment of the beam"},
    NeededTerm{"temperature", "the width of the material's temperature"},
    NeededTerm{"expansion", "the width of the expansion coefficient"},
    NeededTerm{"drift", "E_VE of a drift test"}};
constexpr std::array needed_terms_of_scale{
    NeededTerm{"device", "the expanded uncertainty of the scale"},
    NeededTerm{"alignment", "the misalignment of the scale"},
    needed_terms[2],
    needed_terms[3],
    needed_terms[4],
    NeededTerm{"scale temperature", "the width of the scale's temperature"},
    NeededTerm{"scale expansion", "the standard uncertainty of the scale's expansion coefficient"}};

std::optional<double> over_length(const DeviceLimit& limit, double length_m) {
    if (!limit.stated()) return std::nullopt;
    const double fixed_um = limit.fixed ? limit.fixed->in(um) : 0;
    return limit.per_length ? fixed_um + limit.per_length->in(ppm)*length_m : fixed_um;
}

template <class Amount, class Unit>
std::optional<double> number_of(const std::optional<Amount>& amount, Unit unit) {
    return amount ? std::optional{amount->in(unit)} : std::nullopt;
}

/// Of the machine's material, or of the scale that measures it.
std::optional<double> largest_offset_of(const RunRecord& run, bool of_scale) {
    std::optional<double> largest;
    for (const ChannelRecord& channel : run.channels) {
        if (channel.kind != ChannelKind::temperature || channel.medium != Medium::material ||
            sits_on_scale(run, channel.id) != of_scale)
            continue;
        for (const EnvironmentReading& reading : run.environment)
            if (reading.channel == channel.id)
                largest = std::max(largest.value_or(0),
                                   std::fabs(reading.value - reference_temperature.in_celsius()));
    }
    return largest;
}

/// Full width of the coefficient, um/(m K).
std::optional<double> expansion_width_of(const RunRecord& run, std::vector<std::string>& remarks) {
    if (run.uncertainty && run.uncertainty->expansion_width)
        return run.uncertainty->expansion_width->in(um_per_m_kelvin);
    if (!run.material.standard_uncertainty) return std::nullopt;
    const double u = run.material.standard_uncertainty->in(um_per_m_kelvin);
    const double width = 2 * std::sqrt(3.0) * u;
    std::array<char, 160> text{};
    std::snprintf(text.data(), text.size(),
                  "Uncertainty: the width of the expansion coefficient is not stated; taken as "
                  "2 \u221A3 u = %.2f \u00B5m/(m\u00B7K) of its u = %.2f.",
                  width, u);
    remarks.emplace_back(text.data());
    return width;
}

/// Of a rotary axis the device holds interferometer, artefact, optics and set-up; lengths stand for
/// degrees.
UncertaintyStatement statement_of_angle(const UncertaintySetup& setup) {
    UncertaintyStatement s;
    s.axis_kind = AxisKind::rotary;
    if (setup.device_U.fixed) s.device_U = arcsec_of(*setup.device_U.fixed);
    if (s.device_U) s.device_k = setup.device_k;
    if (setup.device_width.fixed) s.device_width = arcsec_of(*setup.device_width.fixed);
    if (setup.eve) s.eve = arcsec_of(*setup.eve);
    s.eve_model = setup.eve_model;
    return s;
}

/// A scale grows by its own temperature.
void add_scale(UncertaintyStatement& s, const RunRecord& run, std::vector<std::string>& remarks) {
    const ScaleSetup& scale = *run.scale;
    s.device_alpha_um_per_m_K = scale.coefficient.in(um_per_m_kelvin);
    s.device_temperature_width_K = number_of(scale.temperature_width, kelvin);
    if (!s.device_temperature_width_K)
        s.device_temperature_width_K = calibrated_scale_width_K(run, remarks);
    s.device_temperature_offset_K = largest_offset_of(run, true);
    if (scale.standard_uncertainty)
        s.device_alpha_width_um_per_m_K =
            2 * std::sqrt(3.0) * scale.standard_uncertainty->in(um_per_m_kelvin);
}

/// Between the outermost targets in use.
Length span_of(const RunPlan& plan, const std::vector<int>& targets) {
    const auto place = [&](int i) { return plan.targets[static_cast<std::size_t>(i)]; };
    const auto [low, high] = std::ranges::minmax(targets, {}, place);
    return place(high) - place(low);
}

UncertaintyStatement statement_of(const RunRecord& run,
                                  const std::vector<int>& targets,
                                  std::vector<std::string>& remarks) {
    const UncertaintySetup setup = run.uncertainty.value_or(UncertaintySetup{});
    if (run.plan.axis_kind == AxisKind::rotary) return statement_of_angle(setup);
    UncertaintyStatement s;
    s.axis_kind = run.plan.axis_kind;
    s.length_m = span_of(run.plan, targets).in(metre);
    s.device_U = over_length(setup.device_U, *s.length_m);
    if (s.device_U) s.device_k = setup.device_k;
    s.device_width = over_length(setup.device_width, *s.length_m);
    if (!s.device_U && !s.device_width) {
        s.device_U = calibrated_device_um(run, *s.length_m, remarks);
        if (s.device_U) s.device_k = calibrated_k;
    }
    s.misalignment_mm = number_of(setup.misalignment, mm);
    s.misalignment_rad = number_of(setup.misalignment_angle, radian);
    s.alpha_um_per_m_K = run.material.coefficient.in(um_per_m_kelvin);
    s.temperature_width_K = number_of(setup.temperature_width, kelvin);
    if (!s.temperature_width_K)
        s.temperature_width_K = calibrated_temperature_width_K(run, remarks);
    s.temperature_offset_K = largest_offset_of(run, false);
    s.alpha_width_um_per_m_K = expansion_width_of(run, remarks);
    s.eve = number_of(setup.eve, um);
    s.eve_model = setup.eve_model;
    if (run.scale) add_scale(s, run, remarks);
    return s;
}

/// A U without one of its terms would be too small: R and B need the environment, the others all.
void drop_incomplete(UncertaintyBudget& budget, bool all) {
    const bool drift = budget.find(UncertaintyTerm::environment) != nullptr;
    std::erase_if(budget.parameters, [&](const ParameterUncertainty& figure) {
        return !drift || (figure.systematic != 0 && !all);
    });
}

std::vector<MissingTerm> missing_terms_of(const UncertaintyStatement& s, bool by_scale) {
    if (s.axis_kind == AxisKind::rotary) {
        std::vector<MissingTerm> missing;
        if (!s.device_U && !s.device_width)
            missing.push_back({"device", "the expanded uncertainty of instrument and artefact"});
        if (!s.eve) missing.push_back({"drift", "E_VE of a drift test"});
        return missing;
    }
    const std::array stated{s.device_U || s.device_width,
                            s.misalignment_mm || s.misalignment_rad,
                            s.temperature_width_K.has_value(),
                            s.alpha_width_um_per_m_K.has_value(),
                            s.eve.has_value(),
                            s.device_temperature_width_K.has_value(),
                            s.device_alpha_width_um_per_m_K.has_value()};
    const std::span<const NeededTerm> needed =
        by_scale ? std::span<const NeededTerm>{needed_terms_of_scale} : needed_terms;
    std::vector<MissingTerm> missing;
    for (std::size_t i = 0; i < needed.size(); ++i)
        if (!stated[i]) missing.push_back({needed[i].name, needed[i].words});
    return missing;
}

/// The ends of an interval of 95 % are then known to about a hundredth of its width.
constexpr int most_trials_of_truth = 20'000;

/// When each reading was taken, s: rows of the targets in use, forward, then backward.
std::vector<double>
seconds_of_readings(const RunRecord& run, const std::vector<int>& targets, bool both_directions) {
    std::vector<const PointRecord*> points;
    for (const PointRecord& point : run.points)
        if ((both_directions || point.planned.direction == Direction::positive) &&
            std::ranges::find(targets, point.planned.target_index) != targets.end())
            points.push_back(&point);
    std::ranges::stable_sort(points, {}, [](const PointRecord* point) {
        return std::tuple{point->planned.direction == Direction::negative,
                          point->planned.target_index, point->planned.approach};
    });
    std::vector<double> seconds;
    seconds.reserve(points.size());
    for (const PointRecord* point : points)
        seconds.push_back(seconds_of(point->window_begin - run.points.front().window_begin));
    return seconds;
}

/// A number that a JSON reader with doubles keeps: below 2^53.
std::uint64_t simulation_seed_of(const RunRecord& run) {
    constexpr std::uint64_t fnv_offset = 0xcbf29ce484222325, fnv_prime = 0x100000001b3;
    constexpr std::uint64_t kept = (std::uint64_t{1} << 53) - 1;
    if (run.plan.seed) return *run.plan.seed & kept;
    std::uint64_t hash = fnv_offset;
    for (const char c : run.run_id)
        hash = (hash ^ static_cast<unsigned char>(c)) * fnv_prime;
    return hash & kept;
}

} // namespace

RunUncertainty uncertainty_of(const RunRecord& run, double edition_k) {
    ReadingsInUse all{run.plan.approaches, std::vector<int>(run.plan.targets.size())};
    std::iota(all.targets.begin(), all.targets.end(), 0);
    return uncertainty_of(run, edition_k, all);
}

RunUncertainty uncertainty_of(const RunRecord& run, double edition_k, const ReadingsInUse& used) {
    RunUncertainty out;
    std::vector<std::string> remarks;
    if (!used.targets.empty()) out.statement = statement_of(run, used.targets, remarks);
    out.missing = missing_terms_of(out.statement, run.scale.has_value());
    if (!run.uncertainty || run.imported) return out;
    if (used.approaches < run.plan.approaches)
        remarks.push_back(
            "Uncertainty: the budget is made with n = " + std::to_string(used.approaches) +
            ", the fewest readings that remain of a target and direction.");
    out.remarks = std::move(remarks);
    auto budget = make_budget(out.statement, used.approaches, static_cast<int>(used.targets.size()),
                              edition_k);
    if (!budget) {
        out.missing.push_back(
            {"budget", "a budget (" + budget.error().field + " " + budget.error().detail + ")"});
        return out;
    }
    // The budget knows of a scale's own terms only where they are stated.
    drop_incomplete(*budget, budget->not_stated.empty() && out.missing.empty());
    out.budget = *std::move(budget);
    return out;
}

void simulate_run(RunUncertainty& known,
                  const RunRecord& run,
                  const RunAt20C& deviations,
                  const PositioningResult& result,
                  const std::vector<int>& targets) {
    if (!known.budget || known.budget->parameters.empty()) return;
    SessionErrors errors = session_errors(*known.budget, budget_units_per(result.unit));
    if (run.scale) // it reads short or long, by how it is mounted
        for (SessionErrors::Common& common : errors.common)
            common.one_sided = false;
    const auto without_budget = [&](const auto& figure) {
        return known.budget->find(figure.key) == nullptr;
    };
    const MonteCarloRequest request{default_trials(deviations), simulation_seed_of(run)};
    auto simulated = simulate_sessions(deviations, result, errors, request);
    if (!simulated) return; // too many readings to simulate: the formulas stand alone
    std::erase_if(simulated->figures, without_budget);
    known.simulation = *std::move(simulated);
    auto lies_in =
        simulate_true_figures(deviations, result, errors,
                              seconds_of_readings(run, targets, !deviations.backward().empty()),
                              {std::min(request.trials, most_trials_of_truth), request.seed});
    if (!lies_in) return; // readings that are not those of the run's points
    std::erase_if(lies_in->figures, without_budget);
    known.true_figures = *std::move(lies_in);
}

double in_budget_units(const RunRecord& run, Length amount) {
    return run.plan.axis_kind == AxisKind::rotary ? arcsec_of(amount) : amount.in(um);
}

const TargetUncertainty* target_uncertainty_of(const RunRecord& run, std::string_view parameter) {
    if (!run.uncertainty) return nullptr;
    const auto& targets = run.uncertainty->targets;
    const auto found = std::ranges::find(targets, parameter, &TargetUncertainty::parameter);
    return found == targets.end() ? nullptr : &*found;
}

} // namespace axiscal
