// What must not compile: a metric of deviations that were not brought to 20 degC, a second
// compensation, a RunAt20C made by hand. The build is the test; tests/guards/arrows.py holds who
// may include the maker.

#include "analysis/compensation/thermal_compensation.hpp"
#include "analysis/positioning/positioning_accuracy.hpp"
#include "analysis/positioning/styles.hpp"
#include "analysis/record/run_record.hpp"
#include "analysis/uncertainty/monte_carlo.hpp"

#include <concepts>
#include <gtest/gtest.h>
#include <type_traits>
#include <vector>

namespace axiscal::only_at_20C_test {
namespace {

template <class Run>
concept Evaluated = requires(const Run& run) {
    evaluate_positioning(run);
};
template <class Run>
concept EvaluatedInAStyle = requires(const Run& run) {
    evaluate_vdi_3441(run);
}
|| requires(const Run& run) {
    evaluate_raw_ranges(run);
}
|| requires(const Run& run) {
    evaluate_asme_b554_1992(run);
};
template <class Run>
concept Simulated = requires(const Run& run) {
    default_trials(run);
};
template <class Run>
concept Compensable = requires(const Run& run) {
    compensate_to_20C(run);
};
template <class Run>
concept Declarable = requires(Run run) {
    declare_at_20C(run, "a reason");
};
template <class Run>
concept Metered = Evaluated<Run> || EvaluatedInAStyle<Run> || Simulated<Run>;

using Rows = std::vector<std::vector<double>>;

// Metrics take a RunAt20C and nothing that was not compensated.
static_assert(Evaluated<RunAt20C> && EvaluatedInAStyle<RunAt20C> && Simulated<RunAt20C>);
static_assert(!Metered<RunRecord>);
static_assert(!Metered<DeviationTable>);
static_assert(!Metered<std::vector<PointRecord>>);
static_assert(!Metered<Rows>);

// Once: neither road to 20 degC takes what has been there.
static_assert(Compensable<RunRecord> && Declarable<DeviationTable>);
static_assert(!Compensable<RunAt20C> && !Declarable<RunAt20C>);
static_assert(!Declarable<RunRecord>);

// Nobody makes one by hand, out of whatever.
static_assert(!std::is_default_constructible_v<RunAt20C> && !std::is_aggregate_v<RunAt20C>);
static_assert(!std::constructible_from<RunAt20C, RunRecord>);
static_assert(!std::constructible_from<RunAt20C, DeviationTable>);
static_assert(!std::constructible_from<RunAt20C, DeviationTable, std::string>);
static_assert(!std::constructible_from<RunAt20C, std::vector<double>, Rows, Rows, std::string>);
static_assert(!std::assignable_from<RunAt20C&, DeviationTable>);
static_assert(!std::assignable_from<RunAt20C&, RunRecord>);

TEST(OnlyAt20C, AMetricTakesATableOnceItIsDeclared) {
    const DeviationTable table{{0, 100}, {{0.25, 0.75}, {0.5, 1.0}}, {}, "mm"};
    const auto declared = declare_at_20C(table, "measured at 20 degC");
    ASSERT_TRUE(declared.has_value());
    EXPECT_DOUBLE_EQ(*evaluate_positioning(*declared).parameters.E_forward, 0.25);
}

} // namespace
} // namespace axiscal::only_at_20C_test
