// Literal records in the layout of <linux/counter.h>, little-endian; and a named pipe that gives
// them instead of a device.
#include "drivers/laser/counter_record.hpp"
#include "drivers/loop/asio_scheduler.hpp"
#include "drivers/wire/link_opener.hpp"
#include "tests/support/loop_until.hpp"
#include "tests/support/made_instrument.hpp"
#include "tests/support/sample_recorder.hpp"
#include "tests/support/scratch_folder.hpp"

#include <array>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <cmath>
#include <cstring>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <limits>
#include <sys/stat.h>
#include <unistd.h>

namespace axiscal::counter_record_test {
namespace {

/// Time 0x0102030405060708 ns, value 1000, count 3 of type COUNT and scope COUNT, event INDEX (4)
/// on channel 1, status 0.
constexpr std::array<std::uint8_t, 24> literal{0x08, 0x07, 0x06, 0x05, 0x04, 0x03, 0x02, 0x01,
                                               0xE8, 0x03, 0,    0,    0,    0,    0,    0,
                                               2,    2,    3,    0,    4,    1,    0,    0xAA};

std::span<const std::byte> bytes_of(const std::array<std::uint8_t, 24>& record) {
    return std::as_bytes(std::span{record});
}

TEST(CounterRecord, IsTwentyFourBytesAsTheKernelWritesThem) {
    CounterFramer framer;
    const auto records = framer.feed(bytes_of(literal));
    ASSERT_EQ(records.size(), 1U);
    EXPECT_EQ(records[0].at_ns, 0x0102030405060708);
    EXPECT_EQ(records[0].value, 1000U);
    EXPECT_EQ(records[0].component_type, 2);
    EXPECT_EQ(records[0].scope, 2);
    EXPECT_EQ(records[0].parent, 3);
    EXPECT_EQ(records[0].event, 4);
    EXPECT_EQ(records[0].channel, 1);
    EXPECT_EQ(records[0].status, 0);
}

TEST(CounterRecord, ComesWholeHoweverThePipeCutsIt) {
    for (std::size_t cut = 0; cut <= literal.size(); ++cut) {
        CounterFramer framer;
        auto records = framer.feed(bytes_of(literal).first(cut));
        for (const CounterRecord& record : framer.feed(bytes_of(literal).subspan(cut)))
            records.push_back(record);
        ASSERT_EQ(records.size(), 1U) << cut;
        EXPECT_EQ(records[0].value, 1000U);
    }
}

TEST(CountUnwrapper, ComesRoundWithARegisterOf64Bits) {
    CountUnwrapper whole{64};
    constexpr auto highest = std::numeric_limits<std::int64_t>::max();
    EXPECT_EQ(whole.unwrap(static_cast<std::uint64_t>(highest)), highest);
    EXPECT_EQ(whole.unwrap(static_cast<std::uint64_t>(highest) + 1),
              std::numeric_limits<std::int64_t>::min());
}

TEST(CountUnwrapper, FollowsARegisterOverBothEnds) {
    CountUnwrapper sixteen{16};
    EXPECT_EQ(sixteen.unwrap(65530), -6);
    EXPECT_EQ(sixteen.unwrap(4), 4);
    EXPECT_EQ(sixteen.unwrap(32000), 32000);
    EXPECT_EQ(sixteen.unwrap(64000), 64000);
    EXPECT_EQ(sixteen.unwrap(1000), 66536);
    EXPECT_EQ(sixteen.unwrap(64000), 64000);
    CountUnwrapper whole{64};
    EXPECT_EQ(whole.unwrap(~std::uint64_t{0}), -1);
    EXPECT_EQ(whole.unwrap(5), 5);
}

Task<void>
run_until_it_ends(Instrument& instrument, InstrumentContext context, std::optional<Fault>& ended) {
    const auto result = co_await instrument.run(context);
    ended = result ? Fault::none : result.error().fault;
}

TEST(Counter, ReadsEventsFromAPipeAndEndsWithIt) {
    const testing::ScratchFolder folder;
    const std::string path = folder.path() + "/counter0";
    ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
    boost::asio::io_context loop;
    AsioScheduler scheduler{loop};
    RealLinkOpener opener{scheduler};
    testing::SampleRecorder sink;
    const auto counter = testing::instrument(
        "counter", "device = \"" + path +
                       "\"\nevent = \"capture\"\nbits = 24\nfastest = \"1 m/s\"\n"
                       "wavelength = \"632.991 nm\"\ncounts_per_cycle = 4\n");
    ASSERT_TRUE(counter->optics());
    std::optional<Fault> ended;
    // A reader that does not block opens first, then the writer finds it.
    const int writer = ::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
    boost::asio::co_spawn(loop, run_until_it_ends(*counter, {&scheduler, &opener, &sink}, ended),
                          boost::asio::detached);
    auto record = literal;
    const auto now_ns = nanoseconds_of(scheduler.now());
    std::memcpy(record.data(), &now_ns, 8);
    record[18] = 0; // count 0
    record[20] = 6; // capture
    ASSERT_EQ(::write(writer, record.data(), record.size()), 24);
    ASSERT_TRUE(testing::loop_until(loop, [&] { return sink.samples.size() == 1; }));
    // 1000 counts of a corner cube, four in a cycle: 1000 * 632.991 nm / 8.
    EXPECT_NEAR(sink.samples[0].value().value(), 1000 * 632.991e-9 / 8, 1e-12);
    EXPECT_EQ(nanoseconds_of(sink.samples[0].at), now_ns);
    // An interrupt within 50 us, before or after: rectangular (GUM 4.3.7).
    EXPECT_NEAR(seconds_of(sink.samples[0].time_uncertainty), 50e-6 / std::sqrt(3.0), 1e-9);
    std::memcpy(record.data(), literal.data(), 8); // the stamp of another clock
    ASSERT_EQ(::write(writer, record.data(), record.size()), 24);
    ASSERT_TRUE(testing::loop_until(loop, [&] { return sink.samples.size() == 2; }));
    EXPECT_GE(sink.samples[1].at, sink.samples[0].at) << "its arrival";
    EXPECT_EQ(sink.samples[1].time_uncertainty, Duration{}) << "nothing is known of its age";
    EXPECT_EQ(sink.notes, std::vector{Fault::bad_frame});
    ::close(writer);
    ASSERT_TRUE(testing::loop_until(loop, [&] { return ended.has_value(); }));
    EXPECT_EQ(*ended, Fault::link_closed);
}

TEST(Counter, IsAScaleOrALaserAndNotBoth) {
    const std::string keys =
        "device = \"/dev/counter0\"\nevent = \"index\"\nbits = 32\nfastest = \"1 m/s\"\n";
    const auto scale = testing::instrument("counter", keys + "resolution = \"0.1 um\"\n");
    EXPECT_FALSE(scale->optics().has_value());
    ASSERT_TRUE(scale->resolution());
    EXPECT_DOUBLE_EQ(scale->resolution()->in(um), 0.1);
    EXPECT_TRUE(scale->incremental());
    EXPECT_EQ(testing::make_instrument("counter", keys).refusals.size(), 1U);
    EXPECT_EQ(testing::make_instrument("counter", keys + "resolution = \"0.1 um\"\nwavelength = "
                                                         "\"633 nm\"\ncounts_per_cycle = 4\n")
                  .refusals.size(),
              1U);
}

} // namespace
} // namespace axiscal::counter_record_test
