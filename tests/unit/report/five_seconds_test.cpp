// What a person must find in five seconds on a grey copy: axis, machine, verdict, the main figure
// with its U, the date. Read back by a program that reads pictures of pages (tesseract), which
// knows nothing of how they were made.

#include "acquisition/documents/pdf/wording.hpp"
#include "acquisition/documents/positioning/report.hpp"
#include "pdf_tools.hpp"
#include "synthetic_certificate.hpp"
#include "tests/unit/analysis/stated_uncertainty.hpp"
#include "upper_third.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace axiscal::five_seconds_test {
namespace {

using testing::ScratchFolder;

/// The figure that the paper shows first, in mm.
std::pair<std::string, double> main_figure_of(const RunRecord& run) {
    const PositioningParameters p = test::certificate_of(run).result.parameters;
    if (p.A) return {"A", *p.A};
    if (p.E) return {"E", *p.E};
    return p.A_forward ? std::pair{"A_forward", *p.A_forward}
                       : std::pair{"E_forward", *p.E_forward};
}

/// Kept and missed by far, and where nobody can prove either: at the figure itself.
enum class Limit : std::uint8_t { wide, narrow, at_the_figure };
ToleranceRecord limits_of(const RunRecord& run, Limit where, bool bare) {
    const auto [key, value_mm] = main_figure_of(run);
    const double limit_um = where == Limit::wide     ? 1000
                            : where == Limit::narrow ? 0.001
                                                     : value_mm * 1000;
    const DecisionRule rule =
        bare && where != Limit::at_the_figure ? DecisionRule::simple : DecisionRule::guard_U;
    return {"acceptance", "order 17", "um", rule, false, {{key, {}, limit_um}}};
}

/// So many targets over the metre, each approached `approaches` times, and one way where asked.
RunRecord run_of(int targets, int approaches, bool both_ways) {
    RunRecord run = test::synthetic_run();
    run.uncertainty = test::stated_uncertainty();
    run.plan.targets.clear();
    for (int i = 0; i < targets; ++i)
        run.plan.targets.push_back(mm(10 + 980.0 * i / std::max(targets - 1, 1)));
    run.plan.points.clear();
    run.plan.approaches = approaches;
    run.plan.bidirectional = both_ways;
    for (int approach = 0; approach < approaches; ++approach)
        for (const Direction direction : {Direction::positive, Direction::negative})
            for (int i = 0; i < targets; ++i)
                if (both_ways || direction == Direction::positive)
                    run.plan.points.push_back(
                        {static_cast<int>(run.plan.points.size()), i, direction, approach});
    run.points.clear();
    run.environment.clear();
    const test::Truth truth = test::synthetic_truth(7);
    const double end_s = test::first_point_s +
                         test::seconds_per_point * static_cast<double>(run.plan.points.size() + 1);
    for (double s = 0; s <= end_s; s += 30)
        for (const ChannelRecord& channel : run.channels)
            run.environment.push_back({channel.id, test::at_seconds(s),
                                       channel.kind == ChannelKind::pressure ? truth.pressure_Pa(s)
                                       : channel.kind == ChannelKind::humidity
                                           ? truth.humidity_percent(s)
                                       : channel.medium == Medium::air ? truth.air_C(s)
                                                                       : truth.material_C(s)});
    test::add_points(run, truth);
    return run;
}

constexpr std::size_t machines = 5, papers_of_a_machine = 10;

/// Ten runs; each of the fifty has a number.
std::vector<RunRecord> papers_of(std::size_t machine) {
    const std::array<std::string, machines> names{
        "Portal mill", "DMG MORI CTX beta 2000 TC", "Bearbeitungszentrum Halle 3 Feld C7",
        "Machining centre with a name that somebody made longer than any line of any paper of any "
        "laboratory will ever be, and then some words more",
        "M"};
    struct Shape {
        int targets, approaches;
        bool both_ways;
    };
    const std::vector<Shape> shapes{
        {11, 5, true}, {200, 2, true}, {11, 5, false}, {5, 1, true}, {2, 5, true}};
    std::vector<RunRecord> papers;
    for (const Shape& shape : shapes)
        for (const bool limited : {true, false}) {
            const std::size_t number = machine * papers_of_a_machine + papers.size();
            RunRecord run = run_of(shape.targets, shape.approaches, shape.both_ways);
            run.statements.machine = names.at(machine);
            run.statements.axis = number % 3 == 0 ? "X" : "Z";
            if (limited)
                run.tolerances = limits_of(run, static_cast<Limit>(number / 2 % 3), number % 4 < 2);
            papers.push_back(std::move(run));
        }
    return papers;
}

std::string verdict_word(const Certificate& certificate) {
    if (!certificate.conformity) return "No limits agreed";
    const std::string_view verdict = certificate.conformity->verdict;
    if (verdict == "pass") return "PASS";
    if (verdict == "fail") return "FAIL";
    return verdict == "not_provable" ? "NOT PROVABLE" : "NO VERDICT";
}

/// Value and U of A, else of E, as paper writes numbers.
std::vector<std::string> numbers_of(const Certificate& certificate) {
    const PaperUnits units = paper_units_of(certificate);
    const PositioningParameters& p = certificate.result.parameters;
    const auto pick = [&](std::string_view key, const std::optional<double>& value) {
        std::vector<std::string> numbers{units.of_deviation(value)};
        const auto& budget = certificate.uncertainty.budget;
        if (const auto* known = budget ? budget->find(std::string{key}) : nullptr)
            numbers.push_back(fixed_up(known->expanded, units.deviation_decimals));
        return numbers;
    };
    if (p.A) return pick("A", p.A);
    if (p.E) return pick("E", p.E);
    if (p.A_forward) return pick("A_forward", p.A_forward);
    return pick("E_forward", p.E_forward);
}

class FiveSeconds : public ::testing::TestWithParam<std::size_t> {};

TEST_P(FiveSeconds, EveryPaperAnswersInItsUpperThird) {
    ASSERT_NE(test::output_of("tesseract --version 2>&1").find("tesseract"), std::string::npos);
    const ScratchFolder folder;
    std::size_t number = 0;
    for (const RunRecord& run : papers_of(GetParam())) {
        const Certificate certificate = test::certificate_of(run);
        const auto pdf = render_certificate_pdf(certificate);
        ASSERT_TRUE(pdf) << describe(pdf.error());
        const std::string seen = test::upper_third_of(test::write_pdf(folder, *pdf), folder);
        const std::string letters = test::letters_of(seen);
        const auto expect = [&](const std::string& words) {
            EXPECT_NE(letters.find(test::letters_of(words)), std::string::npos)
                << "paper " << number << ": \"" << words << "\" is not read in:\n"
                << seen;
        };
        expect("Axis " + certificate.run.statements.axis);
        expect(certificate.run.statements.machine.substr(0, 20));
        expect(certificate.issued_on);
        expect(verdict_word(certificate));
        for (const std::string& value : numbers_of(certificate))
            expect(value);
        ++number;
    }
    EXPECT_EQ(number, papers_of_a_machine);
}

INSTANTIATE_TEST_SUITE_P(OfMachine, FiveSeconds, ::testing::Range(std::size_t{0}, machines));

TEST(FiftyPapers, BearEveryVerdict) {
    std::map<std::string, int> verdicts;
    for (std::size_t machine = 0; machine < machines; ++machine)
        for (const RunRecord& run : papers_of(machine))
            ++verdicts[verdict_word(test::certificate_of(run))];
    for (const char* word : {"PASS", "FAIL", "NOT PROVABLE", "No limits agreed"})
        EXPECT_GT(verdicts[word], 5) << word;
}

} // namespace
} // namespace axiscal::five_seconds_test
