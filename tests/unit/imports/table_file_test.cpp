#include "tools/axiscal/imports/import_file.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>

namespace axiscal::table_file_test {
namespace {

using Json = nlohmann::json;

std::string map_text(const std::string& columns, const std::string& more = {}) {
    return "kind = \"table\"\nreadings = \"deviations\"\nunit = \"um\"\ntarget_unit = "
           "\"mm\"\n[columns]\n" +
           columns + more;
}

Result<ImportedFile> imported(const std::string& text, const std::string& map) {
    const auto read = import_map(map, "map.toml");
    EXPECT_TRUE(read) << (read ? "" : describe(read.error()));
    if (!read) return tl::unexpected<Error>(read.error());
    return import_file(text, *read);
}

Json case_of(const std::string& text, const std::string& map) {
    const auto file = imported(text, map);
    EXPECT_TRUE(file) << (file ? "" : describe(file.error()));
    return file ? file->document : Json{};
}

void expect_both_ways(const Json& made) {
    EXPECT_EQ(made.at("targets"), Json({0.0, 100.0, 200.0}));
    EXPECT_EQ(made.at("forward"), Json({{0.5, 1.5}, {2.5, 3.5}, {4.0, 5.0}}));
    EXPECT_EQ(made.at("backward"), Json({{-0.5, -1.5}, {1.0, 1.25}, {3.0, 3.25}}));
    EXPECT_EQ(made.at("unit"), "um");
    EXPECT_EQ(made.at("target_unit"), "mm");
}

/// As a program in a German shop exports it, behind lines about the machine.
const std::string german = "Maschine;BAZ 4\nPr\xfc"
                           "fer;M\xfcller\n\nLauf;Soll;Fehler;Richtung\n"
                           "1;0;0,5;auf\n1;100;2,5;auf\n1;200;4,0;auf\n"
                           "1;200;3,0;ab\n1;100;1,0;ab\n1;0;-0,5;ab\n"
                           "2;0;1,5;auf\n2;100;3,5;auf\n2;200;5,0;auf\n"
                           "2;200;3,25;ab\n2;100;1,25;ab\n2;0;-1,5;ab\n;;;\n";
const std::string german_map = map_text("target = \"Soll\"\nreading = \"Fehler\"\nrun = \"Lauf\"\n"
                                        "direction = \"Richtung\"\n",
                                        "[direction]\nforward = [\"auf\"]\nbackward = [\"ab\"]\n");

TEST(TableFile, BelowALineOfASampleFrequencyIsATableAllTheSame) {
    expect_both_ways(case_of("Sample Frequency;100\n" + german, german_map));
}

TEST(TableFile, OfAnotherProgramBecomesACaseByItsMap) {
    expect_both_ways(case_of(german, german_map));
}

TEST(TableFile, WithoutDirectionsGoesByTheOrderOfTheTargets) {
    expect_both_ways(case_of(german, map_text("target = \"Soll\"\nreading = \"Fehler\"\n")));
    expect_both_ways(
        case_of(german, map_text("target = \"Soll\"\nreading = \"Fehler\"\nrun = \"Lauf\"\n")));
}

/// Where the axis was in place of where it was to be: each row another target, and most a turn.
TEST(TableFile, WhoseTargetsAreNoneIsRefusedBeforeMemoryEnds) {
    const std::string map = map_text("target = \"Soll\"\nreading = \"Fehler\"\n");
    std::string targets = "Soll;Fehler\n", runs = targets;
    for (int i = 0; i < 20'000; ++i)
        targets += std::to_string((i * 7919) % 20'011) + ";1\n";
    for (int i = 0; i < 20'000; ++i)
        runs += std::to_string(i % 2) + ";1\n" + std::to_string(i % 2) + ";1\n";
    for (const auto& [text, words] :
         {std::pair{targets, "more than 10000 targets"}, std::pair{runs, "more than 2000 runs"}}) {
        const auto file = imported(text, map);
        ASSERT_FALSE(file);
        EXPECT_NE(describe(file.error()).find(words), std::string::npos) << describe(file.error());
    }
}

TEST(TableFile, WithoutHeadingsGoesByTheNumbersOfItsColumns) {
    std::string bare = german.substr(german.find("1;0;"));
    expect_both_ways(case_of(bare, map_text("target = \"2\"\nreading = \"3\"\n")));
    expect_both_ways(case_of(german, map_text("target = \"2\"\nreading = \"3\"\n")));
}

/// A row a target, a column a run.
const std::string wide =
    "Report 7\n\nPos,Hin 1,Hin 2,Her 1,Her 2\n0,0.5,1.5,-0.5,-1.5\n100,2.5,3.5,1.0,1.25\n"
    "200,4.0,5.0,3.0,3.25\n";
const std::string wide_map = map_text(
    "target = \"Pos\"\nforward = [\"Hin 1\", \"Hin 2\"]\nbackward = [\"Her 1\", \"Her 2\"]\n");

TEST(TableFile, WithAColumnForEachRunSaysItsDirectionsByTheMap) {
    const Json made = case_of(wide, wide_map);
    expect_both_ways(made);
    EXPECT_EQ(made.at("note"), "imported, readings by others");
    expect_both_ways(case_of(
        wide, map_text("target = \"1\"\nforward = [\"2\", \"3\"]\nbackward = [\"4\", \"5\"]\n")));
    std::string headed = wide;
    headed.replace(headed.find("Hin 1,Hin 2,Her 1,Her 2"), 23, "1,2,3,4");
    expect_both_ways(case_of(
        headed,
        map_text("target = \"Pos\"\nforward = [\"1\", \"2\"]\nbackward = [\"3\", \"4\"]\n")));
    for (const auto& [from, to, words] :
         {std::array{"200,4.0", ",4.0", "[table line 6, target]"},
          std::array{"4.0,5.0,3.0,3.25", ",,,", "has a target and no reading"},
          std::array{"2.5", "2,5", "another"}}) {
        std::string broken = wide;
        broken.replace(broken.find(from), std::string{from}.size(), to);
        EXPECT_FALSE(imported(broken, wide_map)) << words;
    }
    EXPECT_FALSE(imported(wide, map_text("target = \"Pos\"\nforward = [\"Hin 1\", \"Hin 1\"]\n")));
    std::string gap = wide;
    gap.replace(gap.find("3.25"), 4, "");
    const auto refused = imported(gap, wide_map);
    ASSERT_FALSE(refused);
    EXPECT_NE(describe(refused.error()).find("run Her 2 has no reading of target 3"),
              std::string::npos);
    const auto other =
        imported(wide, map_text("target = \"Pos\"\nforward = [\"Hin 1\", \"Hin 3\"]\n"));
    ASSERT_FALSE(other);
    EXPECT_NE(describe(other.error()).find("[table line 3] has no column Hin 3"),
              std::string::npos);
}

TEST(TableFile, ThatDoesNotFitItsMapIsRefusedWithThePlace) {
    const auto refused = [](const std::string& text, const std::string& map) {
        const auto file = imported(text, map);
        EXPECT_FALSE(file);
        return file ? std::string{} : describe(file.error());
    };
    const auto has = [](const std::string& text, const std::string& words) {
        EXPECT_NE(text.find(words), std::string::npos) << text;
    };
    has(refused(german, map_text("target = \"Ziel\"\nreading = \"Fehler\"\n")),
        "no line has the columns Ziel and Fehler");
    has(refused(german, map_text("target = \"Soll\"\nreading = \"Fehler\"\nrun = \"Run\"\n")),
        "[table line 4] has no column Run");
    std::string other = german;
    other.replace(other.find(";ab"), 3, ";zu");
    has(refused(other, german_map), "table line 8");
    has(refused(other, german_map), "'zu' is neither forward nor backward");
    std::string word = german;
    word.replace(word.find("2,5"), 3, "n/a");
    has(refused(word, german_map), "table line 6, reading");
    std::string twice = german;
    twice.replace(twice.find("1;100;1,0"), 9, "1;200;1,0");
    has(refused(twice, german_map), "run 1 backward has target 3 twice");
}

TEST(ImportFile, ThatNobodyKnowsSaysWhatItsFirstLineHolds) {
    const auto file = import_file("Soll;Fehler\n0;1\n", std::nullopt);
    ASSERT_FALSE(file);
    EXPECT_NE(describe(file.error()).find("--map"), std::string::npos);
    EXPECT_NE(describe(file.error()).find("Soll, Fehler"), std::string::npos);
}

TEST(ImportFile, ThatIsEmptyOrJsonIsToldSo) {
    EXPECT_NE(describe(import_file("\n \n", std::nullopt).error()).find("is empty"),
              std::string::npos);
    EXPECT_NE(describe(import_file("{}", std::nullopt).error()).find("axiscal analyze"),
              std::string::npos);
}

TEST(ImportFile, OfOurOwnFormNeedsNoMap) {
    const auto file =
        import_file("# readings: deviations\ntarget [mm],run1 + [um],run2 + [um]\n0,1,2\n9,3,4\n",
                    std::nullopt);
    ASSERT_TRUE(file) << describe(file.error());
    EXPECT_EQ(file->document.at("forward"), Json({{1.0, 2.0}, {3.0, 4.0}}));
}

std::string refusal_of_map(const std::string& text) {
    const auto map = import_map(text, "map.toml");
    EXPECT_FALSE(map) << text;
    return map ? std::string{} : describe(map.error());
}

TEST(ImportMap, NamesFileLineAndKeyOfWhatIsWrong) {
    EXPECT_NE(refusal_of_map("kind = \"tabel\"\n").find("map.toml:1: kind"), std::string::npos);
    EXPECT_NE(refusal_of_map(map_text("target = \"a\"\nreeding = \"b\"\n")).find("reading"),
              std::string::npos);
    const std::string stream =
        "kind = \"stream\"\nunit = \"mm\"\n[reading]\nsignal = \"r\"\ntake = \"last\"\n"
        "[target]\nsignal = \"t\"\n[capture]\nsignal = \"c\"\n";
    EXPECT_NE(refusal_of_map(stream + "digits = \"dxp\"\nforward = 1\nbackward = 2\n")
                  .find("map.toml:10"),
              std::string::npos);
    EXPECT_NE(refusal_of_map(stream + "digits = \"d\"\nforward = 1\nbackward = 1\n")
                  .find("is the digit of forward"),
              std::string::npos);
}

} // namespace
} // namespace axiscal::table_file_test
