// Literal records of the uMD: the examples of docs/instruments/umd.md.
#include "drivers/laser/umd_facts.hpp"
#include "drivers/laser/umd_record.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace axiscal::umd_record_test {
namespace {

UmdSetup helium_neon() {
    UmdSetup setup;
    setup.wavelength = nm(632.991354);
    setup.fastest = metre_per_second(1);
    return setup;
}

UmdFacts facts_of(std::initializer_list<std::pair<std::int64_t, std::int64_t>> slots,
                  const UmdSetup& setup = helium_neon()) {
    UmdFacts facts{setup};
    for (const auto& [code, data] : slots)
        facts.learn(code, data);
    return facts;
}

TEST(UmdRecord, ReadsEightFields) {
    const auto record = decode_umd_record("1638 1638 0 0 12 1 10 60");
    ASSERT_TRUE(record);
    EXPECT_EQ(record->reference, 1638);
    EXPECT_EQ(record->axes[0].measurement, 1638);
    EXPECT_EQ(record->axes[0].displacement, 0);
    EXPECT_EQ(record->axes[0].phase, 12);
    EXPECT_EQ(record->sequence, 1);
    EXPECT_EQ(record->low_speed_code, 10);
    EXPECT_EQ(record->low_speed_data, 60);
    EXPECT_EQ(record->axis_count, 1);
}

TEST(UmdRecord, ReadsAHomodyneRecord) {
    const auto record = decode_umd_record("0 0 12345 3 0 4098 8 100000");
    ASSERT_TRUE(record);
    EXPECT_EQ(record->axes[0].displacement, 12345);
    EXPECT_EQ(record->sequence, 4098);
    EXPECT_EQ(record->low_speed_data, 100000);
}

TEST(UmdRecord, ReadsSixteenFields) {
    const auto record = decode_umd_record("0 0 10 1 0 77 20 1027 0 -4 0 0 0 7 0 0");
    ASSERT_TRUE(record);
    EXPECT_EQ(record->axis_count, 3);
    EXPECT_EQ(record->axes[0].displacement, 10);
    EXPECT_EQ(record->axes[1].displacement, -4);
    EXPECT_EQ(record->axes[2].displacement, 7);
    const auto facts = facts_of({{record->low_speed_code, record->low_speed_data}});
    EXPECT_EQ(facts.head(), UmdHead::homodyne);
    EXPECT_EQ(facts.counts_per_cycle(), 4);
}

TEST(UmdRecord, RefusesWhatIsNoRecord) {
    for (const char* line :
         {"", "Minimalist Homodyne Test:", "1638 1638 0 0 12 1 10", "1638 1638 0 0 12 1 10 60 5",
          "1638  1638 0 0 12 1 10 60", "1638 1638 0 0 12 1 10 60 ", " 1638 1638 0 0 12 1 10 60",
          "1638 1638 0.5 0 12 1 10 60", "1638 1638 0 0 12 1 10 x", "+1 1 0 0 0 1 0 0",
          "1 1 99999999999999999999 0 0 1 0 0", "1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1"})
        EXPECT_FALSE(decode_umd_record(line)) << line;
}

TEST(UmdRecord, ReadsBackEveryWholeNumber) {
    std::mt19937_64 random{2};
    std::uniform_int_distribution<std::int64_t> any{std::numeric_limits<std::int64_t>::min(),
                                                    std::numeric_limits<std::int64_t>::max()};
    for (int trial = 0; trial < 200; ++trial) {
        const auto displacement = any(random), data = any(random);
        const auto record = decode_umd_record("1 2 " + std::to_string(displacement) +
                                              " 0 -512 9 0 " + std::to_string(data));
        ASSERT_TRUE(record);
        EXPECT_EQ(record->axes[0].displacement, displacement);
        EXPECT_EQ(record->axes[0].phase, -512);
        EXPECT_EQ(record->low_speed_data, data);
    }
}

TEST(UmdPhase, IsSubtracted) {
    EXPECT_DOUBLE_EQ(umd_position(10, 64, UmdPhase::eight_bit).value(), 9.75);
    EXPECT_DOUBLE_EQ(umd_position(10, -64, UmdPhase::eight_bit).value(), 10.25);
    EXPECT_DOUBLE_EQ(umd_position(10, 16384, UmdPhase::sixteen_bit).value(), 9.75);
    EXPECT_DOUBLE_EQ(umd_position(-3, -32768, UmdPhase::sixteen_bit).value(), -2.5);
    EXPECT_DOUBLE_EQ(umd_position(7, 99, UmdPhase::none).value(), 7);
}

TEST(UmdPhase, OfTheUmd1IsAnErrorMaskWhenAHighBitStands) {
    EXPECT_DOUBLE_EQ(umd_position(10, 511, UmdPhase::masked).value(), 10 - 511.0 / 256);
    EXPECT_DOUBLE_EQ(umd_position(10, -512, UmdPhase::masked).value(), 12);
    for (const std::int64_t mask : {0x200, 0x400, 0x800, 0x1000, 0x2000, 0x4000})
        EXPECT_FALSE(umd_position(10, mask, UmdPhase::masked)) << mask;
}

/// Firmware v3.15: count cut towards zero, phase = count - position in 1/256, low byte kept.
TEST(UmdPhase, OfFirmware315ComesBackAboveAndBelowZero) {
    for (int in_256ths = -2560; in_256ths <= 2560; ++in_256ths) {
        const double truth = in_256ths / 256.0;
        const std::int64_t printed = in_256ths / 256;
        const std::int64_t phase = (printed * 256 - in_256ths) & 0xFF;
        const auto found = umd_position(printed, phase, UmdPhase::truncated);
        const bool ambiguous = printed == 0 && phase != 0;
        ASSERT_EQ(found.has_value(), !ambiguous) << truth;
        if (found) {
            EXPECT_DOUBLE_EQ(*found, truth);
        }
    }
}

TEST(UmdFacts, TellTheFamilyByItsRate) {
    EXPECT_EQ(facts_of({{8, 24414}}).family(), UmdFamily::umd0);
    for (const std::int64_t rate : {30517, 45776, 61035, 73242})
        EXPECT_EQ(facts_of({{8, rate}}).family(), UmdFamily::umd1);
    EXPECT_EQ(facts_of({{8, 100000}}).family(), UmdFamily::umd2);
    EXPECT_DOUBLE_EQ(facts_of({{8, 61035}}).rate_Hz().value(), 610.35);
}

TEST(UmdFacts, TellTheFirmwareAndItsPhase) {
    const auto old_umd2 = facts_of({{8, 100000}, {10, 220}, {20, 0x0100}});
    EXPECT_EQ(old_umd2.firmware(), "2.20");
    EXPECT_EQ(old_umd2.phase(), UmdPhase::eight_bit);
    const auto quirk = facts_of({{8, 100000}, {10, 315}, {20, 0x0100}});
    EXPECT_EQ(quirk.firmware(), "3.15");
    EXPECT_EQ(quirk.phase(), UmdPhase::truncated);
    const auto umd1 = facts_of({{8, 61035}, {10, 60}});
    EXPECT_EQ(umd1.firmware(), "60");
    EXPECT_EQ(umd1.phase(), UmdPhase::masked);
    EXPECT_EQ(umd1.counts_per_cycle(), 1);
    EXPECT_TRUE(umd1.complete());
}

TEST(UmdFacts, WaitForTheFlagsOfVersion26x) {
    const std::int64_t word = 264 + (7 << 16);
    auto facts = facts_of({{8, 100000}, {10, word}, {20, 0x0200}});
    EXPECT_FALSE(facts.phase());
    facts.learn(112, 4);
    EXPECT_EQ(facts.phase(), UmdPhase::sixteen_bit);
    EXPECT_EQ(facts.firmware(), "264.07");
    facts.learn(112, 2);
    EXPECT_EQ(facts.phase(), UmdPhase::eight_bit);
    auto silent = facts_of({{8, 100000}, {10, word}, {20, 0x0200}});
    for (int record = 0; record < 64; ++record)
        silent.learn(0, 0);
    EXPECT_EQ(silent.phase(), UmdPhase::sixteen_bit);
}

/// Check values: lambda 632.991354 nm in vacuum.
TEST(UmdFacts, ScaleCountsByOpticsAndCountsPerCycle) {
    UmdSetup setup = helium_neon();
    const auto scale_nm = [&](double fold, int counts) {
        setup.optical_fold = fold;
        setup.counts_per_cycle = counts;
        return facts_of({}, setup).metres_per_count() * 1e9;
    };
    EXPECT_NEAR(scale_nm(2, 1), 316.496, 5e-4);
    EXPECT_NEAR(scale_nm(2, 2), 158.248, 5e-4);
    EXPECT_NEAR(scale_nm(2, 4), 79.124, 5e-4);
    EXPECT_NEAR(scale_nm(4, 1), 158.248, 5e-4);
    EXPECT_NEAR(scale_nm(4, 4), 39.562, 5e-4);
}

/// A scale of 20 um a line: the quadrature firmware makes 4 counts of it, 5 um each.
TEST(UmdFacts, ScaleCountsByTheResolutionWhateverTheInstrumentSaysOfCycles) {
    UmdSetup setup;
    setup.resolution = um(5);
    setup.head = UmdHead::homodyne;
    setup.phase = UmdPhase::none;
    EXPECT_FALSE(facts_of({}, setup).complete()); // the record rate is not known yet
    EXPECT_EQ(facts_of({}, setup).missing().find("counts_per_cycle"), std::string::npos);
    const auto silent = facts_of({{8, 100000}}, setup), told = facts_of({{20, 1025}}, setup);
    EXPECT_TRUE(silent.complete());
    EXPECT_DOUBLE_EQ(silent.metres_per_count(), 5e-6);
    EXPECT_DOUBLE_EQ(told.metres_per_count(), 5e-6);
    EXPECT_EQ(told.contradiction(), "");
    EXPECT_NE(facts_of({{20, 0x0100}}, setup).contradiction().find("no A-quad-B"),
              std::string::npos);
}

TEST(UmdFacts, NameWhatIsMissingAndWhatContradicts) {
    UmdSetup setup = helium_neon();
    EXPECT_NE(facts_of({{8, 100000}}).missing().find("counts_per_cycle"), std::string::npos);
    setup.counts_per_cycle = 4;
    const auto facts = facts_of({{20, 0x1001}}, setup);
    EXPECT_EQ(facts.counts_per_cycle(), 4);
    EXPECT_NE(facts.contradiction().find("the instrument says 16"), std::string::npos);
}

} // namespace
} // namespace axiscal::umd_record_test
