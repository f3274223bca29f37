// What single words of the sequence-block tell the CNC. The numbers are those of the document
// (docs/trigger.md), written here once more: a PLC program knows nothing else.
#include "tests/support/cnc_map_bench.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace axiscal::cnc_sequence_block_words_test {
namespace {

using BlockBench = testing::MapBench<SequenceBlockMap>;

constexpr int done_word = 18, result_word = 19, fault_sequence_word = 32;

/// An armed map whose request 1 has a durable point and whose request 2 is refused.
BlockBench refused(Fault fault) {
    BlockBench map{false, false};
    map.arm();
    map.write_words(1, {2, 1});
    map.finish(1);
    map.write_words(1, {2, 2});
    map.refuse(2, fault);
    return map;
}

// Every code of the document, and what it is given for.
const std::vector<std::pair<Fault, int>> codes{
    {Fault::beam_lost, 1},           {Fault::not_still, 2},     {Fault::outside_window, 3},
    {Fault::environment_stale, 4},   {Fault::bad_command, 5},   {Fault::overspeed, 6},
    {Fault::not_durable, 7},         {Fault::datum_lost, 8},    {Fault::wrong_target, 9},
    {Fault::wrong_direction, 10},    {Fault::out_of_order, 11}, {Fault::no_run_armed, 12},
    {Fault::environment_outside, 4}, {Fault::sequence_lost, 11}};

TEST(SequenceBlockResult, NamesEachFaultByTheDocumentsCode) {
    for (const auto& [fault, code] : codes) {
        const BlockBench map = refused(fault);
        EXPECT_EQ(map.word(result_word), code) << fault_name(fault);
        EXPECT_EQ(map.word(fault_sequence_word), 2) << fault_name(fault);
        EXPECT_EQ(map.word(done_word), 1) << fault_name(fault);
    }
}

TEST(SequenceBlockResult, LeavesNoCodeOfTheDocumentUnused) {
    for (int code = 1; code <= 12; ++code)
        EXPECT_NE(std::ranges::find(codes, code, &std::pair<Fault, int>::second), codes.end())
            << code;
}

TEST(SequenceBlockResult, IsFiveForAFaultWithoutACodeAndNeverGood) {
    int others = 0;
    for (int number = 1; number < 256; ++number) { // also numbers that no fault has
        const auto fault = static_cast<Fault>(number);
        if (std::ranges::find(codes, fault, &std::pair<Fault, int>::first) != codes.end()) continue;
        const BlockBench map = refused(fault);
        EXPECT_EQ(map.word(result_word), 5) << number << ' ' << fault_name(fault);
        EXPECT_EQ(map.word(fault_sequence_word), 2) << number;
        EXPECT_EQ(map.word(done_word), 1) << number;
        ++others;
    }
    EXPECT_EQ(others, 255 - 14);
}

TEST(SequenceBlockResult, IsGoodWithTheDurablePointThatFollowsAFault) {
    for (const auto& [fault, code] : codes) {
        BlockBench map = refused(fault);
        map.finish(2);
        EXPECT_EQ(map.word(result_word), 0) << code;
        EXPECT_EQ(map.word(fault_sequence_word), 0) << code;
        EXPECT_EQ(map.word(done_word), 2) << code;
    }
}

using Words = std::vector<std::pair<int, int>>;

void expect_words(const BlockBench& map, const Words& expected, const char* when) {
    for (const auto& [address, value] : expected)
        EXPECT_EQ(map.word(address), value) << "word " << address << ' ' << when;
}

const Words nothing_there{{20, 0x8000}, {21, 0},      {22, 0x8000}, {23, 0},
                          {24, 0xFFFF}, {25, 0x8000}, {26, 0},      {28, 0x8000},
                          {29, 0x8000}, {30, 0x8000}, {31, 0x8000}};

PortStatus all_zero() {
    PortStatus status;
    status.measured_mm = status.deviation_um = status.next_nominal_mm = 0;
    status.next_target = 0;
    status.air_degC = status.pressure_Pa = status.humidity_percent = status.material_degC = 0;
    return status;
}

TEST(SequenceBlockAbsence, IsNoNumberBeforeAnythingWasShown) {
    const BlockBench map{false, false};
    expect_words(map, nothing_there, "at the start");
    EXPECT_EQ(map.image().input, map.image().holding) << "FC4 mirrors FC3";
}

TEST(SequenceBlockAbsence, IsToldFromAValueOfZeroAndComesBack) {
    BlockBench map{false, false};
    map.show(all_zero());
    for (const auto& [address, value] : nothing_there)
        EXPECT_EQ(map.word(address), 0) << "word " << address << " of a value that is there";
    map.show(PortStatus{});
    expect_words(map, nothing_there, "after the values went");
}

TEST(SequenceBlockAbsence, FollowsTheWordOrderOfTheStationFile) {
    const BlockBench map{true, false};
    expect_words(map, {{20, 0}, {21, 0x8000}, {22, 0}, {23, 0x8000}, {25, 0}, {26, 0x8000}},
                 "low word first");
}

TEST(SequenceBlockAbsence, IsEachValuesOwn) {
    BlockBench map{false, false};
    PortStatus status = all_zero();
    status.deviation_um.reset();
    map.show(status);
    expect_words(map, {{20, 0}, {21, 0}, {22, 0x8000}, {23, 0}, {24, 0}, {25, 0}, {26, 0}},
                 "without a deviation alone");
}

TEST(SequenceBlockAbsence, IsNeverWhatAValueTooLargeReads) {
    BlockBench map{false, false};
    PortStatus status = all_zero();
    status.measured_mm = -1e9;          // far below -214748.3647 mm
    status.deviation_um = -21474836.48; // just the absent count: 0.01 um * -2147483648
    status.next_nominal_mm = 1e9;
    status.air_degC = -400; // -40000 counts of 0.01 degC
    map.show(status);
    expect_words(
        map,
        {{20, 0x8000}, {21, 1}, {22, 0x8000}, {23, 1}, {25, 0x7FFF}, {26, 0xFFFF}, {28, 0x8001}},
        "beyond the words");
}

TEST(SequenceBlockAbsence, IsWhatAValueThatIsNoNumberReads) {
    BlockBench map{false, false};
    PortStatus status = all_zero();
    status.measured_mm = std::numeric_limits<double>::quiet_NaN();
    status.deviation_um = std::numeric_limits<double>::infinity();
    status.air_degC = std::numeric_limits<double>::quiet_NaN();
    map.show(status);
    expect_words(map, {{20, 0x8000}, {21, 0}, {22, 0x8000}, {23, 0}, {28, 0x8000}}, "of NaN");
}

} // namespace
} // namespace axiscal::cnc_sequence_block_words_test
