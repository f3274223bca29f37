#include "tools/axiscal/imports/import_file.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

namespace axiscal::standstills_test {
namespace {

using Json = nlohmann::json;

const std::string map_text = R"(kind = "stream"
unit = "um"
[reading]
signal = "LASER"
scale = -1
offset = 5000
[standstill]
targets = ["0 mm", "10 mm"]
cycle = "standard"
approaches = 1
bidirectional = true
overrun = "1 mm"
window = "1 s"
spread_limit = "1 um"
minimum_samples = 5
)";

/// Ten values a second; the laser reads the other way round, from 5 mm.
class LaserLog {
public:
    LaserLog& go(double to_mm) {
        for (int i = 1; i <= 20; ++i)
            add(at_mm_ + (to_mm - at_mm_) * i / 20);
        at_mm_ = to_mm;
        return *this;
    }
    LaserLog& begin_at(double at_mm) {
        at_mm_ = at_mm;
        return *this;
    }
    LaserLog& stand(int values) {
        for (int i = 0; i < values; ++i)
            add(at_mm_);
        return *this;
    }
    LaserLog& wait(int tenths) {
        at_ += tenths;
        return *this;
    }
    [[nodiscard]] const std::string& text() const { return text_; }

private:
    void add(double position_mm) {
        char line[96];
        std::snprintf(line, sizeof line, "LASER 2026-04-06 12:%02d:%02d.%d00000 %.4f\n", at_ / 600,
                      at_ / 10 % 60, at_ % 10, 5000 - position_mm * 1000);
        text_ += line;
        ++at_;
    }

    int at_ = 0;
    double at_mm_ = -2;
    std::string text_;
};

Result<ImportedFile> imported(const std::string& text) {
    const auto map = import_map(map_text, "map.toml");
    EXPECT_TRUE(map) << (map ? "" : describe(map.error()));
    if (!map) return tl::unexpected<Error>(map.error());
    return import_file(text, *map);
}

TEST(Standstills, OfAStreamWithoutTriggersBecomeItsReadings) {
    LaserLog log;
    log.stand(5).go(0.001).stand(20).go(10.003).stand(20).go(11.5);
    log.go(10.002).stand(20).go(-0.001).stand(20).go(-2);
    const auto file = imported(log.text());
    ASSERT_TRUE(file) << describe(file.error());
    EXPECT_EQ(file->form, "raw stream");
    EXPECT_EQ(file->document.at("unit"), "mm");
    EXPECT_NEAR(file->document.at("forward").at(0).at(0).get<double>(), 0.001, 1e-9);
    EXPECT_NEAR(file->document.at("forward").at(1).at(0).get<double>(), 10.003, 1e-9);
    EXPECT_NEAR(file->document.at("backward").at(1).at(0).get<double>(), 10.002, 1e-9);
    EXPECT_NEAR(file->document.at("backward").at(0).at(0).get<double>(), -0.001, 1e-9);
}

TEST(Standstills, DoNotPassOverASilence) {
    LaserLog log;
    log.stand(5).go(0.001).stand(8).wait(20).stand(1).go(10).stand(20);
    const auto file = imported(log.text());
    ASSERT_FALSE(file);
    EXPECT_NE(describe(file.error()).find("this is no stop"), std::string::npos)
        << describe(file.error());
}

TEST(Standstills, WithWhichTheFileBeginsAreNoPoint) {
    LaserLog log;
    log.begin_at(0).stand(20).go(10).stand(20);
    const auto file = imported(log.text());
    ASSERT_FALSE(file);
    EXPECT_NE(describe(file.error()).find("the file begins there"), std::string::npos)
        << describe(file.error());
}

TEST(Standstills, TakeNoMeanOfTheMapBesides) {
    std::string both = map_text;
    both.insert(both.find("[standstill]"), "take = \"last\"\n");
    EXPECT_FALSE(import_map(both, "map.toml")) << "a window and a last value contradict";
}

} // namespace
} // namespace axiscal::standstills_test
