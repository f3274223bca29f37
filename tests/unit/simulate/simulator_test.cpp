// The whole world behind its wires: positions in, records out, read back by the counter's
// arithmetic alone.
#include "simulator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <unistd.h>

namespace axiscal::simulate::simulator_test {
namespace {

class SimulatorTest : public testing::Test {
protected:
    SimulatorTest() {
        std::string name = (std::filesystem::temp_directory_path() / "world-XXXXXX").string();
        folder_ = ::mkdtemp(name.data());
        scenario_.laser.path = (folder_ / "laser").string();
        scenario_.laser.kind = "umd2-heterodyne";
        scenario_.laser.counts_per_cycle = 1;
        scenario_.errors.linear_um_per_m = 10;
        scenario_.errors.reversal_um = -3;
        scenario_.cnc.emplace();
    }
    ~SimulatorTest() override {
        if (wire_ >= 0) ::close(wire_);
        std::filesystem::remove_all(folder_);
    }
    void open() {
        auto opened = Simulator::open(scenario_);
        ASSERT_TRUE(opened) << opened.error().detail;
        world_ = std::move(*opened);
        wire_ = ::open(scenario_.laser.path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK);
        ASSERT_GE(wire_, 0);
    }
    /// Feeds one line of the stream and returns the record's fields.
    std::vector<std::int64_t> record_of(const std::string& values, StreamFields places = {}) {
        world_->feed_lines(std::to_string(line_++) + " " + values + "\n", places);
        char text[256] = {};
        if (::read(wire_, text, sizeof text - 1) <= 0) return {};
        std::istringstream fields{text};
        std::vector<std::int64_t> record;
        for (std::int64_t field = 0; fields >> field;)
            record.push_back(field);
        return record;
    }
    std::vector<std::int64_t> record_at(double drive_mm) {
        return record_of(std::to_string(drive_mm) + " 0 0");
    }
    /// From the start of the counter.
    [[nodiscard]] double displacement_um(const std::vector<std::int64_t>& record) const {
        const double count =
            static_cast<double>(record.at(2)) - static_cast<double>(record.at(4)) / 65536.0;
        const double n = 1 + refractivity(air_at(scenario_.air, 0), nm(632.991354));
        return count * 0.632991354 / (2 * n);
    }
    /// Goes there in steps; the slide's displacement from the start of the counter, um.
    double measured_um(double from_mm, double to_mm) {
        std::vector<std::int64_t> record;
        for (int i = 0; i <= 100; ++i)
            record = record_at(from_mm + (to_mm - from_mm) * i / 100.0);
        return displacement_um(record);
    }
    std::filesystem::path folder_;
    Scenario scenario_;
    std::unique_ptr<Simulator> world_;
    int wire_ = -1, line_ = 0;
};

TEST_F(SimulatorTest, TheWireShowsTheInjectedErrors) {
    open();
    const double start = measured_um(0, 0);
    const double forward = measured_um(0, 100) - start;
    measured_um(100, 120);
    const double backward = measured_um(120, 100) - start;
    // 10 um/m over 100 mm is 1 um; 2 nm: the count's fraction and six decimals of the stream
    EXPECT_NEAR(forward, 100000 + 1.0, 2e-3);
    EXPECT_NEAR(forward - backward, -3.0, 2e-3);
}

TEST_F(SimulatorTest, OverrunLinesAndHalfLinesAreNoSamples) {
    open();
    EXPECT_EQ(record_at(1).at(5), 1);
    EXPECT_EQ(world_->feed_lines("overrun\n7 2.0", {}), "7 2.0");
    EXPECT_EQ(record_at(1).at(5), 2);
}

TEST_F(SimulatorTest, TheTableThatAStreamTurnsTakesTheReflectorsBack) {
    scenario_.errors = {};
    scenario_.laser.rate_hz = 1000;
    scenario_.indexing_table.emplace(); // 5 degrees a step, 60 degrees/s, an arm of 32.61 mm
    open();
    const auto rest_um = [&](const std::string& axis_deg, const std::string& position) {
        std::vector<std::int64_t> record;
        for (int i = 0; i < 500; ++i) // half a second; a step takes 5/60 s and 60/2000 s
            record = record_of("0 0 0 " + axis_deg + " " + position, {.laser = 4, .table = 5});
        return displacement_um(record);
    };
    const auto chord_um = [](double deg) { return 32610 * std::sin(deg * std::numbers::pi / 180); };
    // 2 nm: as on the linear axis
    EXPECT_NEAR(rest_um("0", "0"), 0, 2e-3);
    EXPECT_NEAR(rest_um("4", "0"), chord_um(4), 2e-3);
    EXPECT_NEAR(rest_um("4", "1"), chord_um(-1), 2e-3);
    EXPECT_NEAR(rest_um("-4", "-1"), chord_um(1), 2e-3);
    // a stream without a field for it leaves the table where it is
    EXPECT_NEAR(displacement_um(record_of("0 0 0 -4 0", {.laser = 4})), chord_um(1), 2e-3);
}

TEST_F(SimulatorTest, BehindAPrismTheWireShowsTheMotionAcross) {
    scenario_.straightness.emplace().across.table = {{0, 0}, {100, 36}};
    open();
    const double start = measured_um(0, 0);
    // 36 um by a factor of 36; 2 nm: as along the axis
    EXPECT_NEAR(measured_um(0, 100) - start, 1.0, 2e-3);
}

/// What a bar's counter sent last, by a laser with a corner cube; -1: nothing.
double bar_um(int wire) {
    char text[256] = {};
    if (::read(wire, text, sizeof text - 1) <= 0) return -1.0;
    std::istringstream fields{text};
    std::vector<double> record;
    for (double field = 0; fields >> field;)
        record.push_back(field);
    return (record.at(2) - record.at(4) / 65536.0) * 0.632991354 / 2;
}

TEST_F(SimulatorTest, ABallbarFollowsTheAxesOfItsPlane) {
    BallbarScenario bar;
    bar.path = (folder_ / "bar").string();
    bar.plane = "ZX";
    bar.scale_first_um_per_m = 100; // of Z
    bar.rate_hz = 1000;
    scenario_.ballbar = bar;
    open();
    const int wire = ::open(bar.path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK);
    ASSERT_GE(wire, 0);
    const auto read_um = [&](const std::string& line) {
        world_->feed_lines(line, {});
        return bar_um(wire);
    };
    // the bar was zeroed at its radius of 100 mm; 1e-4 of that is 10 um; the count's fraction
    EXPECT_NEAR(read_um("1 0 77 100 0 0\n"), 10.0, 1e-4);
    EXPECT_NEAR(read_um("2 100 77 0 0 0\n"), 0.0, 1e-4);
    EXPECT_EQ(read_um("3 100\n"), -1.0); // one axis is no place in a plane
    ::close(wire);
}

TEST_F(SimulatorTest, ABallbarBeyondItsStrokeStaysAtItsEnd) {
    BallbarScenario bar;
    bar.path = (folder_ / "bar").string();
    bar.rate_hz = 1000;
    bar.stroke_um = 50;
    scenario_.ballbar = bar; // XY, a radius of 100 mm
    open();
    const int wire = ::open(bar.path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK);
    ASSERT_GE(wire, 0);
    const auto read_um = [&](const std::string& line) {
        world_->feed_lines(line, {});
        return bar_um(wire);
    };
    EXPECT_NEAR(read_um("1 100.02 0 0\n"), 20, 1e-4);
    EXPECT_NEAR(read_um("2 101.5 0 0\n"), 50, 1e-4);
    EXPECT_NEAR(read_um("3 98.5 0 0\n"), -50, 1e-4);
    ::close(wire);
}

TEST_F(SimulatorTest, ControlChangesTheLaser) {
    open();
    record_at(0);
    EXPECT_TRUE(world_->command("beam off")["ok"].get<bool>());
    EXPECT_EQ(record_at(0).at(1), 0); // MEAS
    world_->command("beam on");
    world_->command("restart-counter");
    EXPECT_EQ(record_at(5).at(5), 1);
    EXPECT_EQ(record_at(5).at(2), 0); // DISP: the zero is where it stood
    world_->command("skip 4");
    EXPECT_EQ(record_at(5).at(5), 7);
    world_->command("fields 16");
    EXPECT_EQ(record_at(5).size(), 16U);
    world_->command("sensor laser off");
    EXPECT_TRUE(record_at(5).empty());
}

TEST_F(SimulatorTest, ControlRefusesInWords) {
    open();
    for (const char* wrong : {"dance", "beam sideways", "sensor nobody off", "sensor laser loud",
                              "skip", "run /nowhere.ngc", "connect host", "truth /nowhere/x"}) {
        const auto answer = world_->command(wrong);
        EXPECT_FALSE(answer["ok"].get<bool>()) << wrong;
        EXPECT_FALSE(answer["error"].get<std::string>().empty()) << wrong;
    }
    EXPECT_EQ(world_->command("status")["program"], "idle");
    world_->command("quit");
    EXPECT_TRUE(world_->ended());
}

TEST_F(SimulatorTest, RefusesAProgramThatItDoesNotUnderstand) {
    open();
    const std::string path = (folder_ / "wrong.ngc").string();
    std::ofstream{path} << "G0 X1\nG2 X3 I1\n";
    const auto answer = world_->command("run " + path);
    if (answer["ok"].get<bool>()) GTEST_FAIL() << "a program with G2 was started";
    EXPECT_EQ(answer["error"], "line 2: G2 is not understood");
}

} // namespace
} // namespace axiscal::simulate::simulator_test
