#include "tools/axiscal/imports/import_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace axiscal::umd_file_test {
namespace {

using Json = nlohmann::json;

/// 10 nm a count.
const std::string map_text = R"(kind = "umd"
axis = "X"
[counts]
per_metre = 100_000_000
[standstill]
targets = ["0 mm", "20 mm", "40 mm"]
cycle = "standard"
approaches = 2
bidirectional = true
overrun = "2 mm"
datum = "-4 mm"
window = "0.5 s"
spread_limit = "1 um"
)";

ImportMap map_of(const std::string& text) {
    auto map = import_map(text, "map.toml");
    EXPECT_TRUE(map) << (map ? "" : describe(map.error()));
    return map.value_or(ImportMap{});
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// 100 samples a second; begins at rest at -4 mm.
class UmdLog {
public:
    UmdLog() {
        text_ = "\r\nSample Frequency = 100.00 Hz\r\n\r\n";
        stand(100);
    }
    UmdLog& go(double to_mm) {
        constexpr double step_mm = 0.4; // 2.4 m/min
        while (std::fabs(to_mm - at_mm_) > step_mm)
            sample(at_mm_ += to_mm > at_mm_ ? step_mm : -step_mm);
        at_mm_ = to_mm;
        return *this;
    }
    UmdLog& stand(int samples, double noise_um = 0) {
        for (int i = 0; i < samples; ++i)
            sample(at_mm_ + (i % 2 == 0 ? noise_um : -noise_um) * 1e-3);
        return *this;
    }
    /// A target with its deviation, after an overrun where the way turns.
    UmdLog& stop(double target_mm, double deviation_um, int samples = 100) {
        return go(target_mm + deviation_um * 1e-3).stand(samples);
    }
    UmdLog& lose(int samples) {
        number_ += samples;
        return *this;
    }
    UmdLog& begin_number_at(long number) {
        number_ = number;
        return *this;
    }
    [[nodiscard]] const std::string& text() const { return text_; }

private:
    void sample(double position_mm) {
        constexpr double counts_per_mm = 1e5;
        constexpr long long at_datum = 7'000'000; // the counter was never zeroed
        const long long count = at_datum + std::llround((position_mm + 4) * counts_per_mm);
        text_ += "D:" + std::to_string(count) + " N:" + std::to_string(number_++) + "\r\n";
    }

    std::string text_;
    double at_mm_ = -4;
    long number_ = 50'211;
};

/// Deviations 1, 2, 3 um forward and 0.5 um less backward, 0.2 um more in the second approach.
UmdLog& cycle(UmdLog& log, double more_um) {
    log.go(-3);
    log.stop(0, 1 + more_um).stop(20, 2 + more_um).stop(40, 3 + more_um).go(43);
    return log.stop(40, 2.5 + more_um).stop(20, 1.5 + more_um).stop(0, 0.5 + more_um).go(-4);
}

UmdLog whole_log() {
    UmdLog log;
    cycle(log, 0);
    cycle(log, 0.2);
    return log;
}

std::string refusal_of(const std::string& text, const std::string& map) {
    const auto file = import_file(text, map_of(map));
    EXPECT_FALSE(file);
    return file ? std::string{} : describe(file.error());
}

void expect_words(const std::string& text, const std::string& words) {
    EXPECT_NE(text.find(words), std::string::npos) << text;
}

void expect_readings(const Json& made) {
    const std::vector<double> targets{0, 20, 40};
    ASSERT_EQ(made.at("targets"), Json(targets));
    EXPECT_EQ(made.at("readings"), "positions");
    EXPECT_EQ(made.at("unit"), "mm");
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 2; ++k) {
            const double forward_um = 1 + static_cast<double>(i) + 0.2 * static_cast<double>(k);
            EXPECT_NEAR(made.at("forward").at(i).at(k).get<double>(), targets[i] + forward_um / 1e3,
                        1e-9);
            EXPECT_NEAR(made.at("backward").at(i).at(k).get<double>(),
                        targets[i] + (forward_um - 0.5) / 1e3, 1e-9);
        }
}

TEST(UmdFile, GivesTheMeanOfTheLastWindowAtEachTargetFromEachSide) {
    const auto file = import_file(whole_log().text(), map_of(map_text));
    ASSERT_TRUE(file) << describe(file.error());
    EXPECT_EQ(file->form, "uMD log");
    EXPECT_EQ(file->document.at("axis").at("name"), "X");
    expect_readings(file->document);
}

