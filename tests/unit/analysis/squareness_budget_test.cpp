#include "analysis/squareness/squareness_budget.hpp"

#include "tests/unit/analysis/square_machine.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace axiscal::squareness_budget_test {
namespace {

using testing::equal_steps;
using testing::first_line;
using testing::second_line;
using testing::SquareMachine;

const std::vector<double> first_places = equal_steps(5, 100), second_places = equal_steps(11, 100);

/// A straight line of 5 readings each way, of the first axis or of the second.
RecordedLine straight(const std::vector<double>& places_mm, double slope, const char* run_id) {
    RecordedLine line{run_id, {}, {}, 5, {}, {}};
    for (const double place : places_mm)
        line.rows.push_back({mm(place), mm(slope * place), mm(slope * place)});
    return line;
}

/// Everything is stated; both axes close by 20 urad.
SquarenessSetup stated() {
    SquarenessSetup setup;
    setup.first = straight(first_places, 2e-5, "X");
    setup.optics.factor = 36;
    setup.optics.resolution = nm(10);
    setup.optics.uncertainty.factor_U = percent(1);
    setup.optics.uncertainty.mirror_limit_um_per_m2 = 0.15;
    setup.optics.uncertainty.eve = um(1.2);
    setup.stated.error = radian(0);
    setup.stated.error_U = radian(4e-6);
    setup.stated.mount_limit = radian(1e-6);
    return setup;
}

SquarenessSetup reversed(const char* run_id_of_first) {
    SquarenessSetup setup = stated();
    setup.other = OtherSquare{straight(first_places, 2e-5, run_id_of_first),
                              straight(second_places, 2e-5, "Y")};
    return setup;
}

Result<SquarenessBudget>
made(const SquarenessSetup& setup, int readings_a_mean = 5, double scatter_um = 0) {
    AXISCAL_TRY(const StraightnessLine second, line_of(straight(second_places, 2e-5, "")));
    AXISCAL_TRY(const SquarenessFigures figures, evaluate_squareness(second, setup));
    return make_squareness_budget(figures, setup, readings_a_mean, scatter_um);
}

SquarenessBudget
budget_of(const SquarenessSetup& setup, int readings_a_mean = 5, double scatter_um = 0) {
    const auto budget = made(setup, readings_a_mean, scatter_um);
    EXPECT_TRUE(budget) << describe(budget.error());
    return budget.value_or(SquarenessBudget{});
}

double u_of(const SquarenessBudget& budget, SquarenessTerm term) {
    const auto found = std::ranges::find(budget.contributions, term, &SquarenessContribution::term);
    return found == budget.contributions.end() ? std::nan("") : found->u_rad;
}

// Expected numbers of this file: a script of exact fractions and of the formulas in the header,
// with five places and eleven, 100 mm apart, a = 0.15 um/m^2, q = 0.36 um, E_VE = 1.2 um, 10
// readings in each mean of the first line and 5 of the second:
//   factor 2.0e-07 mirror 2.503939375602815e-07 square 2.0e-06 limit 1.732050807568877e-06
//   mount 5.773502691896258e-07 resolution 3.432465321284132e-07
//   environment 3.765875486765087e-07 scatter 5.823151286811198e-07 U 4.333897470377737e-06
constexpr double close = 1e-16;

TEST(SquarenessBudget, OfTwoLinesTermByTerm) {
    const SquarenessBudget budget = budget_of(stated());
    ASSERT_EQ(budget.contributions.size(), 6U);
    EXPECT_NEAR(u_of(budget, SquarenessTerm::factor), 2e-7, close);
    EXPECT_NEAR(u_of(budget, SquarenessTerm::mirror), 2.503939375602815e-07, close);
    EXPECT_NEAR(u_of(budget, SquarenessTerm::square), 2e-6, close);
    EXPECT_NEAR(u_of(budget, SquarenessTerm::mount), 5.773502691896258e-07, close);
    EXPECT_NEAR(u_of(budget, SquarenessTerm::resolution), 3.432465321284132e-07, close);
    EXPECT_NEAR(u_of(budget, SquarenessTerm::environment), 3.765875486765087e-07, close);
    ASSERT_TRUE(budget.expanded_rad);
    EXPECT_NEAR(*budget.expanded_rad, 4.333897470377737e-06, 1e-15);
    EXPECT_NEAR(*budget.expanded_rad, 2 * *budget.u_rad, 0);
    EXPECT_TRUE(budget.not_stated.empty());
    EXPECT_FALSE(budget.by_scatter);
}

TEST(SquarenessBudget, TakesALimitWhereNoUncertaintyOfTheSquareIsStated) {
    SquarenessSetup setup = stated();
    setup.stated.error_U.reset();
    setup.stated.error_limit = radian(3e-6);
    EXPECT_NEAR(u_of(budget_of(setup), SquarenessTerm::square), 1.732050807568877e-06, close);
    setup.stated.error.reset(); // none is taken out, and its limit holds the whole of it
    EXPECT_TRUE(budget_of(setup).expanded_rad);
}

// s = 0.5 um of the first line and 0.7 um of the second, both above 1.2 um / (2 sqrt 3).
TEST(SquarenessBudget, TakesTheScatterOfEachLineWhereItIsLarger) {
    SquarenessSetup setup = stated();
    setup.first.scatter = um(0.5);
    const SquarenessBudget budget = budget_of(setup, 5, 0.7);
    EXPECT_NEAR(u_of(budget, SquarenessTerm::environment), 5.823151286811198e-07, close);
    EXPECT_TRUE(budget.by_scatter);
}

// Four runs, the fourth of 10 readings in each mean, by the same script:
//   mirror 2.503939375602815e-07 mount 4.082482904638630e-07
//   resolution 2.427119504867671e-07 environment 2.611164839335468e-07
TEST(SquarenessBudget, ByReversalHasNoErrorOfTheSquareAndTheWholeMirror) {
    const SquarenessBudget budget = budget_of(reversed("X again"));
    EXPECT_EQ(u_of(budget, SquarenessTerm::square), 0);
    EXPECT_NEAR(u_of(budget, SquarenessTerm::factor), 2e-7, close);
    EXPECT_NEAR(u_of(budget, SquarenessTerm::mirror), 2.503939375602815e-07, close);
    EXPECT_NEAR(u_of(budget, SquarenessTerm::mount), 4.082482904638630e-07, close);
    EXPECT_NEAR(u_of(budget, SquarenessTerm::resolution), 2.427119504867671e-07, close);
    EXPECT_NEAR(u_of(budget, SquarenessTerm::environment), 2.611164839335468e-07, close);
}

// The first axis was not measured again: resolution 3.360194799547950e-07,
// environment 3.580248848639131e-07.
TEST(SquarenessBudget, CountsALineThatStandsInBothPositionsOnceAndWhole) {
    const SquarenessBudget budget = budget_of(reversed("X"));
    EXPECT_NEAR(u_of(budget, SquarenessTerm::mirror), 2.503939375602815e-07, close);
    EXPECT_NEAR(u_of(budget, SquarenessTerm::resolution), 3.360194799547950e-07, close);
    EXPECT_NEAR(u_of(budget, SquarenessTerm::environment), 3.580248848639131e-07, close);
}

void expect_not_stated(const SquarenessSetup& setup, const std::vector<std::string>& names) {
    const SquarenessBudget budget = budget_of(setup);
    EXPECT_EQ(budget.not_stated, names);
    EXPECT_EQ(budget.contributions.size() + names.size(), 6U);
    EXPECT_FALSE(budget.u_rad);
    EXPECT_FALSE(budget.expanded_rad);
}

TEST(SquarenessBudget, NamesWhatIsNotStatedAndGivesNoU) {
    SquarenessSetup nothing;
    nothing.first = stated().first;
    expect_not_stated(nothing,
                      {"factor", "mirror", "square", "mount", "resolution", "environment"});
    SquarenessSetup setup = stated();
    setup.optics.uncertainty.factor_U.reset();
    expect_not_stated(setup, {"factor"});
    setup = stated();
    setup.optics.resolution = {};
    setup.stated.mount_limit.reset();
    expect_not_stated(setup, {"mount", "resolution"});
}

TEST(SquarenessBudget, TakesAnErrorWithoutItsUncertaintyForNotStated) {
    SquarenessSetup setup = stated();
    setup.stated.error = radian(2e-6);
    setup.stated.error_U.reset();
    expect_not_stated(setup, {"square"});
    setup.other = reversed("X").other;
    EXPECT_TRUE(budget_of(setup).expanded_rad);
}

std::string field_refused(const SquarenessSetup& setup, int readings = 5, double scatter_um = 0) {
    const auto budget = made(setup, readings, scatter_um);
    return budget ? "accepted" : budget.error().field;
}

TEST(SquarenessBudget, RefusesByFieldWhatIsNoStatement) {
    EXPECT_EQ(field_refused(stated(), 0), "readings_a_mean");
    EXPECT_EQ(field_refused(stated(), 5, -1), "scatter");
    EXPECT_EQ(field_refused(stated(), 5, std::nan("")), "scatter");
    SquarenessSetup setup = stated();
    setup.first.readings = 0;
    EXPECT_EQ(field_refused(setup), "readings_a_mean");
    setup = stated();
    setup.optics.uncertainty.factor_k = 0;
    EXPECT_EQ(field_refused(setup), "factor_u");
    setup = stated();
    setup.optics.uncertainty.mirror_limit_um_per_m2 = -0.1;
    EXPECT_EQ(field_refused(setup), "mirror_limit_um_per_m2");
    setup = stated();
    setup.optics.uncertainty.eve = um(-1);
    EXPECT_EQ(field_refused(setup), "eve");
    setup = stated();
    setup.stated.error_k = -2;
    EXPECT_EQ(field_refused(setup), "square_u");
    setup = stated();
    setup.stated.mount_limit = radian(std::numeric_limits<double>::infinity());
    EXPECT_EQ(field_refused(setup), "mount_limit");
    setup = stated();
    setup.optics.method = StraightnessMethod::angle_steps;
    EXPECT_EQ(field_refused(setup), "method");
}

/// Machines whose every error lies within what is stated of them.
class HiddenSetups {
public:
    HiddenSetups() {
        stated_ = stated();
        stated_.optics.uncertainty.factor_U.reset();
        stated_.optics.uncertainty.factor_limit = percent(1);
        stated_.optics.uncertainty.mirror_limit_um_per_m2 = mirror_um_per_m2;
        stated_.stated.error_U.reset();
        stated_.stated.error_limit = radian(square_limit);
        stated_.stated.mount_limit = radian(mount_limit);
    }

