// Tables as spreadsheets, PowerShell and laser programs write them: each is the same case as JSON.
#include "tests/support/source_dir.hpp"
#include "tests/unit/cases/asked.hpp"
#include "tools/axiscal/cases/case_table.hpp"

namespace axiscal::case_table_test {
namespace {

using nlohmann::json;

const std::string statements = "# readings: deviations\n# axis: X\n";
const std::string plain = statements +
                          "target [mm],run1 + [um],run1 - [um],run2 + [um],run2 - [um]\n"
                          "0,0.5,-0.5,1.5,-1.5\n500,2.5,1.5,3.5,0.5\n1000,9.5,8.5,10.5,7.5\n";

json answer(const std::string& text) {
    const CaseAnswer got = analyze_cases(text);
    EXPECT_EQ(got.exit_code, 0) << got.error_line;
    return got.exit_code == 0 ? json::parse(got.output) : json{};
}

std::string refusal(const std::string& text) {
    const CaseAnswer got = analyze_cases(text);
    EXPECT_EQ(got.exit_code, 3);
    return got.error_line;
}

json as_json() {
    return test::answer_to(json::parse(R"({"analysis":"positioning","standard":"ISO 230-2:2014",
        "axis":{"name":"X","kind":"linear"},"unit":"um","target_unit":"mm","readings":"deviations",
        "targets":[0,500,1000],"forward":[[0.5,1.5],[2.5,3.5],[9.5,10.5]],
        "backward":[[-0.5,-1.5],[1.5,0.5],[8.5,7.5]]})"));
}

std::string with(std::string text, char from, const std::string& to) {
    std::string out;
    for (const char letter : text)
        out += letter == from ? to : std::string{letter};
    return out;
}

std::string utf16(const std::string& ascii, bool little) {
    std::string out = little ? "\xff\xfe" : "\xfe\xff";
    for (const char letter : ascii)
        out += little ? std::string{letter, '\0'} : std::string{'\0', letter};
    return out;
}

std::string quoted(const std::string& text) {
    std::string out;
    for (const char letter : text.substr(statements.size()))
        out += letter == ',' ? "\",\"" : letter == '\n' ? "\"\n\"" : std::string{letter};
    return statements + "\"" + out.substr(0, out.size() - 1);
}

TEST(CaseTable, IsTheSameCaseAsJson) {
    EXPECT_EQ(answer(plain), as_json());
}

TEST(CaseTable, MayHaveSemicolonsTabsAndDecimalCommas) {
    const std::string semicolons = with(plain, ',', ";");
    EXPECT_EQ(answer(semicolons), as_json());
    EXPECT_EQ(answer(with(plain, ',', "\t")), as_json());
    EXPECT_EQ(answer(with(semicolons, '.', ",")), as_json()); // German
    EXPECT_EQ(answer(with(with(plain, ',', "\t"), '.', ",")), as_json());
}

TEST(CaseTable, MayBeQuotedAndEndItsLinesAsWindowsDoes) {
    EXPECT_EQ(answer(quoted(plain)), as_json());
    EXPECT_EQ(answer(with(plain, '\n', "\r\n")), as_json());
    EXPECT_EQ(answer("\n" + plain + "\n,,,,\n"), as_json());
}

TEST(CaseTable, MayBeUtf16OrHaveAByteOrderMark) {
    EXPECT_EQ(answer("\xef\xbb\xbf" + plain), as_json());
    EXPECT_EQ(answer(utf16(plain, true)), as_json()); // PowerShell's >
    EXPECT_EQ(answer(utf16(plain, false)), as_json());
    EXPECT_NE(refusal(utf16(plain, true) + "x").find("UTF-16"), std::string::npos);
}

TEST(CaseTable, NamesItsApproachesInManyWays) {
    for (const auto& [forward, backward] :
         {std::pair{"forward ", "backward "}, std::pair{"+", "-"}, std::pair{"up ", "down "},
          std::pair{"\xe2\x86\x91", "\xe2\x86\x93"}, std::pair{"Positive ", "Negative "}}) {
        const std::string f{forward}, b{backward};
        const std::string header = "target (mm)," + f + "1 (\xc2\xb5m)," + b + "1 (\xc2\xb5m)," +
                                   f + "2 (\xce\xbcm)," + b + "2 (um)\n";
        const auto rows = plain.substr(plain.find("0,0.5"));
        EXPECT_EQ(answer(statements + header + rows), as_json()) << header;
    }
}

TEST(CaseTable, KeepsTheOrderOfItsApproachesWhateverTheColumns) {
    EXPECT_EQ(answer(statements +
                     "target [mm],run2 - [um],run1 - [um],run2 + [um],run1 + [um]\n"
                     "0,-1.5,-0.5,1.5,0.5\n500,0.5,1.5,3.5,2.5\n1000,7.5,8.5,10.5,9.5\n"),
              as_json());
}

TEST(CaseTable, StatesWhatElseACaseHolds) {
    const json got = answer("# uncertainty.device_width_um: 1\n# uncertainty.eve_um: 3\n"
                            "# uncertainty.monte_carlo: false\n" +
                            plain);
    EXPECT_TRUE(got["parameters"]["R_forward"].contains("expanded_uncertainty"));
    EXPECT_NE(refusal("# uncertanty.eve_um: 3\n" + plain).find("uncertanty"), std::string::npos);
}

// As laser programs export: the run back descends.
TEST(CaseTable, MayHaveARowAReading) {
    const std::string rows = "1;0;+;0,5\n1;500;+;2,5\n1;1000;+;9,5\n"
                             "1;1000;-;8,5\n1;500;-;1,5\n1;0;-;-0,5\n"
                             "2;0;+;1,5\n2;500;+;3,5\n2;1000;+;10,5\n"
                             "2;1000;-;7,5\n2;500;-;0,5\n2;0;-;-1,5\n";
    EXPECT_EQ(answer("run;target [mm];direction;deviation [um]\n" + rows), as_json());
    EXPECT_NE(refusal("run;target [mm];deviation [um]\n1;0;0,5\n").find("direction"),
              std::string::npos);
    EXPECT_NE(refusal("target [mm];direction;deviation [um]\n0;east;0,5\n").find("must be + or -"),
              std::string::npos);
    const std::string uneven =
        refusal("target [mm];direction;deviation [um]\n0;+;0,5\n0;+;0,6\n10;+;0,7\n");
    EXPECT_NE(uneven.find("forward[1]: has 1 readings"), std::string::npos) << uneven;
}

TEST(CaseTable, MayLackReadings) {
    std::string gap = plain;
    gap.replace(gap.find("3.5"), 3, "");
    const json got = answer(gap);
    EXPECT_EQ(got["completeness"]["left_out"], json::array({"forward[1][1]"}));
    EXPECT_FALSE(got["parameters"].contains("R")); // of one reading there is no spread
    EXPECT_TRUE(got["parameters"].contains("M"));
}

TEST(CaseTable, OfARotaryAxisIsKnownByItsUnit) {
    const json got =
        answer("# readings: deviations\n# axis: C\ntarget [deg],+ [arcsec]\n0,1\n90,2\n");
    EXPECT_EQ(got["axis"]["kind"], "rotary");
}

TEST(CaseTable, IsRefusedByLineAndColumnWithTheWayOut) {
    const auto cell = [](const std::string& value) {
        return refusal(statements + "target [mm];run1 + [um]\n0;" + value + "\n500;2\n");
    };
    EXPECT_NE(cell("x").find("table line 4, column run1 + [um]: 'x' is not a number"),
              std::string::npos);
    EXPECT_NE(cell("").find("forward[0]: is empty"), std::string::npos);
    EXPECT_NE(cell("1.234,5").find("thousands"), std::string::npos);
    EXPECT_NE(refusal(statements + "target [mm],run1 + [um]\n0,\"1,234\"\n").find("thousands"),
              std::string::npos);
    EXPECT_NE(refusal(statements + "target [mm];run1 + [um]\n0;1,5\n1;1.5\n").find("comma"),
              std::string::npos);
    EXPECT_NE(refusal(statements + "target [mm],run1 + [um]\n0\n").find("has 1 cells"),
              std::string::npos);
    EXPECT_NE(refusal(statements + "target [mm],\"run1 + [um]\n0,1\n").find("quote"),
              std::string::npos);
}

TEST(CaseTable, IsRefusedWithoutItsUnitsOrTheKindOfItsReadings) {
    const std::string rows = "0,0.001,-0.001\n500,0.002,0.001\n";
    const std::string bare = refusal("target,run1 +,run1 -\n" + rows);
    EXPECT_NE(bare.find("states no unit"), std::string::npos) << bare;
    EXPECT_NE(bare.find("axiscal case new"), std::string::npos) << bare;
    const std::string kind = refusal("target [mm],run1 + [mm],run1 - [mm]\n" + rows);
    EXPECT_NE(kind.find("# readings: deviations"), std::string::npos) << kind;
    const std::string two = refusal(statements + "target [mm],run1 + [um],run1 - [mm]\n" + rows);
    EXPECT_NE(two.find("one unit for all"), std::string::npos) << two;
    EXPECT_NE(refusal(statements + "target [mm],first [um]\n0,1\n").find("names no approach"),
              std::string::npos);
}

TEST(CaseTable, WhoseStatementsTakeTheColumnsPlaceIsRefused) {
    const std::string rows = "target [mm],run1 + [mm],run1 - [mm]\n0,0.001,-0.001\n";
    for (const std::string key : {"targets", "forward", "backward", "traces"})
        EXPECT_NE(
            refusal(statements + "# " + key + ": 3\n" + rows).find("made of the table's columns"),
            std::string::npos)
            << key;
    EXPECT_NE(refusal(statements + "# customer: B\n# customer.name: C\n" + rows)
                  .find("what another line states as a whole"),
              std::string::npos);
}

TEST(CaseTable, OfAnotherProgramIsRefusedWithWhatIsAccepted) {
    for (const std::string text :
         {"HEADER::\nMachine: X\nTARGETS::\n", "hello", "1;2;3\n4;5;6\n"}) {
        const std::string told = refusal(text);
        EXPECT_NE(told.find("target [mm]"), std::string::npos) << told;
        EXPECT_NE(told.find("axiscal case new positioning --csv FILE"), std::string::npos) << told;
    }
}

TEST(CaseTable, ThatIsEmptySaysSoAndHowOneIsMade) {
    for (const std::string& text :
         {std::string{}, std::string{" \n\r\n"}, std::string{"\xff\xfe"}}) {
        const std::string told = refusal(text);
        EXPECT_NE(told.find("the file is empty"), std::string::npos) << told;
        EXPECT_NE(told.find("axiscal case new positioning --csv FILE"), std::string::npos) << told;
    }
}

TEST(CaseTable, OfCirclesIsTheSameCaseAsJson) {
    const std::string head = "# nominal_radius_mm: 100\n# feed_mm_per_min: 1000\n";
    std::string rows;
    json trace_ccw{{"sense", "ccw"}}, trace_cw{{"sense", "cw"}};
    for (int angle = 0; angle < 360; angle += 30) {
        rows += std::to_string(angle) + ";" + std::to_string(angle % 7) + ",5;" +
                (angle == 90 ? "" : std::to_string(angle % 5)) + "\n";
        trace_ccw["angle_deg"].push_back(angle);
        trace_ccw["radial_deviation_mm"].push_back((angle % 7 + 0.5) / 1000);
        if (angle == 90) continue; // an empty cell
        trace_cw["angle_deg"].push_back(angle);
        trace_cw["radial_deviation_mm"].push_back(angle % 5 / 1000.0);
    }
    const json in_json = test::answer_to({{"analysis", "circular"},
                                          {"nominal_radius_mm", 100},
                                          {"feed_mm_per_min", 1000},
                                          {"traces", {trace_ccw, trace_cw}}});
    EXPECT_EQ(answer(head + "angle [deg];ccw [um];cw [um]\n" + rows), in_json);
}

// Below the header # is a letter of a name.
TEST(CaseTable, OfAWorkpieceMayNameItsFeaturesByNumber) {
    const json got = answer("# a remark\nfeature,nominal_x,nominal_y,on_machine_y,cmm_y\n"
                            "#1,-20,40,40.001,40.004\n#1,20,40,40.002,40.001\n"
                            "slot 2,-20,80,80.003,80.002\nslot 2,20,80,80.001,80.005\n");
    EXPECT_EQ(got["features"].size(), 2U);
    EXPECT_EQ(got["features"][0]["feature"], "#1");
}

TEST(CaseTable, TemplatesAreTakenAsTheyAre) {
    for (const char* kind : {"positioning", "circular", "workpiece"})
        EXPECT_FALSE(answer(table_template(kind)).empty()) << kind;
    EXPECT_EQ(table_template("drift"), "");
}

} // namespace
} // namespace axiscal::case_table_test