TEST(UmdFile, TakesTheLengthOfACountFromTheLight) {
    const std::string light = replaced(map_text, "per_metre = 100_000_000",
                                       "wavelength = \"0.02 um\"\nper_wavelength = 2\nindex = 1");
    EXPECT_FALSE(import_map(light, "map.toml")) << "no light of a laser has 20 nm";
    const std::string red = replaced(map_text, "per_metre = 100_000_000",
                                     "wavelength = \"640 nm\"\nper_wavelength = 64\nindex = 1");
    const auto file = import_file(whole_log().text(), map_of(red));
    ASSERT_TRUE(file) << describe(file.error());
    expect_readings(file->document);
}

TEST(UmdFile, TakesTheRateFromTheMapWhereTheProgramOf2015SaysGap) {
    const std::string gap = replaced(whole_log().text(), "Sample Frequency = 100.00 Hz", "Gap");
    expect_words(refusal_of(gap, map_text), "state rate_Hz");
    const auto file =
        import_file(gap, map_of(replaced(map_text, "[standstill]", "rate_Hz = 100\n[standstill]")));
    ASSERT_TRUE(file) << describe(file.error());
    expect_readings(file->document);
}

TEST(UmdFile, IsReadInStepsAndFromTheFarEndAsTheMapSays) {
    UmdLog log;
    log.go(43).stop(40, 1).stop(20, 1).stop(0, 1);
    std::string map = replaced(map_text, "approaches = 2", "approaches = 1\nbegins = \"high\"");
    map = replaced(map, "bidirectional = true", "bidirectional = false");
    const auto far = import_file(log.text(), map_of(map));
    ASSERT_TRUE(far) << describe(far.error());
    EXPECT_TRUE(far->only_backward);
    UmdLog step;
    for (const double target : {0, 20, 40}) {
        step.go(target - 3).stop(target, 1).go(target - 3).stop(target, 1.2);
        step.go(target + 3).stop(target, 0.5).go(target + 3).stop(target, 0.7);
    }
    const auto steps =
        import_file(step.text(), map_of(replaced(map_text, "\"standard\"", "\"step\"")));
    ASSERT_TRUE(steps) << describe(steps.error());
    EXPECT_NEAR(steps->document.at("backward").at(1).at(1).get<double>(), 20.0007, 1e-9);
}

TEST(UmdFile, FromWhichAStopIsMissingIsRefusedWithThePlace) {
    UmdLog log;
    log.go(-3).stop(0, 1).stop(40, 3);
    const std::string told = refusal_of(log.text(), map_text);
    expect_words(told, "the axis stands at target 3 (40 mm)");
    expect_words(told, "the plan has target 2 (20 mm), approach 1 forward");
    expect_words(told, "At line 261 it was near that target");
    UmdLog twice;
    twice.go(-3).stop(0, 1).go(-3).stop(0, 1);
    expect_words(refusal_of(twice.text(), map_text), "target 1 (0 mm) once more");
    expect_words(refusal_of(UmdLog{}.go(-3).stop(0, 1).text(), map_text),
                 "[file] ends before the axis has stood at target 2 (20 mm), approach 1 forward");
    UmdLog longer = whole_log();
    cycle(longer, 0);
    expect_words(refusal_of(longer.text(), map_text), "after the last point of the plan");
}

TEST(UmdFile, WhoseStopIsTooShortOrNotStillIsRefusedWithTheReason) {
    UmdLog brief;
    brief.go(-3).stop(0, 1).stop(20, 2, 30).stop(40, 3);
    expect_words(refusal_of(brief.text(), map_text), "the window is 0.5 s");
    UmdLog noisy;
    noisy.go(-3).stop(0, 1).go(20).stand(100, 2).stop(40, 3);
    expect_words(refusal_of(noisy.text(), map_text), "spread over 4 um, the limit is 1 um");
    const std::string text = "D:1 N:1\r\nD:90000 N:2\r\nD:180000 N:3\r\n";
    expect_words(refusal_of("Sample Frequency = 2 Hz\r\n" + text, map_text),
                 "does not stand where the file begins");
}

TEST(UmdFile, ThatWasReachedFromTheOtherSideIsRefused) {
    UmdLog log;
    log.go(3).stop(0, 1);
    expect_words(refusal_of(log.text(), map_text), "target 1 (0 mm), approach 1 forward");
}

