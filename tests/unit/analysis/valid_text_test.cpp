#include "analysis/quantity/valid_text.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <random>

namespace axiscal::valid_text_test {
namespace {

// The Unicode Standard 15.0, 3.9, tables 3-8 to 3-11: how many U+FFFD each ill-formed text becomes.
TEST(ValidText, ReplacesTheExamplesOfTheUnicodeStandard) {
    const std::string f = "\xEF\xBF\xBD";
    const std::map<std::string, std::string> examples{
        {"\xC0\xAF\xE0\x80\xBF\xF0\x81\x82\x41", f + f + f + f + f + f + f + f + "A"},
        {"\xED\xA0\x80\xED\xBF\xBF\xED\xAF\x41", f + f + f + f + f + f + f + f + "A"},
        {"\xF4\x91\x92\x93\xFF\x41\x80\xBF\x42", f + f + f + f + f + "A" + f + f + "B"},
        {"\xE1\x80\xE2\xF0\x91\x92\xF1\xBF\x41", f + f + f + f + "A"}};
    for (const auto& [bytes, text] : examples)
        EXPECT_EQ(valid_text(bytes), text);
}

TEST(ValidText, MakesOneLineOfControlCharacters) {
    const std::string bytes = std::string{"a\0b", 3} +
                              "\r\nc\x1B[31m\x7F\xC2\x85\xC2\x9F\xE2\x80\xA8\xE2\x80\xA9"
                              "d\xC2\xA0";
    EXPECT_EQ(valid_text(bytes), "a b  c [31m     d\xC2\xA0");
}

TEST(ValidText, LeavesWhatPeopleWrite) {
    for (const char* text :
         {"", "bay 3", "Prüfstand Ä", "工位三", "станок №2", "\xF0\x9F\x94\xA7 <b>&", "../../out",
          "(a%b)", "\xEF\xBF\xBD", "\xF4\x8F\xBF\xBF"})
        EXPECT_EQ(valid_text(text), text);
}

TEST(IdOfName, FoldsByTheRuleOfTheRunFile) {
    const std::map<std::string, std::string> rule{{"bay 3", "bay-3"},
                                                  {"../../out", "out"},
                                                  {"hall3/bay2", "hall3-bay2"},
                                                  {"bench_1-b", "bench_1-b"},
                                                  {"a -- b.", "a-b"},
                                                  {"Prüfstand 2", "Pr-fstand-2"},
                                                  {"工位三", "station"},
                                                  {"", "station"},
                                                  {"...", "station"},
                                                  {"CON", "CON_"},
                                                  {"lpt1", "lpt1_"},
                                                  {"nul.", "nul_"},
                                                  {"COM10", "COM10"},
                                                  {std::string{"a\0b", 3}, "a-b"},
                                                  {"~/x", "x"},
                                                  {"-rf", "rf"}};
    for (const auto& [name, id] : rule)
        EXPECT_EQ(id_of_name(name, "station", longest_station_part), id) << name;
}

TEST(IdOfName, BoundsTheLengthAndEndsInNoHyphen) {
    EXPECT_EQ(id_of_name(std::string(99, 'x'), "axis", 15), std::string(15, 'x'));
    EXPECT_EQ(id_of_name(std::string(14, 'x') + " y", "axis", 15), std::string(14, 'x'));
}

/// Bytes of all kinds: noise, letters, well-formed characters of every length, names of devices.
std::string random_bytes(std::mt19937& dice) {
    static const std::vector<std::string> pieces{
        "a",  "Z", "7",  "_",   "-", ".",    " ",    "/",        "\\",   ":",
        "%",  "(", ")",  "\n",  "ä", "三",   "🔧",    "CON",      "nul",  "COM1",
        "..", "~", "\"", "<b>", "&", "\xFF", "\xC0", "\xED\xA0", "\xF4", "\xE2\x80"};
    std::string bytes;
    for (auto left = dice() % 60; left > 0; --left)
        bytes += dice() % 3 == 0 ? std::string(1, static_cast<char>(dice() % 256))
                                 : pieces[dice() % pieces.size()];
    return bytes;
}

/// As other systems ask for it: POSIX portable names (IEEE 1003.1, 3.282), Microsoft "Naming
/// Files".
bool is_a_name_everywhere(const std::string& id) {
    const bool portable = std::ranges::all_of(id, [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '_' || c == '-';
    });
    std::string lower = id;
    std::ranges::transform(lower, lower.begin(),
                           [](char c) { return c >= 'A' && c <= 'Z' ? c + 32 : c; });
    bool device = lower == "con" || lower == "prn" || lower == "aux" || lower == "nul";
    for (char digit = '0'; digit <= '9'; ++digit)
        device =
            device || lower == std::string{"com"} + digit || lower == std::string{"lpt"} + digit;
    return portable && !device && !id.empty() && id.front() != '-' && id.back() != '-';
}

TEST(IdOfName, MakesANameForEverySystemOfAnyBytesAndKeepsIt) {
    std::mt19937 dice{20261121};
    for (int i = 0; i < 20'000; ++i) {
        const std::string bytes = random_bytes(dice);
        const std::size_t longest = 5 + dice() % 40;
        const std::string id = id_of_name(bytes, "axis", longest);
        ASSERT_TRUE(is_a_name_everywhere(id)) << ::testing::PrintToString(bytes) << " -> " << id;
        ASSERT_LE(id.size(), longest);
        ASSERT_EQ(id_of_name(id, "axis", longest), id);
    }
}

TEST(ValidText, OfAnyBytesIsValidOnceAndForAll) {
    std::mt19937 dice{20261121};
    for (int i = 0; i < 20'000; ++i) {
        const std::string bytes = random_bytes(dice), text = valid_text(bytes);
        ASSERT_EQ(valid_text(text), text);
        ASSERT_TRUE(std::ranges::none_of(
            text, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }));
    }
}

} // namespace
} // namespace axiscal::valid_text_test