    /// Whether the squareness of the next machine lies within U of what is found of it.
    bool covers_next(bool by_reversal, bool first_again) {
        machine_ = {1e-3 * share(), 50e-6 * share(), 1e-3 * share(), 1e-3 * share()};
        factor_ = 1 + 0.01 * share();
        of_mirror_ = {mirror_um_per_m2 * share(), mirror_um_per_m2 * share()};
        SquarenessSetup setup = stated_;
        setup.stated.error = radian(machine_.square_error_rad + square_limit * share());
        setup.first = seen_first("X");
        const RecordedLine second = seen_second(SquarePosition::normal);
        if (by_reversal)
            setup.other = OtherSquare{first_again ? seen_first("X again") : setup.first,
                                      seen_second(SquarePosition::turned)};
        const auto line = line_of(second);
        const auto figures = evaluate_squareness(*line, setup);
        const auto budget = make_squareness_budget(*figures, setup, readings, 0);
        return std::fabs(figures->squareness.least_squares - machine_.squareness_rad) <=
               *budget->expanded_rad;
    }

private:
    static constexpr double mirror_um_per_m2 = 1, square_limit = 8e-6, mount_limit = 1.5e-6;
    static constexpr double half_width_um = 0.6, half_step_um = 0.18; // E_VE, 36 * 10 nm
    static constexpr int readings = 5;

