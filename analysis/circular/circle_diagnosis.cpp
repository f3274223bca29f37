#include "analysis/circular/circle_diagnosis.hpp"

#include "analysis/circular/cause_words.hpp"
#include "analysis/circular/contribution.hpp"
#include "analysis/circular/decomposition.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace axiscal {
namespace {

using namespace circular;

constexpr double negligible_mm = 1e-9; ///< a picometre: no cause of a form

/// All that a ranking needs to see at once.
struct Scene {
    const CircularTest& test;
    const std::vector<SeenTrace>& traces;
    const Decomposition& fitted;
    WordsContext context;
    [[nodiscard]] std::optional<std::size_t> column_of(Cause cause) const {
        const auto found = std::ranges::find(fitted.causes, cause);
        if (found == fitted.causes.end()) return {};
        return static_cast<std::size_t>(found - fitted.causes.begin());
    }
    [[nodiscard]] bool separable(Cause cause) const {
        const auto column = column_of(cause);
        return column && fitted.solution.estimable[*column];
    }
    [[nodiscard]] double effect(Cause cause, const Aspect& at) const {
        return fitted.value_of(cause) *
               effects_at(at, test.nominal_radius_mm,
                          test.feed_mm_per_s)[static_cast<std::size_t>(cause)];
    }
};

void rank_term(const Scene& scene,
               std::string name,
               const Term& term,
               double value,
               double uncertainty,
               std::string words,
               CircleDiagnosis& out) {
    const FormEffect effect = form_effect(scene.traces, term);
    const bool significant =
        std::fabs(value) > 2 * uncertainty && effect.peak_to_valley_mm > negligible_mm;
    out.ranking.push_back({std::move(name), effect.peak_to_valley_mm, effect.G_mm, effect.G_b_mm,
                           significant, std::move(words)});
}

void rank_cause(
    const Scene& scene, Cause cause, std::string name, std::string words, CircleDiagnosis& out) {
    if (!scene.separable(cause)) return;
    const CauseEstimate& estimate = out.of(cause);
    rank_term(
        scene, std::move(name), [&](const Aspect& at) { return scene.effect(cause, at); },
        *estimate.value, estimate.standard_uncertainty, std::move(words), out);
}

/// Both scales alike make no form: their difference does.
void rank_scales(const Scene& scene, CircleDiagnosis& out) {
    const auto x = scene.column_of(Cause::scale_x), y = scene.column_of(Cause::scale_y);
    if (!scene.separable(Cause::scale_x) || !scene.separable(Cause::scale_y)) return;
    const double mismatch = *out.of(Cause::scale_x).value - *out.of(Cause::scale_y).value;
    const auto& covariance = scene.fitted.solution.covariance;
    const double variance =
        covariance.empty() ? 0 : covariance[*x][*x] + covariance[*y][*y] - 2 * covariance[*x][*y];
    const double half_amplitude = scene.test.nominal_radius_mm * mismatch / 2;
    rank_term(
        scene, "scale_mismatch",
        [&](const Aspect& at) {
            return half_amplitude * (at.cosine * at.cosine - at.sine * at.sine);
        },
        mismatch, std::sqrt(std::max(variance, 0.0)),
        words_for_scale_mismatch(mismatch, scene.context), out);
}

void rank_causes(const Scene& scene, CircleDiagnosis& out) {
    const auto& fitted = scene.fitted;
    const WordsContext& words = scene.context;
    const auto value = [&](Cause cause) { return fitted.value_of(cause); };
    rank_cause(scene, Cause::squareness, "squareness",
               words_for_squareness(value(Cause::squareness), words), out);
    rank_cause(scene, Cause::servo_lag_difference, "servo_lag_difference",
               words_for_servo_lag(value(Cause::servo_lag_difference), words), out);
    rank_cause(scene, Cause::backlash_x, "backlash_x",
               words_for_backlash(0, value(Cause::backlash_x), words), out);
    rank_cause(scene, Cause::backlash_y, "backlash_y",
               words_for_backlash(1, value(Cause::backlash_y), words), out);
    rank_cause(scene, Cause::lateral_play_x, "lateral_play_x",
               words_for_lateral_play(0, value(Cause::lateral_play_x), words), out);
    rank_cause(scene, Cause::lateral_play_y, "lateral_play_y",
               words_for_lateral_play(1, value(Cause::lateral_play_y), words), out);
    rank_cause(scene, Cause::straightness_x, "straightness_x",
               words_for_straightness(0, value(Cause::straightness_x), words), out);
    rank_cause(scene, Cause::straightness_y, "straightness_y",
               words_for_straightness(1, value(Cause::straightness_y), words), out);
    rank_scales(scene, out);
    for (const CyclicError& cyclic : fitted.cyclic)
        rank_term(
            scene, cyclic.axis == 0 ? "cyclic_x" : "cyclic_y",
            [&](const Aspect& at) { return effect_of(cyclic, at, scene.test.nominal_radius_mm); },
            cyclic.amplitude_mm, cyclic.amplitude_standard_uncertainty_mm,
            words_for_cyclic(cyclic, words), out);
}

void rank_groups(const Scene& scene, CircleDiagnosis& out) {
    for (const auto& columns : scene.fitted.solution.tied) {
        InseparableGroup group;
        for (const std::size_t column : columns)
            if (column < scene.fitted.causes.size())
                group.causes.push_back(scene.fitted.causes[column]);
        const Term term = [&](const Aspect& at) {
            double sum = 0;
            for (const Cause cause : group.causes)
                sum += scene.effect(cause, at);
            return sum;
        };
        group.peak_to_valley_mm = form_effect(scene.traces, term).peak_to_valley_mm;
        rank_term(scene, "not_separable", term, 1, 0, words_for_group(group), out);
        out.not_separable.push_back(std::move(group));
    }
}

/// The largest of each kind of local feature, by its own height.
void rank_features(const Scene& scene, CircleDiagnosis& out) {
    const auto add = [&](std::string name, double height, std::string words) {
        out.ranking.push_back({std::move(name), height, height, height, true, std::move(words)});
    };
    const Reversal* spike = nullptr;
    for (const Reversal& reversal : out.reversals)
        if (reversal.spike_significant &&
            (!spike || std::fabs(reversal.spike_mm) > std::fabs(spike->spike_mm)))
            spike = &reversal;
    const ChangeOver* step = nullptr;
    for (const ChangeOver& change : out.change_overs)
        if (change.significant && (!step || std::fabs(change.step_mm) > std::fabs(step->step_mm)))
            step = &change;
    if (out.lobes) add("lobes", 2 * out.lobes->amplitude_mm, words_for_lobes(*out.lobes));
    if (spike)
        add("reversal_spikes", std::fabs(spike->spike_mm), words_for_spike(*spike, scene.context));
    if (step) add("change_over", std::fabs(step->step_mm), words_for_change_over(*step));
    if (out.vibration && out.vibration->peak_to_valley_mm > negligible_mm)
        add("vibration", out.vibration->peak_to_valley_mm, words_for_vibration(*out.vibration));
}

void take_estimates(const Scene& scene, CircleDiagnosis& out) {
    const Decomposition& fitted = scene.fitted;
    for (std::size_t i = 0; i < fitted.causes.size(); ++i) {
        CauseEstimate& estimate = out.causes[static_cast<std::size_t>(fitted.causes[i])];
        if (!fitted.solution.estimable[i]) continue;
        estimate.value = fitted.solution.value[i];
        estimate.standard_uncertainty = fitted.solution.standard_uncertainty(i);
    }
    out.rank = fitted.solution.rank;
    out.columns = fitted.solution.value.size();
    out.condition = fitted.solution.condition;
    out.residual_rms_mm = fitted.rms_mm;
    out.reversals_masked = fitted.masked;
    out.cyclic = fitted.cyclic;
}

std::optional<CommonLag> common_lag_of(const CircularTest& test, const CircleDiagnosis& out) {
    const auto& x = out.of(Cause::scale_x).value;
    const auto& y = out.of(Cause::scale_y).value;
    if (!x || !y) return {};
    const double radius = test.nominal_radius_mm, turning = test.feed_mm_per_s / radius;
    CommonLag lag{radius * (*x + *y) / 2, {}};
    if (lag.radius_change_mm <= 0)
        lag.longest_s = std::sqrt(-2 * lag.radius_change_mm / radius) / turning;
    return lag;
}

/// Both ends of the travel: within 8 deg of where the axis turns.
std::array<bool, 2> whole_travel(const std::vector<SeenTrace>& traces) {
    double low_x = 1, high_x = -1, low_y = 1, high_y = -1;
    for (const SeenTrace& trace : traces)
        for (const SeenPoint& point : trace.points) {
            low_x = std::min(low_x, point.aspect.cosine);
            high_x = std::max(high_x, point.aspect.cosine);
            low_y = std::min(low_y, point.aspect.sine);
            high_y = std::max(high_y, point.aspect.sine);
        }
    constexpr double near = 0.99;
    return {low_x < -near && high_x > near, low_y < -near && high_y > near};
}

} // namespace

Result<CircleDiagnosis> diagnose_circle(const CircularTest& test, const AxisNames& axes) {
    AXISCAL_CHECK(check_circular_test(test));
    const double radius = test.nominal_radius_mm, feed = test.feed_mm_per_s;
    const std::vector<SeenTrace> traces = see(test);
    const Decomposition fitted = decompose(traces, radius, feed);
    const Scene scene{test, traces, fitted, {axes, radius, whole_travel(traces)}};
    CircleDiagnosis out;
    take_estimates(scene, out);
    out.common_lag = common_lag_of(test, out);
    const auto left = residuals_of(fitted, traces, radius, feed);
    const ResidualScale scale = scale_of(left, radius);
    out.lobes = find_lobes(left, scale);
    out.reversals = find_reversals(left, scale, radius, feed);
    out.change_overs = find_change_overs(left, scale);
    out.vibration = find_vibration(left);
    rank_causes(scene, out);
    rank_groups(scene, out);
    rank_features(scene, out);
    std::ranges::stable_sort(out.ranking, std::ranges::greater{}, &CauseContribution::G_mm);
    return out;
}

} // namespace axiscal
