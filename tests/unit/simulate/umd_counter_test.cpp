// Expected bytes: the examples and the field table of the µMD firmware description.
#include "wire/umd_counter.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace axiscal::simulate::umd_counter_test {
namespace {

LaserScenario laser(const std::string& kind, int counts_per_cycle, int phase_bits) {
    LaserScenario scenario;
    scenario.kind = kind;
    scenario.counts_per_cycle = counts_per_cycle;
    scenario.phase_bits = phase_bits;
    return scenario;
}

TEST(UmdRecord, IsTheDocumentedHeterodyneLine) {
    const UmdRecord record{1638, 1638, 0, 0, 12, 1, 10, 60, {}};
    EXPECT_EQ(encode(record), "1638 1638 0 0 12 1 10 60\r\n");
}

TEST(UmdRecord, IsTheDocumentedHomodyneLine) {
    const UmdRecord record{0, 0, 12345, 3, 0, 4098, 8, 100000, {}};
    EXPECT_EQ(encode(record), "0 0 12345 3 0 4098 8 100000\r\n");
}

TEST(UmdRecord, IsTheDocumentedSixteenFieldLine) {
    UmdRecord record{0, 0, 10, 1, 0, 77, 20, 1027, {}};
    record.further_axes = {0, -4, 0, 0, 0, 7, 0, 0};
    EXPECT_EQ(encode(record), "0 0 10 1 0 77 20 1027 0 -4 0 0 0 7 0 0\r\n");
}

TEST(UmdCounter, PhaseIsSubtractedFromTheCount) {
    for (const int bits : {8, 16}) {
        UmdCounter counter{laser("umd2-heterodyne", 1, bits)};
        const double parts = std::pow(2.0, bits);
        for (const double cycles : {0.0, 10.25, -10.25, 1000.999, -0.001, 0.5, 3.0 - 1e-9}) {
            const UmdRecord record = counter.next(cycles);
            const double read = static_cast<double>(record.displacement) -
                                static_cast<double>(record.phase) / parts;
            EXPECT_NEAR(read, cycles, 0.5 / parts) << cycles;
            EXPECT_GE(record.phase, 0);
            EXPECT_LT(record.phase, static_cast<std::int64_t>(parts));
        }
    }
}

TEST(UmdCounter, HomodyneSendsNeitherReferenceNorPhase) {
    UmdCounter counter{laser("umd2-homodyne", 4, 16)};
    const UmdRecord record = counter.next(25.3); // 101.2 quarter cycles
    EXPECT_EQ(record.displacement, 101);
    EXPECT_EQ(record.reference, 0);
    EXPECT_EQ(record.measured, 0);
    EXPECT_EQ(record.phase, 0);
}

TEST(UmdCounter, LowSpeedSlotsFollowTheFirmwareTables) {
    UmdCounter umd2{laser("umd2-homodyne", 4, 16)};
    std::map<std::int64_t, std::pair<std::int64_t, std::int64_t>> said;
    for (int i = 0; i < 32; ++i) {
        const UmdRecord r = umd2.next(0);
        if (r.low_speed_code != 0) said[r.sequence] = {r.low_speed_code, r.low_speed_data};
    }
    EXPECT_EQ(said[2], std::make_pair(std::int64_t{8}, std::int64_t{100000}));
    EXPECT_EQ(said[3], std::make_pair(std::int64_t{20}, std::int64_t{1025})); // 1 axis, 4 a cycle
    EXPECT_EQ(said[1].first, 10);

    UmdCounter umd0{laser("umd0", 4, 16)};
    UmdCounter umd1{laser("umd1", 1, 8)};
    umd0.next(0), umd1.next(0);
    EXPECT_EQ(umd0.next(0).low_speed_data, 24414);
    EXPECT_EQ(umd1.next(0).low_speed_data, 61035);
}

TEST(UmdCounter, SequenceOfUmd0WrapsAsSigned16Bit) {
    UmdCounter counter{laser("umd0", 4, 16)};
    counter.skip(32766);
    EXPECT_EQ(counter.next(0).sequence, 32767);
    EXPECT_EQ(counter.next(0).sequence, -32768);
}

TEST(UmdCounter, BeamLossShowsOnAHeterodyneHeadAndLosesThePosition) {
    UmdCounter counter{laser("umd2-heterodyne", 1, 16)};
    counter.next(100.0);
    counter.set_beam(false);
    const UmdRecord lost = counter.next(100.0);
    EXPECT_EQ(lost.measured, 0);
    EXPECT_GT(lost.reference, 0);
    counter.set_beam(true);
    EXPECT_NE(counter.next(100.0).displacement, 100);
}

TEST(UmdCounter, BeamLossOfAHomodyneHeadIsNotReported) {
    UmdCounter counter{laser("umd2-homodyne", 4, 16)};
    counter.next(100.0);
    counter.set_beam(false);
    EXPECT_EQ(counter.next(250.0).displacement, 400); // stands still while the axis moves
    counter.set_beam(true);
    EXPECT_EQ(counter.next(250.0).displacement, 400); // and has lost 150 cycles
    EXPECT_EQ(counter.next(251.0).displacement, 404);
}

TEST(UmdCounter, BlockedBeamOfUmd1IsItsErrorMask) {
    UmdCounter counter{laser("umd1", 1, 8)};
    counter.set_beam(false);
    EXPECT_EQ(counter.next(0).phase, 0x800);
}

TEST(UmdCounter, RestartBeginsAtOneAndSkipLeavesAGap) {
    UmdCounter counter{laser("umd2-homodyne", 4, 16)};
    counter.next(5), counter.next(5);
    counter.skip(3);
    EXPECT_EQ(counter.next(5).sequence, 6);
    counter.restart();
    EXPECT_EQ(counter.next(0).sequence, 1);
}

TEST(UmdCounter, SwitchesToSixteenFieldsWhileRunning) {
    UmdCounter counter{laser("umd1", 1, 8)};
    EXPECT_FALSE(counter.next(0).further_axes);
    counter.set_fields(16);
    EXPECT_TRUE(counter.next(0).further_axes);
}

} // namespace
} // namespace axiscal::simulate::umd_counter_test