    double share() { return share_(random_); }

    RecordedLine seen_first(const char* run_id) {
        RecordedLine line = first_line(machine_, first_places);
        line.run_id = run_id, line.readings = readings;
        return disturbed(line, first_places.back(), of_mirror_[0]);
    }

    /// Mirror and square have turned against each other since the first line.
    RecordedLine seen_second(SquarePosition square) {
        SquareMachine turned = machine_;
        turned.mirror_rad += mount_limit * share();
        return disturbed(second_line(turned, square, second_places), second_places.back(),
                         of_mirror_[1]);
    }

    /// The form of the mirror that tilts a line most: one half of it high, the other low.
    RecordedLine disturbed(RecordedLine line, double length_mm, double mirror_um_a_m2) {
        std::normal_distribution<double> air{0, half_width_um / std::sqrt(3.0) /
                                                    std::sqrt(static_cast<double>(readings))};
        const double form_um = mirror_um_a_m2 * length_mm * length_mm * 1e-6;
        for (RecordedLineRow& row : line.rows) {
            const double from_middle = row.target.in(mm)-length_mm / 2;
            const double side = std::fabs(from_middle) < 1 ? 0 : from_middle > 0 ? 1 : -1;
            row.forward =
                row.forward * factor_ + um(form_um * side + air(random_) + half_step_um * share());
        }
        return line;
    }

    std::mt19937_64 random_{97};
    std::uniform_real_distribution<double> share_{-1, 1};
    SquarenessSetup stated_;
    SquareMachine machine_;
    std::array<double, 2> of_mirror_{};
    double factor_ = 1;
};

// A simulation of its own in another language found of 10000 each: 0.968 as stated, 0.974 by
// reversal, 0.973 with one line of the first axis in both positions; and by reversal 0.942 where
// the mirror was taken for two mirrors.
TEST(SquarenessBudget, CoversTheHiddenSquarenessOfAThousandSetups) {
    constexpr int setups = 1000;
    HiddenSetups hidden;
    int as_stated = 0, by_reversal = 0, second_alone = 0;
    for (int i = 0; i < setups; ++i) {
        as_stated += hidden.covers_next(false, false) ? 1 : 0;
        by_reversal += hidden.covers_next(true, true) ? 1 : 0;
        second_alone += hidden.covers_next(true, false) ? 1 : 0;
    }
    EXPECT_GE(as_stated, setups * 95 / 100);
    EXPECT_GE(by_reversal, setups * 95 / 100);
    EXPECT_GE(second_alone, setups * 95 / 100);
}

} // namespace
} // namespace axiscal::squareness_budget_test
