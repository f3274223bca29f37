// Literal answers: ND 281B manual page 47, QM-Height manual 6.2.2, Sylvac opto RS manual; of the
// ELCOMAT 3000 the record of dls-controls/elcomat3000 (etc/simulations/elcomat3000.py).
#include "drivers/gauge/gauge_answer.hpp"
#include "tests/support/made_instrument.hpp"

#include <gtest/gtest.h>

namespace axiscal::gauge_answer_test {
namespace {

const GaugeModel& model(std::string_view name) {
    return *find_gauge_model(name);
}

TEST(GaugeAnswer, ReadsTheHeidenhainRecordOfTheManual) {
    // -5.23 mm, within the sorting limits, current value of a series.
    const auto answer = decode_gauge_answer("-      5.23  =A", model("nd-28x"));
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->number, -5.23);
    EXPECT_EQ(answer->unit, GaugeUnit::millimetres);
}

// ND 281B, page 47: MIN, MAX and DIFF of a series are no measured values. ND 287: with two axes S
// is X1-X2.
TEST(GaugeAnswer, HasNoValueWhereHeidenhainShowsAnotherFigure) {
    for (const std::string_view line : {"-      5.23  =S", "-      5.23  =G", "-      5.23  =D",
                                        "-      5.23   G", "-      5.23  =2"}) {
        const auto answer = decode_gauge_answer(line, model("nd-28x"));
        ASSERT_FALSE(answer) << line;
        EXPECT_EQ(answer.error().fault, Fault::signal_error) << line;
        EXPECT_NE(answer.error().detail.find("set it to"), std::string::npos) << line;
    }
    for (const std::string_view line : {"-      5.23  =A", "-      5.23  = ", "-      5.23   1"})
        EXPECT_EQ(decode_gauge_answer(line, model("nd-28x"))->number, -5.23) << line;
}

TEST(GaugeAnswer, HasNoLengthWhereHeidenhainShowsAnAngle) {
    for (const char unit : std::string{"GMRmiU"}) {
        const std::string line = std::string{"-      5.23 "} + unit + "=A";
        const auto answer = decode_gauge_answer(line, model("nd-28x"));
        ASSERT_FALSE(answer) << line;
        EXPECT_EQ(answer.error().fault, Fault::signal_error) << line;
        EXPECT_NE(answer.error().detail.find("shows no length"), std::string::npos) << line;
    }
    EXPECT_EQ(decode_gauge_answer("-      5.23 x=A", model("nd-28x")).error().fault,
              Fault::bad_frame);
}

TEST(GaugeAnswer, TakesInchesFromTheHeidenhainMark) {
    const auto answer = decode_gauge_answer("+   1.00000 \"  ", model("nd-28x"));
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->unit, GaugeUnit::inches);
    EXPECT_DOUBLE_EQ(length_of(answer->number, *answer->unit).in(mm), 25.4);
}

TEST(GaugeAnswer, HasNoValueWhereHeidenhainMarksAFault) {
    EXPECT_EQ(decode_gauge_answer("+      0.00 ?  ", model("nd-28x")).error().fault,
              Fault::signal_error);
}

TEST(GaugeAnswer, ReadsTheMitutoyoRecordsOfTheManual) {
    const auto metric = decode_gauge_answer("01A+0000.123", model("mitutoyo"));
    ASSERT_TRUE(metric);
    EXPECT_EQ(metric->number, 0.123);
    EXPECT_EQ(metric->input, 1);
    EXPECT_EQ(metric->unit, std::nullopt); // the record does not tell
    const auto inches = decode_gauge_answer("01A+00.12345", model("mitutoyo"));
    ASSERT_TRUE(inches);
    EXPECT_EQ(inches->number, 0.12345);
    EXPECT_EQ(decode_gauge_answer("03A-0000.001", model("mitutoyo"))->input, 3);
}

TEST(GaugeAnswer, TellsAMitutoyoErrorFromAValue) {
    const auto error = decode_gauge_answer("911", model("mitutoyo"));
    ASSERT_FALSE(error);
    EXPECT_EQ(error.error().fault, Fault::signal_error);
    EXPECT_NE(error.error().detail.find("911"), std::string::npos);
}

TEST(GaugeAnswer, ReadsASylvacValueWithAndWithoutAToleranceMark) {
    for (const std::string_view line : {"+012.345", "+012.345=", "<+012.345", "+012.345>"}) {
        const auto answer = decode_gauge_answer(line, model("sylvac"));
        ASSERT_TRUE(answer) << line;
        EXPECT_EQ(answer->number, 12.345) << line;
    }
    EXPECT_EQ(unit_in_settings("MM RES2 REF1 NOR CHA+ B1"), GaugeUnit::millimetres);
    EXPECT_EQ(unit_in_settings("IN RES2"), GaugeUnit::inches);
    EXPECT_EQ(unit_in_settings("+012.345"), std::nullopt);
}

