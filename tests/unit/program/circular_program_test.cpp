// The program of a circular test, driven by a small reading of it: where the tool goes, block by
// block.

#include "acquisition/program/circular_program.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <sstream>

namespace axiscal::circular_program_test {
namespace {

struct Block {
    std::string code; ///< first word
    std::map<char, double> word;
};

/// Blocks with an axis word, and requests ("M68").
std::vector<Block> blocks_of(const std::string& program) {
    std::vector<Block> blocks;
    std::istringstream lines{program};
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words{line};
        Block block;
        words >> block.code;
        if (block.code != "G1" && block.code != "G2" && block.code != "G3" && block.code != "M68")
            continue;
        for (std::string one; words >> one;)
            block.word[one[0]] = std::stod(one.substr(1));
        blocks.push_back(block);
    }
    return blocks;
}

CircularOrder order_of(TriggerShape shape = TriggerShape::single_register) {
    CircularOrder order;
    order.plan.nominal_radius_mm = 100;
    order.plan.feed_mm_per_s = 2000.0 / 60;
    order.plan.centre_mm = {10, 20, 30};
    order.shape = shape;
    return order;
}

struct Driven {
    double ccw_deg = 0, cw_deg = 0; ///< on the circle itself
    std::vector<double> requests;
};

/// Follows the tool in the plane; every arc must keep its radius, every straight way be radial.
Driven follow(const CircularOrder& order, char first, char second) {
    const auto centre = [&](char axis) {
        return order.plan.centre_mm[static_cast<std::size_t>(axis - 'X')];
    };
    Driven driven;
    double a = 0, b = 0;
    bool placed = false;
    for (Block& block : blocks_of(write_circular_linuxcnc(order))) {
        if (block.code == "M68") {
            driven.requests.push_back(block.word['Q']);
            continue;
        }
        const double to_a = block.word.at(first) - centre(first),
                     to_b = block.word.at(second) - centre(second);
        const double radius = std::hypot(a, b), to_radius = std::hypot(to_a, to_b);
        if (block.code == "G1" && placed) {
            EXPECT_NEAR(std::atan2(b, a), std::atan2(to_b, to_a), 1e-6);
        }
        if (block.code != "G1") {
            EXPECT_NEAR(to_radius, radius, 3e-6);
            const auto offset = [&](char axis) { return block.word["IJK"[axis - 'X']]; };
            EXPECT_NEAR(offset(first), -a, 2e-6);
            EXPECT_NEAR(offset(second), -b, 2e-6);
            double turned = std::atan2(to_b, to_a) - std::atan2(b, a);
            const bool ccw = block.code == "G3";
            turned =
                std::fmod((ccw ? turned : -turned) + 4 * std::numbers::pi, 2 * std::numbers::pi);
            if (turned < 1e-6 || turned > 2 * std::numbers::pi - 1e-6)
                turned = 2 * std::numbers::pi;
            if (block.word.contains('P')) // turns in all, the last one perhaps in part
                turned += 2 * std::numbers::pi * (block.word['P'] - 1);
            if (std::fabs(radius - 100) < 1e-3)
                (ccw ? driven.ccw_deg : driven.cw_deg) += turned * 180 / std::numbers::pi;
        }
        a = to_a, b = to_b;
        placed = true;
    }
    return driven;
}

TEST(CircularProgram, DrivesBothSensesWithOvershootAndAsksBeforeEach) {
    const Driven driven = follow(order_of(), 'X', 'Y');
    EXPECT_NEAR(driven.ccw_deg, 720, 1e-4);
    EXPECT_NEAR(driven.cw_deg, 720, 1e-4);
    EXPECT_EQ(driven.requests, (std::vector<double>{0, 1, 2, 3})); // 3 ends the test
}

TEST(CircularProgram, TurnsTheFirstAxisToTheSecondInEveryPlane) {
    for (const auto& [plane, code, axes] : {std::tuple{CircularPlane::xy, "G17", "XY"},
                                            {CircularPlane::yz, "G19", "YZ"},
                                            {CircularPlane::zx, "G18", "ZX"}}) {
        CircularOrder order = order_of();
        order.plan.plane = plane;
        order.plan.repeats = 2;
        EXPECT_NE(write_circular_linuxcnc(order).find(code), std::string::npos);
        const Driven driven = follow(order, axes[0], axes[1]);
        EXPECT_NEAR(driven.ccw_deg, 1440, 1e-4) << axes;
        EXPECT_NEAR(driven.cw_deg, 1440, 1e-4) << axes;
    }
}

TEST(CircularProgram, AnArcOfOneSenseIsDrivenBackAtTheRadiusOfRest) {
    CircularOrder order = order_of();
    order.plan.senses = {Sense::ccw};
    order.plan.start_deg = -20;
    order.plan.arc_deg = 220;
    order.plan.overshoot_deg = 10;
    order.plan.repeats = 2;
    order.plan.feed_in_outside = false;
    const Driven driven = follow(order, 'X', 'Y'); // and every way is an arc or radial
    EXPECT_NEAR(driven.ccw_deg, 480, 1e-4);
    EXPECT_NEAR(driven.cw_deg, 0, 1e-4);
    int back = 0;
    for (const Block& block : blocks_of(write_circular_linuxcnc(order)))
        back += block.code == "G2" ? 1 : 0;
    EXPECT_EQ(back, 1);
}

TEST(CircularProgram, ByTriggerTheNumberChangesWithBothEndsOfTheArc) {
    CircularOrder order = order_of();
    order.plan.start = StartMethod::trigger;
    const std::string text = write_circular_linuxcnc(order);
    for (const char* words : {"M67 E0 Q2\nG3", "M67 E0 Q3\nG1", "M68 E0 Q4\n", "M67 E0 Q5\nG2",
                              "M67 E0 Q6\nG1", "M68 E0 Q7\n"})
        EXPECT_NE(text.find(words), std::string::npos) << words;
    EXPECT_EQ(write_circular_linuxcnc(order_of()).find("M67"), std::string::npos);
}

TEST(CircularProgram, ACoilIsRaisedAndTakenBack) {
    const std::string text = write_circular_linuxcnc(order_of(TriggerShape::coil_and_index));
    EXPECT_NE(text.find("M64 P0\nM66 P0 L3"), std::string::npos);
    EXPECT_NE(text.find("M65 P0\nM66 P0 L4"), std::string::npos);
    EXPECT_EQ(write_circular_linuxcnc(order_of(TriggerShape::dwell)).find("M66"),
              std::string::npos);
}

} // namespace
} // namespace axiscal::circular_program_test
