#include "drivers/framing/checksum.hpp"
#include "drivers/trigger/rtu_framer.hpp"

#include <gtest/gtest.h>

#include <random>

namespace axiscal::cnc_rtu_framer_test {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Frames = std::vector<Bytes>;

constexpr std::uint8_t ours = 17;
// Modbus over serial line V1.02, appendix B: 02 07 has the CRC 41 12
const Bytes published{0x02, 0x07, 0x41, 0x12};

Bytes with_crc(Bytes frame) {
    const std::uint16_t crc = crc16_modbus(frame);
    frame.push_back(static_cast<std::uint8_t>(crc & 0xFF));
    frame.push_back(static_cast<std::uint8_t>(crc >> 8));
    return frame;
}

Bytes joined(const Frames& parts) {
    Bytes all;
    for (const Bytes& part : parts)
        all.insert(all.end(), part.begin(), part.end());
    return all;
}

Frames drain(RtuFramer& framer) {
    Frames frames;
    while (auto frame = framer.next())
        frames.push_back(*std::move(frame));
    return frames;
}

Frames frames_of(const Bytes& bytes, bool then_silence = false) {
    RtuFramer framer{ours};
    framer.feed(bytes);
    auto frames = drain(framer);
    if (!then_silence) return frames;
    framer.silence();
    for (Bytes& frame : drain(framer))
        frames.push_back(std::move(frame));
    EXPECT_FALSE(framer.pending());
    return frames;
}

const Bytes our_read = with_crc({ours, 3, 0, 18, 0, 1});
const Bytes our_write = with_crc({ours, 16, 0, 1, 0, 2, 4, 0, 2, 0, 1});
const Bytes our_coils = with_crc({ours, 15, 0, 0, 0, 9, 2, 0xFF, 1});
const Bytes our_exchange = with_crc({ours, 23, 0, 18, 0, 2, 0, 2, 0, 1, 2, 0, 2});

TEST(RtuChecksums, AreThoseOfTheStandardAndOfTheCatalogue) {
    EXPECT_EQ(with_crc({0x02, 0x07}), published);
    EXPECT_EQ(crc16_modbus(Bytes{'1', '2', '3', '4', '5', '6', '7', '8', '9'}), 0x4B37);
}

TEST(RtuFramer, FindsEveryKindOfRequestWithoutWaitingForSilence) {
    for (std::uint8_t function = 1; function <= 6; ++function) {
        const Bytes request = with_crc({ours, function, 0, 0, 0, 1});
        EXPECT_EQ(frames_of(request), Frames{request}) << int{function};
    }
    for (const Bytes& request : {our_write, our_coils, our_exchange})
        EXPECT_EQ(frames_of(request), Frames{request});
}

TEST(RtuFramer, WaitsForTheRestOfAFrame) {
    for (const Bytes& request : {our_read, our_write, our_coils, our_exchange}) {
        RtuFramer framer{ours};
        for (std::size_t i = 0; i + 1 < request.size(); ++i) {
            framer.feed(std::span{request}.subspan(i, 1));
            EXPECT_FALSE(framer.next()) << i;
        }
        framer.feed(std::span{request}.last(1));
        EXPECT_EQ(framer.next(), request);
        EXPECT_EQ(framer.noise(), 0U);
    }
}

TEST(RtuFramer, KeepsStepThroughRequestsAndAnswersOfOthers) {
    const Frames talk{with_crc({18, 3, 0, 0, 0, 2}), // asked and answered
                      with_crc({18, 3, 4, 0, 1, 0, 2}),
                      with_crc({19, 4, 0, 0, 0, 1}), // asked, nobody there
                      our_read,
                      with_crc({18, 16, 0, 1, 0, 1, 2, 0, 7}), // asked, nobody there
                      our_write,
                      with_crc({18, 6, 0, 1, 0, 7}), // answered by an exception
                      with_crc({18, 0x86, 2}),
                      with_crc({0, 16, 0, 1, 0, 2, 4, 0, 2, 0, 2}), // to everybody
                      with_crc({18, 1, 0, 0, 0, 9}),
                      with_crc({18, 1, 2, 0xFF, 1}),
                      our_exchange};
    EXPECT_EQ(frames_of(joined(talk)), talk);
}

TEST(RtuFramer, AFrameOfAnUnknownFunctionEndsWithTheSilence) {
    const Bytes foreign = with_crc({19, 43, 14, 1, 0}), asked = with_crc({ours, 17});
    EXPECT_TRUE(frames_of(foreign).empty());
    EXPECT_EQ(frames_of(foreign, true), Frames{foreign});
    EXPECT_EQ(frames_of(asked, true), Frames{asked});
    // No silence was seen before ours: it is found behind, when the line is silent.
    EXPECT_EQ(frames_of(joined({foreign, our_read}), true), Frames{our_read});
}

TEST(RtuFramer, ATornOrDamagedFrameCostsNoOther) {
    Bytes damaged = our_write;
    damaged[5] ^= 0x10;
    for (const Bytes& wreck : {Bytes{ours, 16, 0}, Bytes{18, 16, 0, 1, 0, 100, 200, 0}, Bytes{0xFF},
                               Bytes{0, 0, 0}, damaged})
        EXPECT_EQ(frames_of(joined({wreck, our_read}), true), Frames{our_read});
}

// A frame with a good checksum has one also with a zero behind it: where that makes a request of an
// answer, the zero of a glitch goes with it, that of a broadcast costs the broadcast.
TEST(RtuFramer, AZeroBehindAFrameCostsNoRequestToUs) {
    const Bytes answer = with_crc({18, 3, 2, 0, 7}), zero{0};
    const Bytes everybody = with_crc({0, 6, 0, 1, 0, 2});
    for (const Bytes& talk :
         {joined({answer, zero, our_read}), joined({answer, everybody, our_read}),
          joined({our_write, zero, our_read})})
        EXPECT_EQ(frames_of(talk, true).back(), our_read);
}

TEST(RtuFramer, NeverHoldsMoreThanAFrameOfWhatItCannotRead) {
    // A line that is never silent: the next frame is found within the longest frame.
    RtuFramer framer{ours};
    Frames found;
    framer.feed(Bytes{18, 99});
    for (int i = 0; i < 40; ++i) {
        framer.feed(our_read);
        for (Bytes& frame : drain(framer))
            found.push_back(std::move(frame));
    }
    EXPECT_EQ(found.size(), 40U);
    EXPECT_EQ(found.front(), our_read);
}

TEST(RtuFramer, ALawFindsTheRequestAfterAnyGarbageAndASilence) {
    std::mt19937 random{20261124};
    for (int round = 0; round < 2000; ++round) {
        Bytes garbage(random() % 600);
        for (std::uint8_t& byte : garbage)
            byte = static_cast<std::uint8_t>(random());
        const Bytes both = joined({garbage, our_write});
        RtuFramer framer{ours};
        Frames found;
        for (std::size_t at = 0; at < both.size();) { // in lumps, as an adapter hands them over
            const std::size_t lump = std::min<std::size_t>(1 + random() % 62, both.size() - at);
            framer.feed(std::span{both}.subspan(at, lump));
            at += lump;
            for (Bytes& frame : drain(framer))
                found.push_back(std::move(frame));
        }
        framer.silence();
        for (Bytes& frame : drain(framer))
            found.push_back(std::move(frame));
        ASSERT_FALSE(found.empty()) << round;
        EXPECT_EQ(found.back(), our_write) << round;
        EXPECT_FALSE(framer.pending());
    }
}

} // namespace
} // namespace axiscal::cnc_rtu_framer_test
