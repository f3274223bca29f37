#include "analysis/setup/setup_findings.hpp"

#include "analysis/setup/course_fit.hpp"
#include "analysis/setup/setup_words.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

namespace axiscal {
namespace {

constexpr double known_to_um = 0.02;
constexpr int fewest_points = 20;
/// Another explanation is named beside the best one where the odds are less than 20 to 1.
constexpr double near_log_odds = 3.0;

enum class Nuisance : std::uint8_t { none, drift, bent_drift, drift_and_growth };
constexpr std::array nuisances{Nuisance::none, Nuisance::drift, Nuisance::bent_drift,
                               Nuisance::drift_and_growth};

constexpr double worst_score = std::numeric_limits<double>::lowest();

/// One explanation of the readings.
struct Model {
    Nuisance nuisance = Nuisance::none;
    SetupError error = SetupError::growth; ///< of a model without one nobody asks
    std::size_t step_at = 0;               ///< of a moved optic: index of the first point behind it
    double score = worst_score;
    CourseFit fit; ///< the error's coefficient is the last one
};

double range_of(const CourseColumn& column) {
    const auto [low, high] = std::ranges::minmax(column);
    return high - low;
}

/// From the datum to the farthest target.
double longest_m(const RunCourse& course) {
    double longest = 0;
    for (const CoursePoint& point : course.points)
        longest = std::max(longest, std::fabs(point.distance_m));
    return longest;
}

/// Columns that every model draws from, each beside its cell means.
class Columns {
public:
    explicit Columns(const RunCourse& course)
        : course_{course}
        , deviation_um_{of([](const CoursePoint& p) { return p.deviation_um; })}
        , time_{of([this](const CoursePoint& p) { return hours(p); })}
        , time_squared_{of([this](const CoursePoint& p) { return hours(p) * hours(p); })}
        , growth_{of([this](const CoursePoint& p) { return hours(p) * p.distance_m; })}
        , index_{of([](const CoursePoint& p) { return p.index_ppm; })}
        , expansion_{of([](const CoursePoint& p) { return p.distance_m * p.material_K; })} {}

    [[nodiscard]] const CourseColumn& deviation_um() const { return deviation_um_; }
    [[nodiscard]] std::vector<const CourseColumn*> of_nuisance(Nuisance nuisance) const {
        switch (nuisance) {
        case Nuisance::none: return {};
        case Nuisance::drift: return {&time_};
        case Nuisance::bent_drift: return {&time_, &time_squared_};
        case Nuisance::drift_and_growth: return {&time_, &growth_};
        }
        return {};
    }
    /// Of an error without a time of its own.
    [[nodiscard]] const CourseColumn& of_error(SetupError error) const {
        return error == SetupError::dead_path ? index_ : expansion_;
    }
    [[nodiscard]] CourseColumn step_at(std::size_t first_behind) const {
        CourseColumn column(course_.points.size(), 0.0);
        std::fill(column.begin() + static_cast<std::ptrdiff_t>(first_behind), column.end(), 1.0);
        return beside_cell_means(course_, std::move(column));
    }
    /// What one um/(m h) makes of the farthest target from the first reading to the last.
    [[nodiscard]] double growth_range() const {
        const double hours_long = hours(course_.points.back()) - hours(course_.points.front());
        return longest_m(course_) * hours_long;
    }

private:
    template <typename Value> [[nodiscard]] CourseColumn of(Value value) const {
        CourseColumn column;
        column.reserve(course_.points.size());
        for (const CoursePoint& point : course_.points)
            column.push_back(value(point));
        return beside_cell_means(course_, std::move(column));
    }
    [[nodiscard]] static double hours(const CoursePoint& point) { return point.seconds / 3600; }

    const RunCourse& course_;
    CourseColumn deviation_um_, time_, time_squared_, growth_, index_, expansion_;
};

int cells_of(const RunCourse& course) {
    std::set<int> cells;
    for (const CoursePoint& point : course.points)
        cells.insert(point.cell);
    return static_cast<int>(cells.size());
}

/// Fits and compares models of one course.
class Search {
public:
    explicit Search(const RunCourse& course)
        : course_{course}
        , columns_{course}
        , freedom_{static_cast<int>(course.points.size()) - cells_of(course)} {}

    /// What is the machine's or the room's alone.
    [[nodiscard]] Model without_error() const {
        Model best;
        for (const Nuisance nuisance : {Nuisance::none, Nuisance::drift, Nuisance::bent_drift})
            keep_better(best, fitted({nuisance, SetupError::growth, 0, worst_score, {}}, nullptr));
        return best;
    }
    [[nodiscard]] Model grown() const {
        return fitted({Nuisance::drift_and_growth, SetupError::growth, 0, worst_score, {}},
                      nullptr);
    }
    /// Of a dead path or an expansion.
    [[nodiscard]] Model with(SetupError error) const {
        Model best;
        for (const Nuisance nuisance : nuisances)
            keep_better(best,
                        fitted({nuisance, error, 0, worst_score, {}}, &columns_.of_error(error)));
        return best;
    }
    [[nodiscard]] Model with_step() const {
        Model best;
        for (std::size_t i = 2; i + 1 < course_.points.size(); ++i) {
            const CourseColumn step = columns_.step_at(i);
            for (const Nuisance nuisance : nuisances)
                keep_better(best,
                            fitted({nuisance, SetupError::moved_optic, i, worst_score, {}}, &step));
        }
        return best;
    }
    [[nodiscard]] const Columns& columns() const { return columns_; }

private:
    static void keep_better(Model& best, Model candidate) {
        if (candidate.score > best.score) best = std::move(candidate);
    }
    [[nodiscard]] Model fitted(Model model, const CourseColumn* error) const {
        auto columns = columns_.of_nuisance(model.nuisance);
        const std::size_t asked = columns.size() + (model.error == SetupError::moved_optic ? 2 : 0);
        if (error != nullptr) columns.push_back(error);
        model.fit = fit_course(columns_.deviation_um(), columns, freedom_);
        if (!model.fit.solvable) return model;
        const double left = model.fit.residual_um2 / freedom_ + known_to_um * known_to_um;
        const double coefficients = static_cast<double>(asked + (error != nullptr ? 1 : 0));
        model.score = -0.5 * freedom_ * std::log(left) - 0.5 * coefficients * std::log(freedom_);
        return model;
    }

