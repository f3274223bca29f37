// The table [squareness]: what it says, what it needs beside it, and each key that is wrong by
// itself.
#include "acquisition/measurement/squareness/squareness_config.hpp"
#include "acquisition/measurement/straightness/straightness_config.hpp"
#include "tests/unit/config/station_text.hpp"

#include <any>
#include <gtest/gtest.h>
#include <string>
#include <utility>

namespace axiscal::squareness_config_test {
namespace {

/// A linear axis Y of 1000 mm before a laser.
StationConfig station_of_y() {
    StationConfig station;
    station.axis.name = station.axis.program_axis = "Y";
    station.axis.laser = {"laser", "axis 1"};
    InstrumentConfig laser;
    laser.name = "laser";
    station.instruments.push_back(laser);
    station.cycle.travel_low = mm(0);
    station.cycle.travel_high = mm(1000);
    station.cycle.overrun = mm(5);
    station.cycle.interval = mm(90);
    station.cycle.feed = mm_per_minute(1000);
    station.capture.fastest = mm_per_minute(30'000);
    return station;
}

const std::string across_text = "[straightness]\nacross = \"X\"\nsign = 1\nfactor = 36\n";

struct ReadTables {
    std::any config;
    std::string told; ///< refusals, one a line; empty: accepted
    [[nodiscard]] const SquarenessConfig& operator*() const {
        return *std::any_cast<SquarenessConfig>(&config);
    }
};

/// Both tables in the order in which the station reads them.
ReadTables read_tables(const std::string& text, StationConfig station = station_of_y()) {
    auto document = test::document_of(text);
    Settings root = document.root();
    if (root.has("straightness")) {
        Settings across = root.table("straightness");
        KindSection section{TestKind::straightness, across,
                            read_straightness_section(across, station)};
        station.kind_sections.push_back(std::move(section));
    }
    ReadTables tables;
    tables.config = read_squareness_section(root.table("squareness"), station);
    tables.told = test::told(document);
    return tables;
}

ReadTables read_square(const std::string& keys) {
    return read_tables(across_text + "[squareness]\n" + keys);
}

TEST(SquarenessTable, MayBeEmptyAndTakesTheNewestLine) {
    const ReadTables tables = read_square("");
    ASSERT_EQ(tables.told, "");
    const SquarenessConfig& config = *tables;
    EXPECT_EQ(config.first, "latest");
    EXPECT_EQ(config.reversal_of, "");
    EXPECT_EQ(config.square, SquarePosition::normal);
    EXPECT_FALSE(config.stated.error || config.stated.error_U || config.stated.error_limit);
    EXPECT_FALSE(config.stated.mount_limit);
    EXPECT_EQ(config.artefact.name, "optical square");
}

TEST(SquarenessTable, WhatIsStatedIsKept) {
    const ReadTables tables = read_square(
        "first = \"bench-1-X\"\nsquare = \"turned\"\nsquare_error = \"-1.2 arcsec\"\n"
        "square_uncertainty = \"0.4 arcsec\"\nsquare_k = 2.5\nmount_limit = \"0.3 arcsec\"\n"
        "reversal_of = \"latest\"\n[squareness.optical_square]\nmaker = \"M\"\nmodel = \"P\"\n"
        "serial = \"S-4\"\ncertificate_number = \"C-4\"\ncalibrated_on = \"2026-01-31\"\n"
        "due_on = \"2027-01-31\"\n");
    ASSERT_EQ(tables.told, "");
    const SquarenessConfig& config = *tables;
    EXPECT_EQ(config.first, "bench-1-X");
    EXPECT_EQ(config.square, SquarePosition::turned);
    EXPECT_NEAR(config.stated.error.value().in(arcsec), -1.2, 1e-12);
    EXPECT_NEAR(config.stated.error_U.value().in(arcsec), 0.4, 1e-12);
    EXPECT_EQ(config.stated.error_k, 2.5);
    EXPECT_NEAR(config.stated.mount_limit.value().in(arcsec), 0.3, 1e-12);
    EXPECT_EQ(config.reversal_of, "latest");
    EXPECT_EQ(config.artefact.serial, "S-4");
    EXPECT_EQ(config.artefact.due_on, "2027-01-31");
}

TEST(SquarenessTable, ALimitOfTheSquareNeedsNoError) {
    const ReadTables tables = read_square("square_limit = \"2 arcsec\"\n");
    ASSERT_EQ(tables.told, "");
    EXPECT_FALSE((*tables).stated.error);
    EXPECT_NEAR((*tables).stated.error_limit.value().in(arcsec), 2, 1e-12);
}

struct WrongSquare {
    const char* keys;
    const char* told; ///< a part of the only refusal
};

TEST(SquarenessTable, EachKeyThatIsWrongIsToldByItself) {
    const WrongSquare wrong[] = {
        {"square = \"reversed\"\n", "squareness.square: \"reversed\" is not one of"},
        {"first = \"\"\n", "squareness.first: names the straightness run of the other axis"},
        {"square_uncertainty = \"0.4 arcsec\"\n",
         "squareness.square_uncertainty: is that of square_error: state that one too"},
        {"square_error = \"1 arcsec\"\nsquare_uncertainty = \"0.4 arcsec\"\n"
         "square_limit = \"1 arcsec\"\n",
         "squareness.square_limit: is given together with square_uncertainty"},
        {"square_k = 2\n", "squareness.square_k: belongs to square_uncertainty"},
        {"square_error = \"2 deg\"\n", "squareness.square_error"},
        {"square_error = 1.2\n", "squareness.square_error"},
        {"mount_limit = \"-1 arcsec\"\n", "squareness.mount_limit"},
        {"factor = 36\n", "squareness.factor"},
        {"[squareness.optical_square]\ncalibrated_on = \"2026-02-01\"\ndue_on = \"2026-01-01\"\n",
         "squareness.optical_square.due_on: is before calibrated_on"},
    };
    for (const auto& [keys, told] : wrong) {
        const ReadTables tables = read_square(keys);
        EXPECT_NE(tables.told.find(told), std::string::npos) << keys << tables.told;
        EXPECT_EQ(test::count_lines(tables.told), 1) << keys << tables.told;
    }
}

TEST(SquarenessTable, NeedsTheTableOfThePrism) {
    const ReadTables tables = read_tables("[squareness]\nsquare_k = 2\n");
    EXPECT_NE(tables.told.find("needs the table [straightness]"), std::string::npos) << tables.told;
    EXPECT_EQ(test::count_lines(tables.told), 1) << tables.told;
    EXPECT_FALSE(tables.config.has_value());
}

TEST(SquarenessTable, WhatThePrismWasRefusedForIsNotToldTwice) {
    const ReadTables tables =
        read_tables("[straightness]\nmethod = \"angle-steps\"\n[squareness]\nfirst = \"\"\n");
    EXPECT_NE(tables.told.find("straightness.method"), std::string::npos) << tables.told;
    EXPECT_EQ(test::count_lines(tables.told), 1) << tables.told;
    EXPECT_FALSE(tables.config.has_value());
}

TEST(SquarenessTable, AnAxisIsCalledByItsLetter) {
    StationConfig station = station_of_y();
    station.axis.name = "column";
    const std::string told = read_tables(across_text + "[squareness]\n", station).told;
    EXPECT_NE(told.find("this one is called \"column\": write axis.name = \"Y\""),
              std::string::npos)
        << told;
}

TEST(SquarenessTable, ThePlanIsThatOfTheStraightnessUnderItsOwnPass) {
    StraightnessConfig across;
    across.plan.pass = "straightness";
    across.plan.targets = {mm(10), mm(20), mm(30)};
    const RunPlan plan = plan_of_kind(across, TestKind::squareness);
    EXPECT_EQ(plan.pass, "squareness");
    EXPECT_EQ(plan.targets, across.plan.targets);
}

} // namespace
} // namespace axiscal::squareness_config_test
