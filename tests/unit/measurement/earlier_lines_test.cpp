// Which earlier runs a squareness run does not take, and what it says of them.
#include "acquisition/measurement/squareness/earlier_lines.hpp"

#include <gtest/gtest.h>
#include <string>
#include <utility>

namespace axiscal::earlier_lines_test {
namespace {

StraightnessSetup prism(const std::string& across) {
    StraightnessSetup setup;
    setup.across = across;
    return setup;
}

/// Y across X, as it is armed.
SquarenessSetup y_across_x() {
    SquarenessSetup setup;
    setup.optics = prism("X");
    return setup;
}

template <class Setup> RunFileContents run_with(const std::string& axis, Setup setup) {
    RunFileContents contents;
    contents.run.run_id = "R-1";
    contents.run.statements.axis = axis;
    contents.attachments.setup = std::move(setup);
    return contents;
}

std::string refusal_of_first(const StraightnessSetup& earlier, const SquarenessSetup& now) {
    const auto line = first_line_of(run_with("X", earlier), now, "Y");
    if (line || line.error().fault != Fault::bad_request) return "";
    EXPECT_EQ(line.error().field, "squareness.first");
    return line.error().detail;
}

std::string refusal_of_other(const SquarenessSetup& earlier, const SquarenessSetup& now) {
    const auto other = other_square_of(run_with("Y", earlier), now);
    if (other || other.error().fault != Fault::bad_request) return "";
    EXPECT_EQ(other.error().field, "squareness.reversal_of");
    return other.error().detail;
}

TEST(EarlierLines, TheFirstIsMeasuredInTheDirectionOfThisAxis) {
    EXPECT_EQ(refusal_of_first(prism("Z"), y_across_x()),
              "Run R-1 is E_ZX, X measured in the direction of Z; with this axis, Y across X, the "
              "first must be E_YX: measure X in that direction, or name another run");
}

TEST(EarlierLines, TheSamePrismAndMirrorSawTheFirst) {
    StraightnessSetup other_prism = prism("Y"), turned_mirror = prism("Y"), steps = prism("Y");
    other_prism.factor = 35.5;
    EXPECT_NE(refusal_of_first(other_prism, y_across_x())
                  .find("Run R-1 has the factor 35.5, and [straightness] states 36"),
              std::string::npos);
    turned_mirror.mirror = MirrorPosition::reversed;
    EXPECT_NE(refusal_of_first(turned_mirror, y_across_x())
                  .find("In run R-1 the mirror stood reversed, and now it stands normal"),
              std::string::npos);
    steps.method = StraightnessMethod::angle_steps;
    EXPECT_NE(refusal_of_first(steps, y_across_x()).find("Run R-1 is measured by angle steps"),
              std::string::npos);
}

TEST(EarlierLines, AFactorThatIsRoundedOtherwiseIsTheSame) {
    StraightnessSetup rounded = prism("Y");
    rounded.factor = 36 * (1 + 1e-12);
    EXPECT_EQ(refusal_of_first(rounded, y_across_x()), ""); // without a point it fails otherwise
}

TEST(EarlierLines, TheOtherSquareStandsOtherwise) {
    SquarenessSetup turned = y_across_x();
    turned.square = SquarePosition::turned;
    EXPECT_EQ(refusal_of_other(y_across_x(), y_across_x()),
              "The square stands as in run R-1: turn it, or say square = \"turned\" where it was "
              "turned");
    EXPECT_NE(refusal_of_other(turned, turned).find("say square = \"normal\""), std::string::npos);
    EXPECT_EQ(refusal_of_other(y_across_x(), turned), "");
}

TEST(EarlierLines, TheOtherSquareStoodBetweenTheSameAxes) {
    SquarenessSetup across_z = y_across_x(), other_prism = y_across_x(), turned = y_across_x();
    across_z.optics.across = "Z";
    other_prism.optics.factor = 360;
    turned.square = SquarePosition::turned;
    EXPECT_EQ(refusal_of_other(across_z, turned),
              "Run R-1 is of Y across Z, and this one across X: name a run of the same two axes");
    EXPECT_NE(refusal_of_other(other_prism, turned).find("has the factor 360"), std::string::npos);
}

TEST(EarlierLines, ARunWithoutASetUpIsABrokenFile) {
    RunFileContents nothing;
    EXPECT_EQ(first_line_of(nothing, y_across_x(), "Y").error().fault, Fault::bad_run_file);
    EXPECT_EQ(other_square_of(nothing, y_across_x()).error().fault, Fault::bad_run_file);
}

} // namespace
} // namespace axiscal::earlier_lines_test
