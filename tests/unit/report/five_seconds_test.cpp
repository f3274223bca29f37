// What a person must find in five seconds on a grey copy: axis, machine, verdict, the main figure
// with its U, the date. Read back by a program that reads pictures of pages (tesseract), which
// knows nothing of how they were made.

#include "acquisition/documents/pdf/wording.hpp"
#include "acquisition/documents/positioning/report.hpp"
#include "pdf_tools.hpp"
#include "synthetic_certificate.hpp"
#include "tests/unit/analysis/stated_uncertainty.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

namespace axiscal::five_seconds_test {
namespace {

using testing::ScratchFolder;

/// Letters and digits alone, in small letters: what distinguishes no two words here.
std::string plain(const std::string& text) {
    std::string out;
    for (const char c : text)
        if (std::isalnum(static_cast<unsigned char>(c)) != 0)
            out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return out;
}

/// The upper third of page one in grey at 100 dpi, as tesseract reads it.
std::string top_third_of(const std::string& pdf, const ScratchFolder& folder) {
    const std::string picture = folder.file("top");
    test::output_of("pdftoppm -gray -r 100 -f 1 -l 1 -x 0 -y 0 -W 827 -H 390 -singlefile '" + pdf +
                    "' '" + picture + "'");
    return test::output_of("OMP_THREAD_LIMIT=1 tesseract '" + picture +
                           ".pgm' - -l eng --psm 6 2>/dev/null");
}

struct Paper {
    RunRecord run;
    std::string verdict; ///< "" where it is left to the figures
};

ToleranceRecord limits_of(DecisionRule rule, double a_um) {
    return {"acceptance", "order 17", "um", rule, false, {{"A", {}, a_um}, {"R", {}, 100}}};
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

std::vector<Paper> fifty_papers() {
    std::vector<Paper> papers;
    const std::vector<std::string> machines{
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
    for (const std::string& machine : machines)
        for (const Shape& shape : shapes)
            for (const bool limited : {true, false}) {
                RunRecord run = run_of(shape.targets, shape.approaches, shape.both_ways);
                run.statements.machine = machine;
                run.statements.axis = papers.size() % 3 == 0 ? "X" : "Z";
                if (limited)
                    run.tolerances = limits_of(papers.size() % 4 < 2 ? DecisionRule::guard_U
                                                                     : DecisionRule::simple,
                                               papers.size() % 8 < 4 ? 1000 : 1);
                papers.push_back({std::move(run), limited ? "" : "No limits agreed"});
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

TEST(FiveSeconds, FiftyPapersAnswerInTheirUpperThird) {
    ASSERT_NE(test::output_of("tesseract --version 2>&1").find("tesseract"), std::string::npos);
    const ScratchFolder folder;
    std::size_t number = 0;
    for (const Paper& paper : fifty_papers()) {
        const Certificate certificate = test::certificate_of(paper.run);
        const auto pdf = render_certificate_pdf(certificate);
        ASSERT_TRUE(pdf) << describe(pdf.error());
        const std::string seen = top_third_of(test::write_pdf(folder, *pdf), folder);
        const std::string letters = plain(seen);
        const auto expect = [&](const std::string& words) {
            EXPECT_NE(letters.find(plain(words)), std::string::npos)
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
    EXPECT_EQ(number, 50U);
}

} // namespace
} // namespace axiscal::five_seconds_test