TEST(GaugeAnswer, ReadsASylvacValueWithABlankForItsSign) {
    EXPECT_EQ(decode_gauge_answer(" 000.500", model("sylvac"))->number, 0.5);
    EXPECT_EQ(decode_gauge_answer(" 000.500=", model("sylvac"))->number, 0.5);
    EXPECT_EQ(decode_gauge_answer(" 0.01969", model("sylvac"))->number, 0.01969);
}

TEST(GaugeAnswer, KnowsTheModesInWhichASylvacHoldsAnExtreme) {
    EXPECT_EQ(held_in_settings("MM RES2 REF1 NOR CHA+ B1"), "");
    for (const std::string_view mode : {"MAX", "MIN", "DEL"})
        EXPECT_EQ(held_in_settings("MM RES2 REF1 " + std::string{mode} + " CHA+ B1"), mode);
}

// Sylvac: RES2 and RES3 in mm, RES4 and RES5 in inches; QM-Height: 3 in mm, 4 and 5 in inches.
TEST(GaugeAnswer, TellsMillimetresFromInchesByTheDecimals) {
    EXPECT_EQ(decode_gauge_answer("+000.500", model("sylvac"))->decimals, 3);
    EXPECT_EQ(decode_gauge_answer("+0.01969", model("sylvac"))->decimals, 5);
    EXPECT_EQ(decode_gauge_answer("01A+00.12345", model("mitutoyo"))->decimals, 5);
    for (const int decimals : {2, 3}) {
        EXPECT_TRUE(decimals_fit(decimals, GaugeUnit::millimetres));
        EXPECT_FALSE(decimals_fit(decimals, GaugeUnit::inches));
    }
    for (const int decimals : {4, 5}) {
        EXPECT_FALSE(decimals_fit(decimals, GaugeUnit::millimetres));
        EXPECT_TRUE(decimals_fit(decimals, GaugeUnit::inches));
    }
}

TEST(GaugeAnswer, RefusesEveryShortenedOrLengthenedRecord) {
    const std::pair<std::string_view, std::string_view> fixed[] = {
        {"nd-28x", "-      5.23  =A"}, {"mitutoyo", "01A+0000.123"}, {"sylvac", "+012.345"}};
    for (const auto& [name, record] : fixed)
        for (std::size_t at = 0; at < record.size(); ++at) {
            std::string cut{record}, doubled{record};
            cut.erase(at, 1);
            if (name == "sylvac" && at > 4) continue; // one place less is its coarser resolution
            doubled.insert(at, 1, 'x');
            EXPECT_FALSE(decode_gauge_answer(cut, model(name))) << cut;
            EXPECT_FALSE(decode_gauge_answer(doubled, model(name))) << doubled;
        }
}

TEST(GaugeAnswer, RefusesWhatIsNoNumber) {
    for (const std::string_view line : {"+     5 .23  =A", "+          .  =A",
                                        "+   1.2.3   = ", " ", "", "+", "-  1e5", "+          x"})
        EXPECT_EQ(decode_gauge_answer(line, model("nd-28x")).error().fault, Fault::bad_frame)
            << line;
    for (const std::string_view line :
         {"+", "+.", "+1.2.3", "012.345", "+12.345", "+0123.456", "  00.500", " -00.500"})
        EXPECT_EQ(decode_gauge_answer(line, model("sylvac")).error().fault, Fault::bad_frame)
            << line;
}

TEST(GaugeAnswer, ReadsTheAxisOfTheAutocollimatorThatTheModelNames) {
    const auto first = decode_gauge_answer("4 003 4.500000 2.300000", model("elcomat-x"));
    ASSERT_TRUE(first) << first.error().detail;
    EXPECT_EQ(first->number, 4.5);
    const auto second = decode_gauge_answer("4 003 4.500000 2.300000", model("elcomat-y"));
    ASSERT_TRUE(second) << second.error().detail;
    EXPECT_EQ(second->number, 2.3);
    EXPECT_EQ(decode_gauge_answer("4 003 -12.34 0.56", model("elcomat-x"))->number, -12.34);
    EXPECT_EQ(decode_gauge_answer("4 003 12.34 -0.56", model("elcomat-y"))->number, -0.56);
    EXPECT_EQ(decode_gauge_answer("4 001 1.25 0.00", model("elcomat-x"))->number, 1.25);
}