    const RunCourse& course_;
    Columns columns_;
    int freedom_;
};

bool tells_enough(const RunCourse& course) {
    const int points = static_cast<int>(course.points.size());
    return points >= fewest_points && points >= 2 * cells_of(course);
}

double range_of(const SetupFinding& finding, const Search& search) {
    const double size = std::fabs(finding.value);
    switch (finding.error) {
    case SetupError::moved_optic: return size;
    case SetupError::growth: return size * search.columns().growth_range();
    case SetupError::dead_path:
    case SetupError::expansion: return size * range_of(search.columns().of_error(finding.error));
    case SetupError::frozen_air:
    case SetupError::sensor_in_air: break; // no sensor is searched here
    }
    return 0;
}

SetupFinding finding_of(const Model& model, const Search& search, const RunCourse& course) {
    SetupFinding finding;
    finding.error = model.error;
    finding.value = model.fit.coefficients.back();
    finding.standard_uncertainty = model.fit.standard_uncertainties.back();
    finding.range_um = range_of(finding, search);
    if (finding.error == SetupError::moved_optic)
        finding.from = course.points[model.step_at].planned;
    return finding;
}

/// A little growth is in every good run: it stands against whatever is no growth itself, and an
/// expansion is growth by another name.
double rival_of(const Model& best, const Search& search) {
    const double none = search.without_error().score;
    const bool is_growth = best.error == SetupError::growth || best.error == SetupError::expansion;
    return is_growth ? none : std::max(none, search.grown().score);
}

bool exceeds_growth(const SetupFinding& finding,
                    const RunCourse& course,
                    const SetupLimits& limits) {
    return finding.range_um > longest_m(course) * limits.growth_um_per_m;
}

bool is_worth_telling(const SetupFinding& finding,
                      const RunCourse& course,
                      const SetupLimits& limits) {
    if (finding.range_um < limits.least_range_um) return false;
    switch (finding.error) {
    case SetupError::moved_optic: return true;
    case SetupError::dead_path: return std::fabs(finding.value) > limits.dead_path_m;
    case SetupError::expansion: {
        const bool may_be_growth =
            std::ranges::find(finding.or_else, SetupError::growth) != finding.or_else.end();
        return std::fabs(finding.value) * 1e-6 > limits.expansion_per_K &&
               (!may_be_growth || exceeds_growth(finding, course, limits));
    }
    case SetupError::growth: return exceeds_growth(finding, course, limits);
    case SetupError::frozen_air:
    case SetupError::sensor_in_air: break;
    }
    return false;
}

} // namespace

std::string_view name_of(SetupError error) {
    switch (error) {
    case SetupError::moved_optic: return "moved_optic";
    case SetupError::dead_path: return "dead_path";
    case SetupError::expansion: return "expansion";
    case SetupError::growth: return "growth";
    case SetupError::frozen_air: return "frozen_air";
    case SetupError::sensor_in_air: return "sensor_in_air";
    }
    return "";
}

SetupLimits limits_of(const RunRecord& run) {
    SetupLimits limits;
    if (run.material.standard_uncertainty)
        limits.expansion_per_K = 2 * run.material.standard_uncertainty->si();
    if (run.uncertainty && run.uncertainty->temperature_width)
        limits.growth_um_per_m =
            (run.material.coefficient * *run.uncertainty->temperature_width).si() * 1e6;
    return limits;
}

std::optional<SetupFinding> find_setup_error(const RunCourse& course, const SetupLimits& limits) {
    if (!tells_enough(course)) return std::nullopt;
    const Search search{course};
    std::vector<Model> models{search.with_step(), search.with(SetupError::dead_path),
                              search.with(SetupError::expansion), search.grown()};
    std::ranges::sort(models, std::ranges::greater{}, &Model::score);
    const Model& best = models.front();
    const double log_odds = best.score - rival_of(best, search);
    if (!(log_odds > limits.least_log_odds)) return std::nullopt;
    SetupFinding finding = finding_of(best, search, course);
    finding.log_odds = log_odds;
    for (const Model& other : models)
        if (other.error != best.error && best.score - other.score < near_log_odds)
            finding.or_else.push_back(other.error);
    // Too much compensated: by the coefficient, or by a sensor that swings more than the machine.
    if (finding.error == SetupError::expansion && finding.value < 0)
        finding.or_else.push_back(SetupError::sensor_in_air);
    if (!is_worth_telling(finding, course, limits)) return std::nullopt;
    put_into_words(finding);
    return finding;
}

} // namespace axiscal
