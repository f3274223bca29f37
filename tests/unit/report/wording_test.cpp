#include "acquisition/documents/pdf/plot_frame.hpp"
#include "acquisition/documents/pdf/wording.hpp"

#include <gtest/gtest.h>

namespace axiscal::wording_test {
namespace {

TEST(Wording, WritesATrueMinusAndNeverMinusZero) {
    EXPECT_EQ(fixed(-3.26, 1), "\u22123.3");
    EXPECT_EQ(fixed(-0.04, 1), "0.0");
    EXPECT_EQ(fixed(-0.0, 2), "0.00");
    EXPECT_EQ(fixed(12, 3), "12.000");
}

TEST(Wording, NeverMakesAnUncertaintySmaller) {
    EXPECT_EQ(fixed_up(2.0588, 1), "2.1");
    EXPECT_EQ(fixed_up(2.01, 1), "2.1");
    EXPECT_EQ(fixed_up(0.1 + 0.2, 1), "0.3"); // 0.30000000000000004 is 0.3
    EXPECT_EQ(fixed_up(0, 1), "0.0");
}

TEST(Wording, WritesFormulasInTheSignsOfPaper) {
    EXPECT_EQ(formula_on_paper("alpha L R(theta) / (2 sqrt 3)"), "α L R(θ) / (2 √3)");
    EXPECT_EQ(formula_on_paper("sqrt(u(E)^2 + u(R_forward)^2)"), "√(u(E)² + u(R↑)²)");
    EXPECT_EQ(formula_on_paper("L (1 - cos delta) / (2 sqrt 3)"), "L (1 - cos δ) / (2 √3)");
}

TEST(Wording, NamesNoDeviceOfTheComputer) {
    EXPECT_EQ(without_device_paths("air: The instrument does not answer: check cable, address and "
                                   "power. nothing came from serial /dev/serial/by-path/"
                                   "pci-0000:00:14.0-usb-0:2:1.0-port0 9600 8E1, tried again"),
              "air: The instrument does not answer: check cable, address and power. nothing came "
              "from its line, tried again");
    EXPECT_EQ(without_device_paths("cannot open /dev/ttyUSB0: gone."),
              "cannot open its line: gone.");
    EXPECT_EQ(without_device_paths("1/min and 3 um/m stay"), "1/min and 3 um/m stay");
}

TEST(Wording, MarksWhatIsDerivedByAFootnote) {
    EXPECT_EQ(footnote_sign("R"), "\u00B9");
    EXPECT_EQ(footnote_sign("S"), "");
    EXPECT_EQ(footnote_of_derived.substr(0, 2), "\u00B9");
}

TEST(Wording, TellsWhatNobodyStated) {
    EXPECT_EQ(stated(""), "not stated");
    EXPECT_EQ(stated(" \t"), "not stated");
    EXPECT_EQ(stated("Hall 3"), "Hall 3");
}

TEST(Wording, TellsACoefficientOfExpansionWithItsUncertaintyOrThatItHasNone) {
    EXPECT_EQ(coefficient_text(11.5e-6, 0.6e-6), "11.50 µm/(m·K), standard uncertainty 0.60");
    EXPECT_EQ(coefficient_text(8e-6, {}), "8.00 µm/(m·K), uncertainty not stated");
}

TEST(Wording, WritesInstantsForPeople) {
    EXPECT_EQ(readable_instant("2026-01-02T08:15:03Z"), "2026-01-02 08:15:03 UTC");
    EXPECT_EQ(readable_instant("2026-01-02"), "2026-01-02");
    EXPECT_EQ(readable_instant(""), "not stated");
}

TEST(Wording, GathersParametersOfOneReason) {
    PositioningResult result;
    result.not_evaluated = {{"R", "too few"}, {"A", "too few"}, {"B", "one way"}};
    EXPECT_EQ(
        reasons_not_evaluated(result),
        (std::vector<std::string>{"Not evaluated: A, R: too few", "Not evaluated: B: one way"}));
}

TEST(Ticks, EncloseTheDataByRoundSteps) {
    const Ticks ticks = ticks_around(-1.3, 9.2, 6);
    EXPECT_DOUBLE_EQ(ticks.step, 2);
    EXPECT_DOUBLE_EQ(ticks.first, -2);
    EXPECT_DOUBLE_EQ(ticks.last, 10);
    EXPECT_EQ(ticks.decimals, 0);
    EXPECT_EQ(ticks.all().size(), 7u);
}

TEST(Ticks, DoNotMagnifyNoise) {
    const Ticks ticks = ticks_around(20.001, 20.002, 4, 0.2);
    EXPECT_LE(ticks.first, 19.91);
    EXPECT_GE(ticks.last, 20.10);
    EXPECT_EQ(ticks.decimals, 2);
}

TEST(Ticks, StayInsideAnAxisThatEndsWithItsData) {
    const Ticks ticks = ticks_within(-12, 1012, 10);
    EXPECT_DOUBLE_EQ(ticks.first, 0);
    EXPECT_DOUBLE_EQ(ticks.last, 1000);
}

TEST(Ticks, SurviveASinglePoint) {
    EXPECT_GT(ticks_around(5, 5, 6).last, 5);
    EXPECT_GE(ticks_within(5, 5, 6).all().size(), 1u);
}

} // namespace
} // namespace axiscal::wording_test
