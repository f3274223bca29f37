// Literal frames of a Lasertex HPI-3D, worked out from the public reader that laser_lasertex.cpp
// names; checksums by the polynomial.
#include "drivers/framing/byte_order.hpp"
#include "drivers/framing/checksum.hpp"
#include "drivers/laser/lasertex_frame.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

namespace axiscal::lasertex_frame_test {
namespace {

using Bytes = std::vector<std::byte>;

/// -123.4567891 mm, laser ready, signal strong enough, level 0x50.
const Bytes distance_frame = bytes_of({0xAA, 0xB0, 0x15, 0xFF, 0xFF, 0xFF, 0xB6, 0x69, 0xFD, 0x2D,
                                       0x00, 0x00, 0x00, 0x09, 0x50, 0x84});

Bytes sealed(Bytes frame) {
    frame.resize(lasertex_frame_bytes - 1);
    frame.push_back(std::byte{crc8_nrsc5(frame)});
    return frame;
}

Bytes joined(std::initializer_list<Bytes> parts) {
    Bytes all;
    for (const Bytes& part : parts)
        all.insert(all.end(), part.begin(), part.end());
    return all;
}

Bytes distance_of(std::int64_t steps) {
    Bytes frame = bytes_of({0xAA, 0xB0, 0x15});
    for (int shift = 48; shift >= 0; shift -= 8)
        frame.push_back(static_cast<std::byte>(steps >> shift & 0xFF));
    const Bytes tail = bytes_of({0, 0, 0, 0x09, 0x50});
    frame.insert(frame.end(), tail.begin(), tail.end());
    return sealed(std::move(frame));
}

template <class Message> std::optional<Message> decoded(const Bytes& frame) {
    const auto message = decode_lasertex_frame(frame);
    if (!message || !std::holds_alternative<Message>(*message)) return std::nullopt;
    return std::get<Message>(*message);
}

std::vector<double> positions_in(const std::vector<LasertexArrival>& arrivals) {
    std::vector<double> positions;
    for (const LasertexArrival& arrival : arrivals)
        if (arrival.message && std::holds_alternative<LasertexDistance>(*arrival.message))
            positions.push_back(std::get<LasertexDistance>(*arrival.message).position_m);
    return positions;
}

TEST(Crc8Nrsc5, HasItsCheckValue) {
    const std::string digits = "123456789";
    EXPECT_EQ(crc8_nrsc5(std::as_bytes(std::span{digits})), 0xF7);
    EXPECT_EQ(crc8_nrsc5({}), 0xFF);
}

TEST(LasertexFrame, AsksForDistances) {
    EXPECT_EQ(lasertex_request(LasertexCommand::distance_on),
              bytes_of({0xAA, 0xB0, 0x32, 0, 0, 0, 0, 0x8E}));
}

TEST(LasertexFrame, ReadsADistance) {
    const auto distance = decoded<LasertexDistance>(distance_frame);
    ASSERT_TRUE(distance);
    EXPECT_DOUBLE_EQ(distance->position_m, -0.1234567891);
    EXPECT_TRUE(distance->signal.laser_ready);
    EXPECT_FALSE(distance->signal.weak);
    EXPECT_FALSE(distance->signal.overspeed);
    EXPECT_EQ(distance->signal.level, 0x50);
}

TEST(LasertexFrame, ReadsEveryFlagOfTheSignal) {
    auto frame = distance_frame;
    frame[12] = std::byte{0x08};
    frame[13] = std::byte{0x00};
    const auto distance = decoded<LasertexDistance>(sealed(frame));
    ASSERT_TRUE(distance);
    EXPECT_TRUE(distance->signal.overspeed);
    EXPECT_TRUE(distance->signal.weak);
    EXPECT_FALSE(distance->signal.laser_ready);
    frame[12] = std::byte{0xF7}; // bits that are not known
    frame[13] = std::byte{0xFF};
    const auto fine = decoded<LasertexDistance>(sealed(frame));
    ASSERT_TRUE(fine);
    EXPECT_FALSE(fine->signal.overspeed || fine->signal.weak || !fine->signal.laser_ready);
}

TEST(LasertexFrame, ReadsPositionsOfEitherSignToTheirLastStep) {
    for (const std::int64_t steps :
         {0LL, 1LL, -1LL, 127LL, 128LL, -128LL, 1LL << 31, -(1LL << 31), 10'000'000'000'000LL}) {
        const auto distance = decoded<LasertexDistance>(distance_of(steps));
        ASSERT_TRUE(distance) << steps;
        EXPECT_DOUBLE_EQ(distance->position_m, static_cast<double>(steps) * 1e-10);
    }
    EXPECT_FALSE(decoded<LasertexDistance>(distance_of(10'000'000'000'001LL))) << "beyond 1000 m";
    EXPECT_FALSE(decoded<LasertexDistance>(distance_of(-10'000'000'000'001LL)));
}

TEST(LasertexFrame, ReadsAVelocity) {
    // -1.5 m/s: -15000000 steps are FF 1B 1E 40.
    const auto velocity = decoded<LasertexVelocity>(
        sealed(bytes_of({0xAA, 0xB0, 0x16, 0xFF, 0x1B, 0x1E, 0x40, 0, 0, 0, 0, 0, 0, 0x09, 0x42})));
    ASSERT_TRUE(velocity);
    EXPECT_DOUBLE_EQ(velocity->velocity_m_per_s, -1.5);
    EXPECT_EQ(velocity->signal.level, 0x42);
}

TEST(LasertexFrame, ReadsTheAir) {
    // 21.37 degC is 0859, 45 %, 1013.2 hPa is 10132 steps: 2794.
    const auto air = decoded<LasertexMeteo>(
        sealed(bytes_of({0xAA, 0xB0, 0x0A, 0, 0x08, 0x59, 45, 3, 7, 0x27, 0x94, 0, 0, 0, 0})));
    ASSERT_TRUE(air);
    EXPECT_EQ(air->sensor, 0);
    EXPECT_DOUBLE_EQ(air->temperature_degC.value(), 21.37);
    EXPECT_DOUBLE_EQ(air->humidity_percent.value(), 45);
    EXPECT_DOUBLE_EQ(air->pressure_Pa.value(), 101320);
}

TEST(LasertexFrame, ReadsAMaterialWhichHasATemperatureAlone) {
    // -5.25 degC is FDF3.
    const auto material = decoded<LasertexMeteo>(
        sealed(bytes_of({0xAA, 0xB0, 0x0A, 2, 0xFD, 0xF3, 45, 3, 7, 0x27, 0x94, 0, 0, 0, 0})));
    ASSERT_TRUE(material);
    EXPECT_EQ(material->sensor, 2);
    EXPECT_DOUBLE_EQ(material->temperature_degC.value(), -5.25);
    EXPECT_FALSE(material->humidity_percent || material->pressure_Pa);
}

TEST(LasertexFrame, GivesNoNumberForAirThatCannotBe) {
    const auto air = decoded<LasertexMeteo>(
        sealed(bytes_of({0xAA, 0xB0, 0x0A, 0, 0x80, 0x00, 0xFF, 0, 0, 0xFF, 0xFF, 0, 0, 0, 0})));
    ASSERT_TRUE(air);
    EXPECT_FALSE(air->temperature_degC || air->humidity_percent || air->pressure_Pa);
}

TEST(LasertexFrame, TellsWhatIsAcknowledged) {
    for (const LasertexCommand command :
         {LasertexCommand::distance_on, LasertexCommand::velocity_off, LasertexCommand::meteo_on,
          LasertexCommand::forget_overspeed, LasertexCommand::forget_weak_signal}) {
        const auto answer = decoded<LasertexAcknowledgement>(sealed(lasertex_request(command)));
        ASSERT_TRUE(answer);
        EXPECT_EQ(answer->command, command);
    }
    EXPECT_FALSE(decode_lasertex_frame(sealed(bytes_of({0xAA, 0xB0, 0x48})))) << "unknown here";
}

TEST(LasertexFrame, IsRefusedForEveryDamagedByte) {
    for (std::size_t at = 0; at < distance_frame.size(); ++at)
        for (int change = 1; change < 256; ++change) {
            auto damaged = distance_frame;
            damaged[at] ^= static_cast<std::byte>(change);
            ASSERT_FALSE(is_lasertex_frame(damaged)) << at << " ^ " << change;
        }
}

TEST(LasertexFramer, HandsAFrameUpWhenTheNextHasComeWithTheTimeOfItsOwn) {
    LasertexFramer framer;
    const auto early = monotonic_from_ns(1000), late = monotonic_from_ns(40'001'000);
    EXPECT_TRUE(framer.feed(distance_frame, early).empty());
    const auto arrivals = framer.feed(distance_of(7), late);
    ASSERT_EQ(arrivals.size(), 1U);
    EXPECT_EQ(arrivals[0].read_at, early);
    EXPECT_EQ(positions_in(arrivals), std::vector<double>{-0.1234567891});
    EXPECT_EQ(framer.feed(distance_of(8), late).at(0).read_at, late);
    EXPECT_EQ(framer.take_damaged(), 0U);
}

TEST(LasertexFramer, TellsHowManyDistancesWereReadBehindEach) {
    LasertexFramer framer;
    const auto meteo = sealed(bytes_of({0xAA, 0xB0, 0x0A, 0, 0x08, 0x59, 45, 3, 7, 0x27, 0x94}));
    EXPECT_TRUE(framer.feed(distance_of(0), monotonic_from_ns(1)).empty());
    const auto arrivals = framer.feed(
        joined({distance_of(1), distance_of(2), meteo, distance_of(3)}), monotonic_from_ns(2));
    ASSERT_EQ(arrivals.size(), 4U);
    EXPECT_EQ(arrivals[0].behind, 0) << "read before them";
    EXPECT_EQ(arrivals[1].behind, 2) << "the last one waits for its next";
    EXPECT_EQ(arrivals[2].behind, 1);
    EXPECT_EQ(arrivals[3].behind, 1);
    EXPECT_EQ(framer.feed(distance_of(4), monotonic_from_ns(3)).at(0).behind, 0);
}

TEST(LasertexFramer, TakesAFrameOfAnUnknownCommandAsOneOfTheStream) {
    LasertexFramer framer;
    const auto stranger = sealed(bytes_of({0xAA, 0xC1, 0x77, 1, 2, 3}));
    const auto arrivals =
        framer.feed(joined({distance_of(1), stranger, distance_of(2), distance_of(3)}), {});
    EXPECT_EQ(positions_in(arrivals), (std::vector<double>{1e-10, 2e-10}));
    EXPECT_EQ(framer.take_damaged(), 0U);
}

TEST(LasertexFramer, FindsTheStreamAgainBehindAHalfFrame) {
    LasertexFramer framer;
    const Bytes half(distance_frame.begin() + 5, distance_frame.end());
    const auto arrivals = framer.feed(joined({half, distance_of(1), distance_of(2)}), {});
    EXPECT_EQ(positions_in(arrivals), std::vector<double>{1e-10});
    EXPECT_EQ(framer.take_damaged(), 1U);
    EXPECT_EQ(framer.take_damaged(), 0U);
}

/// What tears a frame costs it and the one before; whatever is handed up was sent.
TEST(LasertexFramer, LosesNoMoreThanTheNeighboursOfAByteThatIsGone) {
    for (std::size_t gone = 0; gone < lasertex_frame_bytes; ++gone) {
        auto torn = distance_of(3);
        torn.erase(torn.begin() + static_cast<std::ptrdiff_t>(gone));
        LasertexFramer framer;
        const auto arrivals = framer.feed(joined({distance_of(1), distance_of(2), torn,
                                                  distance_of(4), distance_of(5), distance_of(6)}),
                                          {});
        EXPECT_EQ(positions_in(arrivals), (std::vector<double>{1e-10, 4e-10, 5e-10})) << gone;
    }
}

TEST(LasertexFramer, MakesNoDifferenceOfHowTheBytesCome) {
    const Bytes all = joined({distance_of(1), bytes_of({0xAA, 0xAA, 0xB0}), distance_of(2),
                              distance_of(3), distance_of(4)});
    LasertexFramer at_once, byte_by_byte;
    const auto whole = positions_in(at_once.feed(all, {}));
    std::vector<double> split;
    for (const std::byte& byte : all)
        for (const double position : positions_in(byte_by_byte.feed({&byte, 1}, {})))
            split.push_back(position);
    EXPECT_EQ(whole, split);
    EXPECT_EQ(whole, (std::vector<double>{2e-10, 3e-10}));
    EXPECT_EQ(at_once.take_damaged(), byte_by_byte.take_damaged());
}

/// Of 10^8 random bytes 0.023 positions and as many readings of air pass an 8-bit checksum; with
/// the frame behind 1e-10 and 4e-7 are expected (lasertex_frame.hpp).
TEST(LasertexFramer, FindsNoValueInAHundredMillionRandomBytes) {
    std::mt19937_64 random{20261121};
    LasertexFramer framer;
    Bytes chunk(8000);
    std::size_t found = 0;
    std::uint64_t damaged = 0;
    for (int nth = 0; nth < 12'500; ++nth) {
        for (std::size_t at = 0; at < chunk.size(); at += 8) {
            const std::uint64_t eight = random();
            for (std::size_t byte = 0; byte < 8; ++byte)
                chunk[at + byte] = static_cast<std::byte>(eight >> 8 * byte & 0xFF);
        }
        for (const LasertexArrival& arrival : framer.feed(chunk, {}))
            found += arrival.message ? 1U : 0U;
        damaged += framer.take_damaged();
    }
    EXPECT_EQ(found, 0U);
    EXPECT_GE(damaged, 100'000'000 / lasertex_frame_bytes - 2);
}

Bytes disturbed(Bytes frame, std::mt19937& random) {
    const auto place = frame.begin() + static_cast<std::ptrdiff_t>(random() % frame.size());
    Bytes more(1 + random() % 20);
    std::ranges::generate(more, [&] { return static_cast<std::byte>(random() % 256); });
    switch (random() % 3) {
    case 0: *place ^= static_cast<std::byte>(1 + random() % 255); break;
    case 1: frame.erase(place, frame.end()); break;
    default: frame.insert(place, more.begin(), more.end()); break;
    }
    return frame;
}

/// What a bad plug does to every fourth of a million frames: a byte changed, some lost, some put
/// in.
TEST(LasertexFramer, HandsUpOnlyWhatWasSentThroughAWireThatLosesAndAddsBytes) {
    std::mt19937 random{7};
    LasertexFramer framer;
    std::size_t found = 0;
    double last = -1;
    for (std::int64_t sent = 0; sent < 1'000'000; ++sent) {
        const Bytes whole = distance_of(sent);
        const Bytes frame = sent % 4 == 3 ? disturbed(whole, random) : whole;
        for (const double position : positions_in(framer.feed(frame, {}))) {
            const double steps = std::round(position * 1e10);
            ASSERT_GT(steps, last) << "never twice, never back";
            ASSERT_LT(steps, static_cast<double>(sent)) << "nothing that was not sent yet";
            last = steps;
            ++found;
        }
    }
    EXPECT_GT(found, 450'000U); // two of four: the third of each four stands before the damage
}

} // namespace
} // namespace axiscal::lasertex_frame_test