TEST(UmdFile, WithLostSamplesIsRefusedWithinAWindowAndToldOutside) {
    UmdLog within;
    within.go(-3).go(0).stand(80).lose(2).stand(20);
    expect_words(refusal_of(within.text(), map_text), "2 samples are lost before this line");
    std::string datum = whole_log().text();
    for (const std::string number : {"N:50220\r\n", "N:50221\r\n"}) {
        const auto at = datum.find(number), begin = datum.rfind('\n', at) + 1;
        datum.erase(begin, at + number.size() - begin);
    }
    expect_words(refusal_of(datum, map_text), "the datum: 2 samples are lost before this line");
    UmdLog outside;
    outside.go(-3).go(0.001).stand(20).lose(2).stand(100).stop(20, 2).stop(40, 3).go(43);
    outside.stop(40, 2.5).stop(20, 1.5).stop(0, 0.5).go(-4);
    cycle(outside, 0.2);
    const auto file = import_file(outside.text(), map_of(map_text));
    ASSERT_TRUE(file) << describe(file.error());
    expect_words(file->document.at("note").get<std::string>(), "2 samples are lost, none");
    expect_readings(file->document);
}

TEST(UmdFile, WhoseNumberBeginsAgainShowsItsWidthOrNeedsIt) {
    UmdLog clean;
    clean.begin_number_at(65'500).stand(36).begin_number_at(0);
    cycle(clean, 0);
    cycle(clean, 0.2);
    // From 50310 to 65500 samples are lost at the datum, before any window but the first.
    const auto file = import_file(clean.text(), map_of(map_text));
    ASSERT_TRUE(file) << describe(file.error());
    expect_readings(file->document);
    UmdLog cut;
    cut.begin_number_at(3);
    cycle(cut, 0);
    cycle(cut, 0.2);
    expect_words(refusal_of(cut.text(), map_text), "sequence_bits");
    const std::string bits = replaced(map_text, "[standstill]", "sequence_bits = 16\n[standstill]");
    EXPECT_TRUE(import_file(cut.text(), map_of(bits)));
}

TEST(UmdFile, OfTheTestModeOrOfTwoCapturesIsRefused) {
    const std::string made_up = "R:1 M:2 D:3 V:4 P:5 N:6T\r\n";
    expect_words(refusal_of(made_up, map_text), "test mode");
    const std::string two = UmdLog{}.text() + whole_log().text();
    expect_words(refusal_of(two, map_text), "holds 2 captures, from the lines 2, 105 on");
    const auto second =
        import_file(two, map_of(replaced(map_text, "[standstill]", "segment = 2\n[standstill]")));
    ASSERT_TRUE(second) << describe(second.error());
    expect_readings(second->document);
    expect_words(refusal_of(whole_log().text() + "rubbish\r\n", map_text), "\"rubbish\" is no");
    EXPECT_TRUE(import_file(whole_log().text() + "D:1", map_of(map_text))) << "a line that was cut";
}

TEST(UmdFile, NeedsAMapOfItsKind) {
    const auto bare = import_file(whole_log().text(), std::nullopt);
    ASSERT_FALSE(bare);
    expect_words(describe(bare.error()), "a map of kind \"umd\"");
    expect_words(refusal_of("something;else\n1;2\n", map_text), "is no log of the uMD");
}

std::string refusal_of_map(const std::string& text) {
    const auto map = import_map(text, "map.toml");
    EXPECT_FALSE(map) << text;
    return map ? std::string{} : describe(map.error());
}

TEST(UmdMap, SaysWhatIsMissingOrDoesNotFit) {
    expect_words(refusal_of_map(replaced(map_text, "overrun = \"2 mm\"\n", "")), "overrun");
    expect_words(refusal_of_map(replaced(map_text, "per_metre = 100_000_000\n", "")), "wavelength");
    expect_words(refusal_of_map(replaced(map_text, "\"20 mm\", \"40 mm\"", "\"40 mm\", \"20 mm\"")),
                 "must rise");
    expect_words(refusal_of_map(map_text + "near_tolerance = \"3 mm\"\n"),
                 "two stops cannot be told apart");
    expect_words(refusal_of_map(replaced(map_text, "[counts]", "axis_kind = \"rotary\"\n[counts]")),
                 "counts lengths");
}

} // namespace
} // namespace axiscal::umd_file_test
