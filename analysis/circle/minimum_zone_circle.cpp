// Minimum zone: least (max d - min d) over the centres, d the distance of each point. Around a
// circle d is e - v . step to first order, which makes the problem one of Chebyshev: the working
// set is balanced (zone_balance.hpp), the circle moved, and so on until the bound is met; then one
// pass over all points names those that lie further out, which join the set. The bound over four
// points of the set is a bound for all points, too: where the two meet, the optimum is proven.

#include "analysis/circle/candidate_kernels.hpp"
#include "analysis/circle/circle_fit.hpp"
#include "analysis/circle/circle_start.hpp"
#include "analysis/circle/every_center.hpp"
#include "analysis/circle/zone_balance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace axiscal {
namespace {

using namespace circle;

struct Problem {
    Values x, y;
    CheckedPoints checked;
    double rounding = 0;       ///< what a gap may come from
    double longest_radius = 0; ///< beyond it the zone is a strip
};

struct Optimum {
    SeenCircle circle;
    Balance balance;
    double low = 0, high = 0; ///< distances from the circle
    [[nodiscard]] double width() const { return high - low; }
    [[nodiscard]] double gap() const { return std::max(0.0, width() - 2 * balance.half_width); }
};

/// The step, or as much of it as makes the zone of the set narrower.
bool take_step(const WorkingSet& set, Optimum& at, const Problem& problem) {
    const int most_halvings = at.gap() <= problem.rounding ? 1 : 40;
    CircleStep step = at.balance.step;
    for (int halvings = 0; halvings < most_halvings; ++halvings) {
        const SeenCircle next = moved(at.circle, step, problem.longest_radius);
        if (set.width_from(next) < at.width()) {
            at.circle = next;
            return true;
        }
        step = {step.x / 2, step.y / 2, step.inward / 2};
    }
    return false;
}

void see(WorkingSet& set, Optimum& at) {
    set.see_from(at.circle);
    const auto [low, high] = std::ranges::minmax(set.bearings(), {}, &Bearing::e);
    at.low = low.e;
    at.high = high.e;
}

void look(WorkingSet& set, Optimum& at) {
    see(set, at);
    // In a cloud a step can leave next to no radius, and directions from there have no digits.
    const double middle = (at.low + at.high) / 2;
    if (at.circle.radius < middle) {
        at.circle = swollen(at.circle, middle);
        see(set, at);
    }
    at.balance = balance(set, at.balance.places);
}

/// Where one point lies behind another, seen from the centre, these two alone balance each other
/// to first order, and yet a step aside can make the zone narrower.
bool step_aside(const WorkingSet& set, Optimum& at, const Problem& problem) {
    constexpr double no_weight = 1e-7;
    const auto light = [](double weight) { return std::fabs(weight) < no_weight; };
    if (std::ranges::none_of(at.balance.weights, light)) return false;
    constexpr int sizes = 14; // down to 4e-9 of the extent
    double size = problem.checked.box.extent();
    for (int shrunk = 0; shrunk < sizes; ++shrunk) {
        size /= 4;
        for (int direction = 0; direction < 8; ++direction) {
            const double angle = direction * 0.785398163397448;
            const CircleStep step{size * std::cos(angle), size * std::sin(angle), 0};
            const SeenCircle next = moved(at.circle, step, problem.longest_radius);
            if (set.width_from(next) >= at.width() - problem.rounding) continue;
            at.circle = next;
            return true;
        }
    }
    return false;
}

/// The local optimum of the working set, from where `at` stands.
void settle(WorkingSet& set, Optimum& at, const Problem& problem) {
    constexpr int most_steps = 300; // about 5 are needed
    for (int i = 0; i < most_steps; ++i) {
        look(set, at);
        const bool level = at.gap() <= problem.rounding / 32 || at.balance.half_width < 0;
        if (!level && take_step(set, at, problem)) continue;
        if (!step_aside(set, at, problem)) return;
    }
    look(set, at);
}

/// Points of the whole list that lie outside the zone of the set join it; `at` takes their
/// distances. False: there are none, or none new.
bool widen(WorkingSet& set, Optimum& at, const Problem& problem) {
    const SeenCircle& c = at.circle;
    const double inner = std::max(c.radius + at.low, 0.0), outer = c.radius + at.high;
    const Target target{problem.x, problem.y, c.origin_x + c.a, c.origin_y + c.b};
    bool grown = false;
    const double low = at.low, high = at.high;
    for (const std::size_t i : find_outside(target, {inner * inner, outer * outer})) {
        const double from_x = problem.x[i] - c.origin_x, from_y = problem.y[i] - c.origin_y;
        const double e = bearing_of(from_x, from_y, c).e;
        if (e <= high && e >= low) continue; // rounding of the search
        at.low = std::min(at.low, e);
        at.high = std::max(at.high, e);
        grown = set.add(i, from_x, from_y) || grown;
    }
    return grown;
}

void optimize(WorkingSet& set, Optimum& at, const Problem& problem) {
    constexpr int most_rounds = 200; // two or three are needed
    for (int round = 0; round < most_rounds; ++round) {
        settle(set, at, problem);
        if (set.size() == problem.x.size() || !widen(set, at, problem)) return;
        if (at.gap() <= problem.rounding) return;
    }
}

/// A few points evenly from the list; all, if there are few.
std::vector<std::size_t> sample_of(std::size_t points) {
    const std::size_t count = points <= 64 ? points : points < 20000 ? 32 : 96;
    std::vector<std::size_t> sample(count);
    for (std::size_t i = 0; i < count; ++i)
        sample[i] = i * points / count;
    return sample;
}

WorkingSet
set_of(const std::vector<std::size_t>& sample, const Problem& problem, const SeenCircle& circle) {
    WorkingSet set;
    for (const std::size_t i : sample)
        set.add(i, problem.x[i] - circle.origin_x, problem.y[i] - circle.origin_y);
    return set;
}

Result<SeenCircle> start_of(const Problem& problem, const std::vector<std::size_t>& sample) {
    std::vector<double> x, y;
    double sum_x = 0, sum_y = 0;
    for (const std::size_t i : sample) {
        x.push_back(problem.x[i]);
        y.push_back(problem.y[i]);
        sum_x += problem.x[i];
        sum_y += problem.y[i];
    }
    CheckedPoints checked = problem.checked;
    checked.mean_x = sum_x / static_cast<double>(sample.size());
    checked.mean_y = sum_y / static_cast<double>(sample.size());
    if (auto start = starting_circle(x, y, checked)) return start;
    return starting_circle(problem.x, problem.y, problem.checked); // of the sample alone: a line
}

Optimum optimum_from(const SeenCircle& start, const Problem& problem) {
    WorkingSet set = set_of(sample_of(problem.x.size()), problem, start);
    Optimum at;
    at.circle = start;
    optimize(set, at, problem);
    for (std::size_t& place : at.balance.places)
        place = set.index(place); // from here on indices of points
    return at;
}

constexpr double wide_zone = 0.1;
bool is_wide(const Optimum& at) {
    return at.width() > wide_zone * at.circle.radius;
}

/// Starts all over the neighbourhood, for data far from a circle.
std::vector<SeenCircle> many_starts(const Problem& problem) {
    const Box& box = problem.checked.box;
    const double extent = box.extent();
    const double x = problem.checked.mean_x, y = problem.checked.mean_y;
    std::vector<SeenCircle> starts;
    for (int i = -3; i <= 3; ++i)
        for (int j = -3; j <= 3; ++j)
            starts.push_back(seen_from(x, y, 0.2 * i * extent, 0.2 * j * extent, 0.5 * extent));
    for (const double far : {1.5, 5.0, 20.0})
        for (int k = 0; k < 8; ++k)
            starts.push_back(seen_from(x, y, far * extent * std::cos(0.785398163397448 * k),
                                       far * extent * std::sin(0.785398163397448 * k),
                                       far * extent));
    return starts;
}

/// A narrower zone near by, on the way to another optimum.
std::optional<SeenCircle> narrower_near_by(const Optimum& at, const Problem& problem) {
    WorkingSet all;
    for (std::size_t i = 0; i < problem.x.size(); ++i)
        all.append(i, problem.x[i] - at.circle.origin_x, problem.y[i] - at.circle.origin_y);
    for (const double part : {3.0, 1.0, 0.3, 0.1, 0.03})
        for (int direction = 0; direction < 16; ++direction) {
            const double size = part * at.width(), angle = direction * 0.392699081698724;
            const CircleStep step{size * std::cos(angle), size * std::sin(angle), 0};
            const SeenCircle next = moved(at.circle, step, problem.longest_radius);
            if (all.width_from(next) < at.width() - problem.rounding) return next;
        }
    return std::nullopt;
}

constexpr std::size_t few = 24; ///< up to here every centre is tried

/// Points in clumps far apart can make the steps so short that they end before the gap is closed.
void close_gap(Optimum& best, const Problem& problem) {
    const double promised = 1e-12 * std::max(best.circle.radius, problem.checked.box.magnitude());
    if (best.gap() <= promised / 2) return;
    std::vector<std::size_t> set_of_few = problem.checked.distinct;
    for (const std::size_t place : best.balance.places)
        if (std::ranges::find(set_of_few, place) == set_of_few.end()) set_of_few.push_back(place);
    const auto start =
        center_by_growing_set(problem.x, problem.y, best.circle, std::move(set_of_few));
    if (!start || start->radius > problem.longest_radius) return;
    const Optimum other = optimum_from(*start, problem);
    if (other.width() <= best.width() + problem.rounding) best = other;
}

void search_wider(Optimum& best, ZoneSearch& search, const Problem& problem) {
    std::vector<SeenCircle> starts;
    if (problem.x.size() <= few) {
        search = ZoneSearch::exhaustive;
        starts = narrowest_centers(problem.x, problem.y, best.circle.origin_x, best.circle.origin_y,
                                   best.width() + problem.rounding);
    } else if (is_wide(best)) {
        search = ZoneSearch::multi_start;
        starts = many_starts(problem);
    }
    for (const SeenCircle& start : starts) {
        if (start.radius > problem.longest_radius) continue;
        const Optimum other = optimum_from(start, problem);
        if (other.width() < best.width() - problem.rounding) best = other;
    }
    constexpr int most_moves = 50;
    for (int i = 0; i < most_moves && search == ZoneSearch::multi_start; ++i) {
        const auto next = narrower_near_by(best, problem);
        if (!next) break;
        const Optimum other = optimum_from(*next, problem);
        if (!(other.width() < best.width() - problem.rounding)) break;
        best = other;
    }
    if (search != ZoneSearch::exhaustive)
        close_gap(best, problem); // the last: a move can open it again
}

MinimumZoneCircle result_of(const Optimum& at, const Problem& problem, ZoneSearch search) {
    const SeenCircle& c = at.circle;
    MinimumZoneCircle out;
    out.x = c.origin_x + c.a;
    out.y = c.origin_y + c.b;
    out.outer_radius = c.radius + at.high;
    out.inner_radius = c.radius + at.low;
    out.width = at.width();
    out.gap = at.gap();
    for (std::size_t k = 0; k < 4; ++k)
        out.control_points.push_back(
            {at.balance.places[k], at.balance.weights[k] > 0 ? ZoneSide::outer : ZoneSide::inner});
    std::ranges::stable_sort(out.control_points, {}, &ControlPoint::index);
    out.wide = is_wide(at);
    out.strip = c.radius >= 0.999 * problem.longest_radius;
    out.search = search;
    return out;
}

/// Three points: the circle through them.
MinimumZoneCircle exact_zone(const Problem& problem, const SeenCircle& start) {
    WorkingSet set = set_of(problem.checked.distinct, problem, start);
    Optimum at;
    at.circle = start;
    settle(set, at, problem);
    const SeenCircle& c = at.circle;
    MinimumZoneCircle out;
    out.x = c.origin_x + c.a;
    out.y = c.origin_y + c.b;
    out.outer_radius = out.inner_radius = c.radius + (at.low + at.high) / 2;
    const auto& three = problem.checked.distinct;
    out.control_points = {{three[0], ZoneSide::outer},
                          {three[0], ZoneSide::inner},
                          {three[1], ZoneSide::inner},
                          {three[2], ZoneSide::outer}};
    out.search = ZoneSearch::exhaustive;
    return out;
}

Result<MinimumZoneCircle>
zone_of_distinct(Values x, Values y, const std::vector<std::size_t>& own) {
    std::vector<double> own_x, own_y;
    for (const std::size_t i : own) {
        own_x.push_back(x[i]);
        own_y.push_back(y[i]);
    }
    auto zone = fit_minimum_zone_circle(own_x, own_y);
    if (zone)
        for (ControlPoint& point : zone->control_points)
            point.index = own[point.index];
    return zone;
}

} // namespace

Result<MinimumZoneCircle> fit_minimum_zone_circle(Values x, Values y) {
    AXISCAL_TRY(CheckedPoints checked, check_points(x, y));
    // A point said again changes no zone, but it hides how few there are.
    if (const auto own = first_distinct(x, y, few + 1); own.size() <= few && own.size() < x.size())
        return zone_of_distinct(x, y, own);
    const double extent = checked.box.extent();
    const double rounding =
        4 * std::numeric_limits<double>::epsilon() * std::max(extent, checked.box.magnitude());
    const Problem problem{x, y, std::move(checked), rounding, largest_radius_in_extents * extent};
    AXISCAL_TRY(const SeenCircle start, start_of(problem, sample_of(x.size())));
    if (problem.checked.distinct.size() == 3) return exact_zone(problem, start);
    Optimum best = optimum_from(start, problem);
    ZoneSearch search = ZoneSearch::local;
    search_wider(best, search, problem);
    if (!std::isfinite(best.gap() + best.circle.radius)) return refuse_line();
    return result_of(best, problem, search);
}

} // namespace axiscal
