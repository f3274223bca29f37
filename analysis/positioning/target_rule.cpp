#include "analysis/positioning/target_rule.hpp"

#include "analysis/positioning/sums.hpp"

#include <array>
#include <cmath>
#include <sstream>

namespace axiscal {
namespace {

/// Decimal coordinates in binary: what may lie beyond a limit and still belong to it.
constexpr double rounding = 1e-6;

std::string plain(double number) {
    std::ostringstream text;
    text.precision(6);
    text << number;
    return text.str();
}

std::string with_unit(AxisKind kind, double number) {
    return plain(number) + (kind == AxisKind::linear ? " mm" : " degrees");
}

TargetRule linear_rule(double travel) {
    TargetRule rule;
    rule.long_axis = travel > short_linear_travel + rounding;
    if (rule.long_axis) {
        rule.largest_mean_interval = long_linear_interval;
        rule.approaches = 1;
        return rule;
    }
    rule.least_targets = std::max(5, static_cast<int>(std::ceil(5 * (travel - rounding) / 1000.0)));
    return rule;
}

TargetRule rotary_rule(double travel) {
    TargetRule rule;
    rule.largest_mean_interval = rotary_interval;
    rule.long_axis = travel > short_rotary_travel + rounding;
    if (rule.long_axis) {
        rule.approaches = 1;
        return rule;
    }
    const double degrees = travel - rounding;
    rule.least_targets = degrees <= 90 ? 3 : degrees <= 180 ? 5 : 8;
    return rule;
}

/// Width of P_i - i p: twice the largest |r| that the best begin leaves.
double scatter_about(const std::vector<double>& ascending, double interval) {
    Span span;
    for (std::size_t i = 0; i < ascending.size(); ++i)
        span.include(ascending[i] - ascending.front() - static_cast<double>(i) * interval);
    return span.width();
}

/// max|r| / p = width(P_i / p - i) / 2 is convex in q = 1/p: ternary search between a grid of half
/// and of twice the mean step.
double evenest_interval(const std::vector<double>& ascending) {
    const double mean_step =
        (ascending.back() - ascending.front()) / static_cast<double>(ascending.size() - 1);
    double low = 0.5 / mean_step, high = 2 / mean_step;
    const auto share = [&](double q) { return q * scatter_about(ascending, 1 / q); };
    for (int k = 0; k < 80; ++k) {
        const double a = low + (high - low) / 3, b = high - (high - low) / 3;
        if (share(a) <= share(b))
            high = b;
        else
            low = a;
    }
    return 2 / (low + high);
}

void judge_counts(const TargetQuestion& question, TargetFinding& finding) {
    const auto& rule = finding.rule;
    const auto count = static_cast<int>(question.targets.size());
    if (count < rule.least_targets)
        finding.breaches.push_back(std::to_string(count) + " targets on " +
                                   with_unit(question.kind, finding.travel) + ": at least " +
                                   std::to_string(rule.least_targets) + " are asked for");
    if (rule.largest_mean_interval && count > 1 &&
        finding.mean_interval > *rule.largest_mean_interval + rounding)
        finding.breaches.push_back("the mean interval of " +
                                   with_unit(question.kind, finding.mean_interval) + " exceeds " +
                                   with_unit(question.kind, *rule.largest_mean_interval));
    if (question.approaches < rule.approaches)
        finding.breaches.push_back(std::to_string(question.approaches) +
                                   " approaches a direction: " + std::to_string(rule.approaches) +
                                   " are asked for at this travel");
    if (rule.long_axis && question.approaches > 1)
        finding.remarks.push_back(
            "one approach a direction is what a travel of this length asks for; " +
            std::to_string(question.approaches) + " were made");
}

void judge_random_part(const TargetQuestion& question, TargetFinding& finding) {
    constexpr double rounding_share = 1e-9, visible_share = 1e-3;
    if (!finding.grid) return;
    const double share = finding.grid->random_share;
    if (share > random_part_of_interval + rounding_share)
        finding.breaches.push_back(
            "the targets stray by " + plain(100 * share) + " % of the interval of " +
            with_unit(question.kind, finding.grid->interval) + ": at most 30 % are allowed");
    else if (share < visible_share && question.kind == AxisKind::linear)
        finding.remarks.push_back("the targets stand evenly: an error whose period divides " +
                                  with_unit(question.kind, finding.grid->interval) + " hides");
}

/// Principal positions that the targets reach over and do not hold.
void judge_principal_positions(const std::vector<double>& ascending, TargetFinding& finding) {
    std::string missing;
    const double first = 90 * std::ceil((ascending.front() - rounding) / 90);
    constexpr int most = 5; // within the 360 degrees of a short axis
    for (int quarter = 0; quarter < most; ++quarter) {
        const double place = first + 90.0 * quarter;
        if (place > ascending.back() + rounding) break;
        const auto near = std::ranges::find_if(
            ascending, [&](double target) { return std::fabs(target - place) <= rounding; });
        if (near == ascending.end()) missing += (missing.empty() ? "" : ", ") + plain(place);
    }
    if (!missing.empty())
        finding.remarks.push_back("no target at the principal positions " + missing + " degrees");
}

} // namespace

TargetRule target_rule_for(AxisKind kind, double travel) {
    return kind == AxisKind::linear ? linear_rule(travel) : rotary_rule(travel);
}

TargetGrid grid_of(const std::vector<double>& ascending, std::optional<double> stated_interval) {
    TargetGrid grid;
    grid.interval = stated_interval ? *stated_interval : evenest_interval(ascending);
    grid.random_share = scatter_about(ascending, grid.interval) / 2 / grid.interval;
    return grid;
}

Result<TargetFinding> judge_targets(const TargetQuestion& question) {
    if (question.targets.empty()) return refuse(Fault::bad_case, "targets", "is empty");
    if (question.interval && *question.interval <= 0)
        return refuse(Fault::bad_case, "interval", "must be greater than 0");
    auto ascending = question.targets;
    std::ranges::sort(ascending);
    const double reach = ascending.back() - ascending.front();
    TargetFinding finding;
    finding.travel = question.travel.value_or(reach);
    if (finding.travel < reach - rounding)
        return refuse(Fault::bad_case, "travel",
                      plain(finding.travel) + " is less than the targets reach over, " +
                          plain(reach));
    finding.rule = target_rule_for(question.kind, finding.travel);
    if (ascending.size() > 1)
        finding.mean_interval = reach / static_cast<double>(ascending.size() - 1);
    if (ascending.size() > 2 && reach > rounding)
        finding.grid = grid_of(ascending, question.interval);
    judge_counts(question, finding);
    judge_random_part(question, finding);
    if (question.kind == AxisKind::rotary && !finding.rule.long_axis)
        judge_principal_positions(ascending, finding);
    return finding;
}

} // namespace axiscal