// The third digit of the state: 1 the first axis is valid, 2 the second, 3 both.
TEST(GaugeAnswer, HasNoAngleOfAnAxisThatTheAutocollimatorDoesNotCallValid) {
    for (const std::string_view dark : {"4 000 0.00 0.00", "4 002 3.21 0.56"})
        EXPECT_EQ(decode_gauge_answer(dark, model("elcomat-x")).error().fault, Fault::beam_lost)
            << dark;
    for (const std::string_view dark : {"4 000 0.00 0.00", "4 001 3.21 0.56"})
        EXPECT_EQ(decode_gauge_answer(dark, model("elcomat-y")).error().fault, Fault::beam_lost)
            << dark;
}

TEST(GaugeAnswer, TakesNoOtherRecordOfTheAutocollimatorForAnAbsoluteReading) {
    for (const std::string_view line : {"2 103 4.500000 2.300000",
                                        "1 103 4.500000 2.300000",
                                        "3 003 4.500000 2.300000",
                                        "8 423 12 1 2001 300",
                                        "4 103 4.5 2.3",
                                        "4 003",
                                        "4 003 4.5",
                                        "4 003 45 2.3",
                                        "4 003 4.5 23",
                                        "4 003 4.5 2.3 1",
                                        "4 003 4.5. 2.3",
                                        "4 003 - 2.3",
                                        "4 003 .5 2.3",
                                        "4 003 5. 2.3",
                                        "4 003 1e5 2.3",
                                        "4 003  4.5 2.3",
                                        "4 003 4,5 2,3",
                                        "4 003 1234567.0 2.3",
                                        "4 003 1.2345678 2.3",
                                        "4003 4.5 2.3"})
        for (const std::string_view name : {"elcomat-x", "elcomat-y"})
            EXPECT_EQ(decode_gauge_answer(line, model(name)).error().fault, Fault::bad_frame)
                << name << ": " << line;
}

// There is no checksum: without one of its digits, or its sign, a number is a number as well.
TEST(GaugeAnswer, LetsPassNothingButALostDigitOrSignInARecordOfTheAutocollimator) {
    const std::string record = "4 003 -12.34 0.56";
    for (std::size_t at = 0; at < record.size(); ++at) {
        std::string cut = record, other = record;
        const char letter = cut[at];
        cut.erase(at, 1);
        other[at] = 'x';
        EXPECT_FALSE(decode_gauge_answer(other, model("elcomat-x"))) << other;
        const bool of_a_number = at >= 6 && (letter == '-' || (letter >= '0' && letter <= '9'));
        if (of_a_number) continue;
        EXPECT_FALSE(decode_gauge_answer(cut, model("elcomat-x"))) << cut;
    }
}

TEST(AsciiGauge, GivesAnAngleWhereItsModelIsAnAutocollimator) {
    const std::string keys = "link = \"serial:/dev/null\"\nmodel = ";
    const auto angular = testing::make_instrument("ascii-gauge", keys + "\"elcomat-y\"\n");
    EXPECT_TRUE(angular.refusals.empty());
    ASSERT_EQ(angular.instrument->channels().size(), 1U);
    EXPECT_EQ(angular.instrument->channels()[0].name, "angle");
    EXPECT_EQ(angular.instrument->channels()[0].kind, ChannelKind::angle);
    EXPECT_EQ(stored_unit_of(ChannelKind::angle), "arcsec");
    const auto in_mm =
        testing::make_instrument("ascii-gauge", keys + "\"elcomat-y\"\nunit = \"mm\"\n");
    ASSERT_EQ(in_mm.refusals.size(), 1U);
    EXPECT_EQ(in_mm.refusals[0].key, "unit");
    const auto length = testing::make_instrument("ascii-gauge", keys + "\"nd-28x\"\n");
    EXPECT_EQ(length.instrument->channels()[0].kind, ChannelKind::displacement);
}

TEST(AsciiGauge, WantsTheUnitOfAGaugeThatDoesNotTellIt) {
    const std::string keys = "link = \"serial:/dev/null\"\nmodel = \"mitutoyo\"\n";
    const auto silent = testing::make_instrument("ascii-gauge", keys);
    ASSERT_EQ(silent.refusals.size(), 1U);
    EXPECT_EQ(silent.refusals[0].key, "unit");
    EXPECT_TRUE(testing::make_instrument("ascii-gauge", keys + "unit = \"mm\"\n").refusals.empty());
    const auto inputs = testing::make_instrument(
        "ascii-gauge", "link = \"serial:/dev/null\"\nmodel = \"sylvac\"\ninput = 2\n");
    ASSERT_EQ(inputs.refusals.size(), 1U);
    EXPECT_EQ(inputs.refusals[0].key, "input");
}

} // namespace
} // namespace axiscal::gauge_answer_test
