// What leaves the station of a drift test, as JSON and CSV. The truth is a record made by hand: an
// axis that creeps by 1 um a minute, a bed that warms up by 0.1 K a minute, a gauge, a silent one.
#include "acquisition/documents/drift/drift_document.hpp"

#include "acquisition/documents/document_parts.hpp"
#include "acquisition/documents/run_verify.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/runfile/one_row.hpp"
#include "tests/unit/documents/evaluated.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace axiscal::drift_document_test {
namespace {

constexpr int readings = 11; // one a minute

RunRecord made_run() {
    RunRecord run;
    run.kind = TestKind::drift;
    run.run_id = "bench-drift";
    run.complete = true;
    run.laser.instrument = "laser";
    run.laser.vacuum_wavelength = nm(632.991354);
    run.channels = {{0, "axis 1", "laser", "", ChannelKind::displacement, Medium::none, 0},
                    {1, "air", "weather", "beam", ChannelKind::temperature, Medium::air, 0},
                    {2, "pressure", "weather", "beam", ChannelKind::pressure, Medium::air, 0},
                    {3, "humidity", "weather", "beam", ChannelKind::humidity, Medium::air, 0},
                    {4, "bed", "contacts", "left", ChannelKind::temperature, Medium::material, 0},
                    {5, "gauge \"A\"", "gauge", "", ChannelKind::displacement, Medium::none, 0},
                    {6, "CO2", "hall", "door", ChannelKind::carbon_dioxide, Medium::none, 0}};
    for (int minute = 0; minute < readings; ++minute) {
        const double values[] = {1e-6 * minute,        20, 101325, 50, 20 + 0.1 * minute,
                                 0.5 - 0.2e-6 * minute};
        for (int channel = 0; channel < 6; ++channel)
            run.environment.push_back(
                {channel, monotonic_from_ns(60'000'000'000LL * minute), values[channel]});
    }
    return run;
}

/// At its datum, where neither air nor material acts on a path.
DriftResult made_document(RunRecord run = made_run()) {
    DriftResult document;
    document.attachments.setup = DriftSetup{std::chrono::minutes{10}, std::chrono::minutes{1},
                                            run.plan.datum, run.laser.instrument == "gauge"};
    const auto drift = evaluate_drift(run, std::get<DriftSetup>(document.attachments.setup));
    EXPECT_TRUE(drift) << (drift ? "" : describe(drift.error()));
    document.drift = drift.value_or(RunDrift{});
    document.run = std::move(run);
    return document;
}

TEST(DriftDocument, TellsEveryChannelWithRangeAndSlope) {
    const auto json = drift_to_json(made_document());
    EXPECT_EQ(json["unit"], "um");
    EXPECT_NEAR(json["slope_per_h"].get<double>(), 60, 0.02); // in air: 2.7e-4 shorter
    const auto& channels = json["channels"];
    ASSERT_EQ(channels.size(), 7U);
    EXPECT_EQ(channels[0]["channel"], "axis 1");
    EXPECT_NEAR(channels[0]["E_VE"]["value"].get<double>(), 10, 1e-9);
    EXPECT_NEAR(channels[0]["slope_per_h"].get<double>(), 60, 1e-6);
    EXPECT_EQ(channels[4]["instrument"], "contacts");
    EXPECT_EQ(channels[4]["medium"], "material");
    EXPECT_NEAR(channels[4]["range"]["value"].get<double>(), 1, 1e-12);
    EXPECT_NEAR(channels[4]["slope_per_h"].get<double>(), 6, 1e-9);
    EXPECT_FALSE(channels[4].contains("E_VE")) << "a temperature has none";
    EXPECT_NEAR(channels[5]["E_VE"]["value"].get<double>(), 2, 1e-6);
    EXPECT_NEAR(channels[5]["E_VE"]["u"].get<double>(), 2 / std::sqrt(12.0), 1e-6);
    EXPECT_NEAR(channels[5]["slope_per_h"].get<double>(), -12, 1e-5);
}

TEST(DriftDocument, TellsAChannelThatStayedSilent) {
    const auto json = drift_to_json(made_document());
    const auto& silent = json["channels"][6];
    EXPECT_EQ(silent["channel"], "CO2");
    EXPECT_EQ(silent["readings"], 0);
    EXPECT_FALSE(silent.contains("range"));
}

TEST(DriftDocument, SaysWhatTheBudgetTakesAndThatTheRestIsInformative) {
    const auto budget = drift_to_json(made_document())["budget"];
    EXPECT_EQ(budget["takes"], "E_VE");
    EXPECT_EQ(budget["by"], "ISO 230-2 annex A");
    EXPECT_TRUE(budget["informative"].is_array());
    EXPECT_EQ(budget["informative"].back(), "channels");
}

TEST(DriftDocument, OfWhichReadingsWereRefusedFeedsNoBudgetAndSaysSo) {
    RunRecord run = made_run();
    for (EnvironmentReading& reading : run.environment)
        if (reading.channel == 3 && seconds_of(reading.at.time_since_epoch()) > 479)
            reading.value = 130; // % of humidity, from the eighth minute on
    const auto document = made_document(std::move(run));
    const auto json = drift_to_json(document);
    EXPECT_EQ(json["test"]["readings"], 8);
    EXPECT_EQ(json["test"]["without_air"], 0);
    const auto& refused = json["test"]["refused"];
    ASSERT_EQ(refused.size(), 1U);
    EXPECT_EQ(refused[0]["fault"], "bad_request");
    EXPECT_EQ(refused[0]["readings"], 3);
    EXPECT_EQ(refused[0]["from_min"], 8);
    EXPECT_EQ(refused[0]["to_min"], 10);
    EXPECT_TRUE(json["budget"]["takes"].is_null());
    EXPECT_NE(drift_csv(document).find("\n# refused,\"axis at 20 degC\",readings,3\r\n"),
              std::string::npos);
    const auto whole = drift_to_json(made_document());
    EXPECT_EQ(whole["test"]["refused"].size(), 0U);
    EXPECT_EQ(drift_csv(made_document()).find("# refused"), std::string::npos);
}

TEST(DriftDocument, HoldsEveryReadingAndTheFiguresOfEachChannelAsCsv) {
    const std::string csv = drift_csv(made_document());
    EXPECT_TRUE(csv.starts_with("channel,unit,minute,value\r\n\"axis at 20 degC\",um,0,0\r\n"));
    const auto count = [&](const std::string& words) {
        int found = 0;
        for (auto at = csv.find(words); at != std::string::npos; at = csv.find(words, at + 1))
            ++found;
        return found;
    };
    for (const char* head :
         {"\n\"axis at 20 degC\",um,", "\n\"laser/axis 1\",um,", "\n\"weather/air\",degC,",
          "\n\"weather/pressure\",Pa,", "\n\"weather/humidity\",%,", "\n\"contacts/bed\",degC,",
          "\n\"gauge/gauge \"\"A\"\"\",um,"})
        EXPECT_EQ(count(head), readings) << head;
    EXPECT_EQ(count("\n# range,"), 7); // the axis at 20 degC and six that spoke
    EXPECT_EQ(count("\n# slope_per_h,"), 7);
    EXPECT_EQ(count("\n# E_VE,"), 3); // lengths alone
    EXPECT_EQ(count("\n# range,\"weather/pressure\",Pa,0\r\n"), 1);
    EXPECT_EQ(count("\n# E_VE,\"laser/axis 1\",um,"), 1);
}

TEST(DriftDocument, TellsChannelsOfOneNameApartByTheirInstruments) {
    RunRecord run = made_run();
    run.channels[5] = {5, "axis 1", "second laser", "", ChannelKind::displacement, Medium::none, 0};
    const auto document = made_document(std::move(run));
    const auto json = drift_to_json(document);
    const auto& channels = json["channels"];
    EXPECT_EQ(channels[0]["instrument"], "laser");
    EXPECT_EQ(channels[5]["instrument"], "second laser");
    EXPECT_EQ(channels[5]["channel"], "axis 1");
    const std::string csv = drift_csv(document);
    EXPECT_NE(csv.find("\n\"laser/axis 1\",um,0,0\r\n"), std::string::npos);
    EXPECT_NE(csv.find("\n\"second laser/axis 1\",um,0,0\r\n"), std::string::npos);
    EXPECT_NE(csv.find("\n# range,\"second laser/axis 1\",um,"), std::string::npos);
}

/// What the record holds of the bar: the gauge, which falls by 0.2 um a minute.
RunRecord of_the_bar() {
    RunRecord run = made_run();
    run.laser = {};
    run.laser.instrument = "gauge";
    run.statements.axis = "ZX";
    return run;
}

TEST(DriftDocument, OfABallbarNamesItAndItsPlaneAndNoPlaceOfAnAxis) {
    const auto document = made_document(of_the_bar());
    const auto json = drift_to_json(document);
    EXPECT_EQ(json["standard"], "ISO/TR 230-9 E_VE, ISO 230-3 ETVE");
    EXPECT_NEAR(json["parameters"]["E_VE"]["value"].get<double>(), 2, 1e-6);
    EXPECT_NEAR(json["parameters"]["E_VE"]["u"].get<double>(), 2 / std::sqrt(12.0), 1e-6);
    EXPECT_NEAR(json["parameters"]["end_change"]["value"].get<double>(), -2, 1e-6);
    EXPECT_FALSE(json["parameters"].contains("E_VE_as_read")) << "it is E_VE";
    EXPECT_EQ(json["budget"]["takes"], "E_VE");
    EXPECT_EQ(json["budget"]["by"], "ISO/TR 230-9");
    EXPECT_EQ(json["run"]["reference"], "ballbar");
    EXPECT_EQ(json["run"]["ballbar"], "gauge/gauge \"A\"");
    EXPECT_EQ(json["run"]["plane"], "ZX");
    EXPECT_FALSE(json["run"]["statements"].contains("axis"));
    EXPECT_FALSE(json["run"].contains("datum_mm"));
    EXPECT_FALSE(json["test"].contains("place_mm"));
    EXPECT_EQ(json["channels"][0]["instrument"], "gauge");
    const std::string csv = drift_csv(document);
    EXPECT_TRUE(csv.starts_with("channel,unit,minute,value\r\n\"ballbar\",um,0,0\r\n")) << csv;
    EXPECT_NE(csv.find("\n# E_VE,\"ballbar\",um,"), std::string::npos);
}

/// Sealed and read back as `axiscal analyze` and `axiscal verify` do.
TEST(DriftDocument, OfABallbarIsVerifiedAgainstItsRunFile) {
    const testing::ScratchFolder folder;
    const std::string path = folder.file("bar.axiscal");
    RunRecord run = of_the_bar();
    RunAttachments beside;
    beside.setup = DriftSetup{std::chrono::minutes{10}, std::chrono::minutes{1}, Length{}, true};
    auto writer = RunFileWriter::create(path, run, beside).value();
    ASSERT_TRUE(testing::append(writer, run.environment));
    ASSERT_TRUE(writer.close(true, "The test is over.", {}));
    EXPECT_EQ(summarize_run_file(path)->bar, "gauge/gauge \"A\"");
    ASSERT_TRUE(test::stored_first(path));
    const auto sealed = test::evaluated<DriftResult>(path);
    ASSERT_TRUE(sealed) << describe(sealed.error());
    EXPECT_TRUE(sealed->drift.of_bar);
    EXPECT_EQ(read_stored_result(path)->digest, sealed->result_digest);
    auto certificate = drift_to_json(*sealed);
    const auto verify = [&] {
        const std::string paper = folder.file("certificate.json");
        testing::write_bytes(paper, document_text(certificate));
        return verify_run(path, {paper, {}, {}});
    };
    const auto told = verify();
    ASSERT_TRUE(told) << describe(told.error());
    EXPECT_TRUE(told->intact());
    certificate["parameters"]["E_VE"]["value"] = 1.9;
    EXPECT_FALSE(verify()->intact());
}

TEST(DriftDocument, OfARotaryAxisIsInSecondsOfArc) {
    RunRecord run = made_run();
    run.plan.axis_kind = AxisKind::rotary;
    run.rotary.emplace().arm = mm(32.61);
    const auto document = made_document(std::move(run));
    const auto json = drift_to_json(document);
    EXPECT_EQ(json["unit"], "arcsec");
    EXPECT_EQ(json["budget"]["by"], "after ISO 230-2 annex A");
    EXPECT_EQ(json["run"]["reference"], "indexing table");
    EXPECT_EQ(json["test"]["place_deg"], 0);
    // 10 um on 32.61 mm are 63.25 seconds of arc, in air 2.7e-4 less.
    EXPECT_NEAR(json["parameters"]["E_VE"]["value"].get<double>(), 63.25, 0.03);
    EXPECT_NE(drift_csv(document).find("value\r\n\"axis\",arcsec,0,0\r\n"), std::string::npos);
}

} // namespace
} // namespace axiscal::drift_document_test
