#include "tools/axiscal/imports/imported_run.hpp"

#include "analysis/positioning/positioning_certificate.hpp"

#include <gtest/gtest.h>

namespace axiscal::imported_run_test {
namespace {

using Json = nlohmann::json;

/// Means 2 and 6 um forward, 0 and 1 um backward: E 6, B 5, mean B 3.5 um.
const Json document = Json::parse(
    R"({"analysis":"positioning","standard":"ISO 230-2:2014","axis":{"name":"X 1","kind":"linear"},"unit":"um","target_unit":"mm",
        "readings":"deviations","targets":[0,100],"forward":[[1,3],[5,7]],"backward":[[-1,1],[0,2]],"date":"2026-11-21","machine":"Mill"})");

ImportedReadings from() {
    ImportedReadings imported;
    imported.file = "x.rtl";
    imported.form = "Laser10 text";
    imported.sha256 = std::string(64, 'a');
    return imported;
}

RunRecord run_of(const Json& made) {
    const auto run =
        imported_run(made, from(), {MonotonicTime{}, 1'000'000'000'000'000'000, MonotonicTime{}});
    EXPECT_TRUE(run) << (run ? "" : describe(run.error()));
    return run.value_or(RunRecord{});
}

TEST(ImportedRun, GivesTheFiguresOfItsReadings) {
    const auto certificate = make_certificate(run_of(document), "");
    ASSERT_TRUE(certificate) << describe(certificate.error());
    const PositioningParameters& figures = certificate->result.parameters;
    EXPECT_NEAR(*figures.E, 0.006, 1e-15);
    EXPECT_NEAR(*figures.B, 0.005, 1e-15);
    EXPECT_NEAR(*figures.B_mean, 0.0035, 1e-15);
    EXPECT_EQ(certificate->result.provenance, "imported: readings by others");
    EXPECT_FALSE(certificate->uncertainty.budget) << "no U follows from a file";
    EXPECT_TRUE(certificate->setup_findings.empty());
    EXPECT_EQ(certificate->run.imported->measured, "2026-11-21");
    EXPECT_EQ(certificate->next_due, "") << "nobody knows when it was measured";
    EXPECT_TRUE(certificate->remarks.at(0).starts_with("Imported, readings by others: x.rtl"));
}

TEST(ImportedRun, IsNamedByTheHashOfItsFileAndItsAxis) {
    const RunRecord run = run_of(document);
    EXPECT_EQ(run.run_id, "imported-aaaaaaaaaaaa-X-1");
    EXPECT_EQ(run.statements.machine, "Mill");
    EXPECT_TRUE(run.complete);
    EXPECT_EQ(run.plan.points.size(), 8U);
    EXPECT_EQ(run.plan.points[2].direction, Direction::negative) << "back from the last target";
    EXPECT_EQ(run.plan.points[2].target_index, 1);
}

TEST(ImportedRun, TakesPositionsInTheUnitOfTheFile) {
    Json positions = document;
    positions["readings"] = "positions";
    positions["unit"] = "mm";
    positions.erase("target_unit");
    positions["forward"] = Json::parse("[[0.001,0.003],[100.005,100.007]]");
    positions["backward"] = Json::parse("[[-0.001,0.001],[100.000,100.002]]");
    const auto certificate = make_certificate(run_of(positions), "");
    ASSERT_TRUE(certificate) << describe(certificate.error());
    EXPECT_NEAR(*certificate->result.parameters.E, 0.006, 1e-12);
}

TEST(ImportedRun, OfSomethingElseIsRefusedByField) {
    const auto field = [](const Json& made) {
        const auto run = imported_run(made, from(), {});
        EXPECT_FALSE(run);
        return run ? std::string{} : run.error().field;
    };
    EXPECT_EQ(field({{"analysis", "circular"}}), "analysis");
    Json gap = document;
    gap["backward"][1][0] = nullptr;
    EXPECT_EQ(field(gap), "backward");
}

} // namespace
} // namespace axiscal::imported_run_test
