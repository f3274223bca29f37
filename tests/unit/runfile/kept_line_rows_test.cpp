// Rows of a run file whose chain is whole and that stand there in another order, twice or without
// the row that they belong to: a file that another program wrote.
#include "acquisition/runfile/record_rows.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace axiscal::kept_line_rows_test {
namespace {

RecordedLine line_named(const char* run_id) {
    RecordedLine line{run_id, "X", "Y", 5, um(0.2), {}};
    line.rows = {{mm(0), um(1), um(2)}, {mm(100), um(3), {}}};
    return line;
}

TestSetup reversed() {
    StraightnessSetup setup;
    setup.reversal_of = "r";
    setup.reversal = line_named("r");
    return setup;
}

TestSetup by_reversal() {
    SquarenessSetup setup;
    setup.first = line_named("a");
    setup.other = OtherSquare{line_named("b"), line_named("c")};
    return setup;
}

/// The refusal of the first row that is refused; "accepted".
std::string placed(RecordedRun& run, const std::vector<ChainedRow>& rows) {
    for (const ChainedRow& one : rows)
        if (const auto done = place_row(run, *one.table, one.row); !done)
            return done.error().detail;
    return "accepted";
}

std::string placed(const std::vector<ChainedRow>& rows) {
    RecordedRun run;
    return placed(run, rows);
}

std::vector<ChainedRow> without(const TestSetup& setup, std::string_view table) {
    std::vector<ChainedRow> rows = rows_of(setup);
    std::erase_if(rows, [&](const ChainedRow& one) { return one.table->name == table; });
    return rows;
}

/// The rows of that table stand behind all others, once more or instead.
std::vector<ChainedRow> with_last(const TestSetup& setup, std::string_view table, bool once_more) {
    std::vector<ChainedRow> rows = once_more ? rows_of(setup) : without(setup, table);
    std::ranges::copy_if(rows_of(setup), std::back_inserter(rows),
                         [&](const ChainedRow& one) { return one.table->name == table; });
    return rows;
}

TEST(KeptLineRows, ComeBackInTheOrderInWhichTheyAreWritten) {
    RecordedRun run;
    ASSERT_EQ(placed(run, rows_of(by_reversal())), "accepted");
    const auto& squareness = std::get<SquarenessSetup>(run.attachments.setup);
    ASSERT_TRUE(squareness.other);
    EXPECT_EQ(squareness.first.run_id, "a");
    EXPECT_EQ(squareness.other->second.run_id, "c");
    ASSERT_EQ(squareness.other->first.rows.size(), 2U);
    EXPECT_EQ(squareness.other->first.rows[1].forward, um(3));
    EXPECT_FALSE(squareness.other->first.rows[1].backward);
}

TEST(KeptLineRows, OfAReversalTakeTheRunIdOfTheSetUp) {
    RecordedRun run;
    const auto rows = rows_of(reversed());
    ASSERT_EQ(rows.size(), 5U); // set-up, its statement, the line, two rows
    EXPECT_EQ(rows[2].table->name, "straightness_reversal");
    ASSERT_EQ(placed(run, rows), "accepted");
    EXPECT_EQ(std::get<StraightnessSetup>(run.attachments.setup).reversal->run_id, "r");
}

TEST(KeptLineRows, AreWrittenByThemselves) {
    for (const TestSetup& setup : {reversed(), by_reversal()})
        for (const ChainedRow& one : rows_of(setup))
            EXPECT_EQ(placed({one}), "accepted") << one.table->name;
}

TEST(KeptLineRows, AreRefusedTwice) {
    EXPECT_NE(placed(with_last(reversed(), "straightness_reversal", true)).find("twice"),
              std::string::npos);
    EXPECT_NE(placed(with_last(by_reversal(), "squareness", true)).find("twice"),
              std::string::npos);
    EXPECT_NE(placed(with_last(by_reversal(), "squareness_other", true)).find("twice"),
              std::string::npos);
}

TEST(KeptLineRows, AreRefusedWithoutTheirLineAndBeforeIt) {
    const std::string alone = "stands there without the line that it belongs to";
    for (const auto& [setup, head] : {std::pair{reversed(), "straightness_reversal"},
                                      std::pair{by_reversal(), "squareness_other"}}) {
        EXPECT_NE(placed(without(setup, head)).find(alone), std::string::npos) << head;
        EXPECT_NE(placed(with_last(setup, head, false)).find(alone), std::string::npos) << head;
    }
}

TEST(KeptLineRows, AreRefusedBeforeTheirSetUp) {
    EXPECT_NE(placed(with_last(reversed(), "straightness", false)).find("twice"),
              std::string::npos);
    EXPECT_NE(placed(with_last(by_reversal(), "squareness", false)).find("twice"),
              std::string::npos);
}

TEST(KeptLineRows, AreRefusedBesideTheSetUpOfAnotherKind) {
    std::vector<ChainedRow> rows = rows_of(reversed());
    std::ranges::move(rows_of(by_reversal()), std::back_inserter(rows));
    EXPECT_NE(placed(rows).find("another kind of test"), std::string::npos);
}

TEST(KeptLineRows, OfALineThatNobodyKnowsAreRefused) {
    std::vector<ChainedRow> rows = rows_of(by_reversal());
    rows.back().row[0] = std::string{"third"};
    EXPECT_NE(placed(rows).find("\"third\" is not known"), std::string::npos);
}

} // namespace
} // namespace axiscal::kept_line_rows_test
