#include "config/settings.hpp"
#include "tests/unit/config/station_text.hpp"

#include <gtest/gtest.h>
#include <random>

namespace axiscal::settings_test {
namespace {

using test::document_of;
using test::told;

bool contains(const std::string& text, std::string_view part) {
    return text.find(part) != std::string::npos;
}
#define EXPECT_TOLD(text, part) EXPECT_TRUE(contains(text, part)) << (text)

Length read_length(const std::string& value) {
    auto document = document_of("x = \"" + value + "\"");
    const Length length = document.root().length("x", metre(-100), metre(100));
    EXPECT_EQ(told(document), "") << value;
    return length;
}

TEST(Settings, ReadsALengthInEachUnit) {
    EXPECT_DOUBLE_EQ(read_length("0.5 mm").si(), 0.0005);
    EXPECT_DOUBLE_EQ(read_length("3 um").si(), 3e-6);
    EXPECT_DOUBLE_EQ(read_length("3 \u00B5m").si(), 3e-6);
    EXPECT_DOUBLE_EQ(read_length("3 \u03BCm").si(), 3e-6);
    EXPECT_DOUBLE_EQ(read_length("632.991354 nm").si(), 632.991354e-9);
    EXPECT_DOUBLE_EQ(read_length("1.5 m").si(), 1.5);
    EXPECT_DOUBLE_EQ(read_length("1 in").si(), 0.0254);
    EXPECT_DOUBLE_EQ(read_length("2cm").si(), 0.02);
    EXPECT_DOUBLE_EQ(read_length(" -4.25  mm ").si(), -0.00425);
    EXPECT_DOUBLE_EQ(read_length("+1e2 mm").si(), 0.1);
}

TEST(Settings, ReadsEveryOtherDimension) {
    auto document = document_of(R"toml(
        feed = "1.2 m/min"
        slope = "1 um/s"
        dwell = "0.1 s"
        poll = "75 ms"
        room = "293.15 K"
        shop = "23 °C"
        change = "-0.2 K"
        air = "1013.25 mbar"
        low = "98 kPa"
        humid = "50 %"
        co2 = "450 ppm"
        steel = "11.5 um/(m*K)"
        glass = "8e-6 1/K"
        scale = "10.4 ppm/K"
        turn = "90 arcsec"
        spin = "360 deg/min"
    )toml");
    Settings root = document.root();
    EXPECT_DOUBLE_EQ(root.speed("feed", {}, metre_per_second(1)).si(), 0.02);
    EXPECT_DOUBLE_EQ(root.speed("slope", {}, metre_per_second(1)).si(), 1e-6);
    using namespace std::chrono_literals;
    EXPECT_EQ(root.duration("dwell", 0s, 10s), 100ms);
    EXPECT_EQ(root.duration("poll", 0s, 10s), 75ms);
    const auto freezing = Temperature::celsius(0), hot = Temperature::celsius(60);
    EXPECT_NEAR(root.temperature("room", freezing, hot).in_celsius(), 20, 1e-12);
    EXPECT_DOUBLE_EQ(root.temperature("shop", freezing, hot).in_celsius(), 23);
    EXPECT_DOUBLE_EQ(root.temperature_difference("change", kelvin(-1), kelvin(1)).si(), -0.2);
    EXPECT_DOUBLE_EQ(root.pressure("air", {}, pascal(2e5)).si(), 101325);
    EXPECT_DOUBLE_EQ(root.pressure("low", {}, pascal(2e5)).si(), 98000);
    EXPECT_DOUBLE_EQ(root.ratio("humid", {}, unity(1)).si(), 0.5);
    EXPECT_DOUBLE_EQ(root.ratio("co2", {}, unity(1)).si(), 450e-6);
    EXPECT_DOUBLE_EQ(root.expansion("steel", {}, per_kelvin(1)).si(), 11.5e-6);
    EXPECT_DOUBLE_EQ(root.expansion("glass", {}, per_kelvin(1)).si(), 8e-6);
    EXPECT_DOUBLE_EQ(root.expansion("scale", {}, per_kelvin(1)).si(), 10.4e-6);
    EXPECT_DOUBLE_EQ(root.rotary_length("turn", {}, mm(360)).in(mm), 0.025);
    EXPECT_DOUBLE_EQ(root.rotary_speed("spin", {}, mm_per_minute(1000)).in(mm_per_minute), 360);
    EXPECT_EQ(told(document), "");
}

// Law: what is written in one unit and read is the same length in another, at any size.
TEST(Settings, UnitsOfALengthAgreeWithEachOther) {
    std::mt19937_64 random{1};
    std::uniform_int_distribution<int> whole{-90000, 90000};
    for (int i = 0; i < 200; ++i) {
        const std::string micrometres = std::to_string(whole(random));
        const double in_um = read_length(micrometres + " um").si();
        EXPECT_NEAR(read_length(micrometres + "e-3 mm").si(), in_um, 1e-15);
        EXPECT_NEAR(read_length(micrometres + "e3 nm").si(), in_um, 1e-15);
        EXPECT_NEAR(read_length(micrometres + "e-6 m").si(), in_um, 1e-15);
    }
}

TEST(Settings, RefusesABareNumberWithUnitsAndExample) {
    auto document = document_of("\n[cycle]\noverrun = 2\n");
    document.root().table("cycle").length("overrun", mm(0.1), mm(100));
    const std::string text = told(document);
    EXPECT_TOLD(text, "station.toml:3: cycle.overrun: is a bare number");
    EXPECT_TOLD(text, "mm, um, nm, cm, m, in");
    EXPECT_TOLD(text, "for example \"2 mm\"");
}

TEST(Settings, RefusesTheUnitOfAnotherDimension) {
    auto document = document_of("overrun = \"2 s\"");
    document.root().length("overrun", mm(0.1), mm(100));
    EXPECT_TOLD(told(document), "\"s\" is no unit of a length");
}

TEST(Settings, OffersTheUnitThatWasMeant) {
    auto document = document_of("overrun = \"2 MM\"");
    document.root().length("overrun", mm(0.1), mm(100));
    EXPECT_TOLD(told(document), "did you mean mm?");
}

TEST(Settings, TellsTheRangeInTheUnitOfTheUser) {
    auto document = document_of("window = \"90000 ms\"");
    using namespace std::chrono_literals;
    document.root().duration("window", 50ms, 60s);
    EXPECT_TOLD(told(document), "\"90000 ms\" is out of range: from 50 ms to 60000 ms");
}

TEST(Settings, TakesTheLimitsThemselves) {
    auto document = document_of("a = \"100 mm\"\nb = \"0.1 mm\"\nc = \"10 cm\"\nd = \"100 um\"");
    for (const char* key : {"a", "b", "c", "d"})
        document.root().length(key, mm(0.1), mm(100));
    EXPECT_EQ(told(document), "");
}

TEST(Settings, RefusesWhatIsNoNumber) {
    for (const std::string bad :
         {"", "   ", "mm", "two mm", "nan mm", "inf mm", "1e999 mm", "- mm"}) {
        auto document = document_of("x = \"" + bad + "\"");
        document.root().length("x", metre(-100), metre(100));
        EXPECT_NE(told(document), "") << bad;
    }
}

TEST(Settings, ExplainsADecimalComma) {
    auto document = document_of("x = \"0,5 mm\"");
    document.root().length("x", metre(-1), metre(1));
    EXPECT_TOLD(told(document), "write a point");
}

TEST(Settings, RefusesAnotherKindOfValue) {
    auto document =
        document_of("name = 3\ncount = \"3\"\non = \"yes\"\nrange = [1]\nwhen = 12:00:00\n"
                    "[part]\nx = 1\n");
    Settings root = document.root();
    root.text("name");
    root.integer("count", 1, 9);
    root.flag("on");
    root.length("range", mm(0), mm(1));
    root.date("when");
    root.texts("part");
    const std::string text = told(document);
    EXPECT_TOLD(text, "station.toml:1: name: is a whole number, but a text is wanted");
    EXPECT_TOLD(text, "station.toml:2: count: is a text, but a whole number from 1 to 9");
    EXPECT_TOLD(text, "station.toml:3: on: is a text, but true or false");
    EXPECT_TOLD(text, "station.toml:4: range: is a list, but a length");
    EXPECT_TOLD(text, "station.toml:5: when: is a time of day, but a date");
    EXPECT_TOLD(text, "part: is a table, but a list of texts");
}

TEST(Settings, RefusesWholeNumbersOutOfRangeAndNotFinite) {
    auto document = document_of("port = 70000\nk = inf\nn = nan\nm = 2.5");
    Settings root = document.root();
    root.integer("port", 1, 65535);
    root.number("k", 0, 1);
    root.number("n", 0, 1);
    root.integer("m", 0, 9);
    const std::string text = told(document);
    EXPECT_TOLD(text, "70000 is out of range: from 1 to 65535");
    EXPECT_TOLD(text, "station.toml:2: k");
    EXPECT_TOLD(text, "station.toml:3: n");
    EXPECT_TOLD(text, "station.toml:4: m: is a number, but a whole number");
}

TEST(Settings, NamesTheNearestKeyForAnUnknownOne) {
    auto document = document_of("[cycle]\noverun = \"2 mm\"\nzzz = 1\n");
    document.root().table("cycle").length("overrun", mm(0.1), mm(100), mm(1));
    const std::string text = told(document);
    EXPECT_TOLD(
        text,
        "station.toml:2: cycle.overun: is not a key of this table; did you mean \"overrun\"?");
    EXPECT_TOLD(text, "station.toml:3: cycle.zzz: is not a key of this table: remove it");
}

TEST(Settings, RefusesAnUnknownTableOnce) {
    auto document = document_of("[cicle]\na = 1\nb = 2\n");
    document.root().table("cycle");
    EXPECT_EQ(told(document),
              "station.toml:1: cicle: is not a key of this table; did you mean \"cycle\"?\n");
}

TEST(Settings, LooksForUnknownKeysInEachTableOfAList) {
    auto document = document_of("[[instrument]]\nname = \"a\"\n[[instrument]]\nnmae = \"b\"\n");
    for (Settings& instrument : document.root().tables("instrument"))
        instrument.text("name");
    const std::string text = told(document);
    EXPECT_TOLD(text, "station.toml:3: instrument[1].name: is missing");
    EXPECT_TOLD(
        text,
        "station.toml:4: instrument[1].nmae: is not a key of this table; did you mean \"name\"?");
}

TEST(Settings, AcceptsTheRestOfATableWithoutReader) {
    auto document = document_of("[part]\na = 1\n[part.deep]\nb = 2\n");
    document.root().table("part").accept_rest();
    EXPECT_EQ(told(document), "");
}

TEST(Settings, TellsAllAtOnceByLine) {
    auto document = document_of("a = 1\nb = \"1 s\"\nc = true\n");
    Settings root = document.root();
    root.flag("b");
    root.text("a");
    const auto refusals = document.finish();
    ASSERT_EQ(refusals.size(), 3U);
    EXPECT_EQ(refusals[0].line, 1);
    EXPECT_EQ(refusals[1].line, 2);
    EXPECT_EQ(refusals[2].line, 3);
}

TEST(Settings, MissingKeyNamesItsTableAndAnExample) {
    auto document = document_of("\n\n[cycle]\n");
    document.root().table("cycle").length("overrun", mm(0.1), mm(100));
    EXPECT_EQ(told(document),
              "station.toml:3: cycle.overrun: is missing: add it to [cycle], for example overrun = "
              "\"2 mm\"\n");
}

TEST(Settings, MissingTableRefusesItsRequiredKeysOnly) {
    auto document = document_of("a = 1\n");
    Settings root = document.root();
    root.integer("a", 0, 9);
    Settings cycle = root.table("cycle");
    cycle.text("note", "");
    cycle.speed("feed", {}, metre_per_second(1));
    const std::string text = told(document);
    EXPECT_TOLD(text, "cycle.feed: is missing");
    EXPECT_FALSE(contains(text, "note")) << text;
}

TEST(Settings, ChoiceOffersANearMatch) {
    auto document = document_of("shape = \"sequense-block\"");
    document.root().choice("shape", {"sequence-block", "dwell"});
    EXPECT_TOLD(told(document),
                "\"sequense-block\" is not one of \"sequence-block\", \"dwell\"; did you mean "
                "\"sequence-block\"?");
}

TEST(Settings, ReadsDatesOfBothSpellings) {
    auto document = document_of("a = 2026-02-28\nb = \"2028-02-29\"\nc = \"2026-02-29\"\n"
                                "d = \"21.11.2026\"\ne = \"2026-1-21\"\n");
    Settings root = document.root();
    EXPECT_EQ(root.date("a"), "2026-02-28");
    EXPECT_EQ(root.date("b"), "2028-02-29");
    EXPECT_EQ(root.date("absent", ""), "");
    for (const char* key : {"c", "d", "e"})
        root.date(key);
    const auto refusals = document.finish();
    ASSERT_EQ(refusals.size(), 3U);
    EXPECT_EQ(refusals[0].key, "c");
}

TEST(Settings, NamesTheElementOfAList) {
    auto document = document_of("targets = [\n\"0 mm\",\n\"10\",\n\"20 mm\"]\n");
    Settings root = document.root();
    const auto targets = root.lengths("targets", mm(-100), mm(100));
    EXPECT_EQ(targets.size(), 3U);
    EXPECT_TRUE(root.refused("targets"));
    EXPECT_TOLD(told(document), "station.toml:3: targets[1]: \"10\" has no unit");
}

TEST(Settings, ReadsCorrectionsInStoredUnits) {
    auto document = document_of("a = \"-0.05 K\"\nb = \"0.3 hPa\"\nc = \"1.5 %\"\nd = 0.1\n");
    Settings root = document.root();
    EXPECT_EQ(root.correction("a", 1000).stored_unit, "degC");
    EXPECT_DOUBLE_EQ(root.correction("a", 1000).amount, -0.05);
    EXPECT_EQ(root.correction("b", 1000).stored_unit, "Pa");
    EXPECT_DOUBLE_EQ(root.correction("b", 1000).amount, 30);
    EXPECT_EQ(root.correction("c", 1000).stored_unit, "%");
    EXPECT_EQ(root.correction("absent", 1000).stored_unit, "");
    root.correction("d", 1000);
    EXPECT_TOLD(told(document), "station.toml:4: d: is a bare number");
}

TEST(SettingsDocument, TellsLineAndColumnOfASyntaxError) {
    const auto document = SettingsDocument::parse("a = 1\nb = = 2\n", "station.toml");
    ASSERT_FALSE(document);
    EXPECT_EQ(document.error().fault, Fault::bad_configuration);
    EXPECT_TOLD(document.error().detail, "station.toml:2:5: ");
}

TEST(SettingsDocument, RefusesAKeyGivenTwice) {
    const auto document = SettingsDocument::parse("a = 1\na = 2\n", "station.toml");
    ASSERT_FALSE(document);
    EXPECT_TOLD(document.error().detail, "station.toml:2:");
}

TEST(SettingsDocument, TellsWhichFileCannotBeRead) {
    for (const std::string path : {"/nonexistent/station.toml", "/"}) {
        const auto document = SettingsDocument::load(path);
        ASSERT_FALSE(document) << path;
        EXPECT_EQ(document.error().fault, Fault::bad_configuration);
        EXPECT_TOLD(document.error().detail, path);
    }
}

TEST(SettingsDocument, SurvivesArbitraryBytes) {
    std::mt19937_64 random{7};
    const std::string alphabet = "abc=[]{}\"'#.,\n\r\t 0123-+e:\xC2\xB5\xFF";
    std::uniform_int_distribution<std::size_t> pick{0, alphabet.size() - 1}, length{0, 60};
    int refused = 0;
    for (int i = 0; i < 3000; ++i) {
        std::string text(length(random), ' ');
        for (char& letter : text)
            letter = alphabet[pick(random)];
        auto document = SettingsDocument::parse(text, "noise");
        if (!document && document.error().fault == Fault::bad_configuration) ++refused;
        if (document) document->finish();
    }
    EXPECT_GT(refused, 1000);
}

TEST(Settings, MakesOneLineOfAnEscapedControlCharacter) {
    auto document = SettingsDocument::parse("name = \"bay\\u0000\\u001B[31m\\n3 \u5DE5\"\n"
                                            "names = [\"a\\tb\\u0085\"]\n",
                                            "station.toml")
                        .value();
    EXPECT_EQ(document.root().text("name"), "bay  [31m 3 \u5DE5");
    EXPECT_EQ(document.root().texts("names"), std::vector<std::string>{"a b "});
}

} // namespace
} // namespace axiscal::settings_test
