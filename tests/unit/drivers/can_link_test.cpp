// A CAN link on one end of a socketpair that carries struct can_frame, as a raw socket does: this
// runs where the kernel has no CAN. The kernel's own sockets are met in tests/kernel.
#include "drivers/loop/asio_scheduler.hpp"
#include "drivers/wire/can_interface.hpp"
#include "drivers/wire/can_link.hpp"
#include "drivers/wire/link_opener.hpp"
#include "tests/support/loop_until.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <gtest/gtest.h>

#include <linux/can.h>
#include <linux/can/error.h>
#include <sys/socket.h>
#include <unistd.h>

namespace axiscal::can_link_test {
namespace {

template <class T> Task<void> keep_result(Task<T> task, std::optional<T>& result) {
    result = co_await std::move(task);
}

class CanLinkTest : public ::testing::Test {
protected:
    CanLinkTest() {
        std::array<int, 2> ends{-1, -1};
        EXPECT_EQ(::socketpair(AF_UNIX, SOCK_SEQPACKET, 0, ends.data()), 0);
        bus = ends[1];
        link = can_link_over(scheduler, ends[0], "no-can0");
    }
    ~CanLinkTest() override { hang_up(); }
    CanLinkTest(const CanLinkTest&) = delete;
    CanLinkTest& operator=(const CanLinkTest&) = delete;

    template <class T> T wait(Task<T> task) {
        std::optional<T> result;
        boost::asio::co_spawn(loop, keep_result(std::move(task), result), boost::asio::detached);
        EXPECT_TRUE(testing::loop_until(loop, [&] { return result.has_value(); }));
        return *std::move(result);
    }
    void put(std::uint32_t id, const std::vector<std::uint8_t>& data) {
        ::can_frame raw{};
        raw.can_id = id;
        raw.can_dlc = static_cast<std::uint8_t>(data.size());
        std::copy(data.begin(), data.end(), raw.data);
        EXPECT_EQ(::write(bus, &raw, sizeof raw), static_cast<ssize_t>(sizeof raw));
    }
    void hang_up() {
        if (bus >= 0) ::close(std::exchange(bus, -1));
    }
    [[nodiscard]] MonotonicTime soon() const { return scheduler.now() + std::chrono::seconds{10}; }

    boost::asio::io_context loop;
    AsioScheduler scheduler{loop};
    int bus = -1;
    std::unique_ptr<CanLink> link;
};

TEST_F(CanLinkTest, CarriesFramesBothWays) {
    put(0x1FD, {0xDF, 0x07, 0x00, 0x00, 0x00});
    put(0x77D, {0x05});
    const auto arrived = wait(link->read_some(soon()));
    ASSERT_TRUE(arrived) << describe(arrived.error());
    ASSERT_EQ(arrived->size(), 2U) << "both at once";
    EXPECT_EQ((*arrived)[0].frame, plain_frame(0x1FD, {0xDF, 0x07, 0, 0, 0}));
    EXPECT_EQ((*arrived)[1].frame, plain_frame(0x77D, {0x05}));
    const CanFrame question = plain_frame(0x67D, {0x40, 0x00, 0x10, 0, 0, 0, 0, 0});
    EXPECT_TRUE(wait(link->send(question, soon())));
    ::can_frame raw{};
    ASSERT_EQ(::read(bus, &raw, sizeof raw), static_cast<ssize_t>(sizeof raw));
    EXPECT_EQ(raw.can_id, 0x67DU);
    EXPECT_EQ(raw.can_dlc, 8);
    EXPECT_EQ(raw.data[0], 0x40);
}

TEST_F(CanLinkTest, StampsNoLaterThanItReads) {
    const MonotonicTime before = scheduler.now();
    put(0x1FD, {1});
    const auto arrived = wait(link->read_some(soon()));
    ASSERT_TRUE(arrived);
    EXPECT_GE(arrived->front().at, before - std::chrono::milliseconds{1});
    EXPECT_LE(arrived->front().at, scheduler.now());
}

TEST_F(CanLinkTest, KeepsExtendedAndRemoteFramesApart) {
    put(0x18FEF500U | CAN_EFF_FLAG, {1});
    put(0x1FDU | CAN_RTR_FLAG, {});
    const auto arrived = wait(link->read_some(soon()));
    ASSERT_EQ(arrived->size(), 2U);
    EXPECT_TRUE((*arrived)[0].frame.extended);
    EXPECT_EQ((*arrived)[0].frame.id, 0x18FEF500U);
    EXPECT_FALSE((*arrived)[0].frame.is_plain());
    EXPECT_TRUE((*arrived)[1].frame.remote);
}

TEST_F(CanLinkTest, SendsARemoteFrameAsOne) {
    CanFrame question = plain_frame(0x77D, {0});
    question.remote = true;
    EXPECT_TRUE(wait(link->send(question, soon())));
    ::can_frame raw{};
    ASSERT_EQ(::read(bus, &raw, sizeof raw), static_cast<ssize_t>(sizeof raw));
    EXPECT_EQ(raw.can_id, 0x77DU | CAN_RTR_FLAG);
    EXPECT_EQ(raw.can_dlc, 1) << "one byte is asked for";
}

TEST_F(CanLinkTest, EndsAtTheDeadlineWithATimeOut) {
    const auto arrived = wait(link->read_some(scheduler.now()));
    ASSERT_FALSE(arrived);
    EXPECT_EQ(arrived.error().fault, Fault::link_timeout);
}

TEST_F(CanLinkTest, TellsBusOffAfterTheFramesThatCameBeforeIt) {
    put(0x1FD, {1});
    put(CAN_ERR_FLAG | CAN_ERR_BUSOFF, {0, 0, 0, 0, 0, 0, 0, 0});
    EXPECT_TRUE(wait(link->read_some(soon())));
    const auto off = wait(link->read_some(soon()));
    ASSERT_FALSE(off);
    EXPECT_EQ(off.error().fault, Fault::link_closed);
    EXPECT_NE(off.error().detail.find("bus-off"), std::string::npos);
    EXPECT_EQ(link->bus_errors(), 1U);
}

TEST_F(CanLinkTest, CountsWhatTheControllerComplainsOf) {
    put(CAN_ERR_FLAG | CAN_ERR_CRTL, {0, CAN_ERR_CRTL_RX_OVERFLOW, 0, 0, 0, 0, 0, 0});
    put(CAN_ERR_FLAG | CAN_ERR_RESTARTED, {0, 0, 0, 0, 0, 0, 0, 0});
    put(0x1FD, {1});
    const auto arrived = wait(link->read_some(soon()));
    ASSERT_EQ(arrived->size(), 1U);
    EXPECT_EQ(link->bus_errors(), 1U);
}

TEST_F(CanLinkTest, TellsThatTheInterfaceIsGone) {
    put(0x1FD, {1});
    hang_up();
    EXPECT_TRUE(wait(link->read_some(soon())));
    const auto gone = wait(link->read_some(soon()));
    ASSERT_FALSE(gone);
    EXPECT_EQ(gone.error().fault, Fault::link_closed);
    EXPECT_NE(gone.error().detail.find("no CAN interface no-can0"), std::string::npos);
    const CanFrame frame = plain_frame(0x67D, {1});
    const auto sent = wait(link->send(frame, soon()));
    ASSERT_FALSE(sent);
    EXPECT_EQ(describe(sent.error()), describe(gone.error())) << "one sentence for one thing";
}

TEST(CanInterface, IsToldFromOthers) {
    EXPECT_EQ(can_state("lo"), CanState::not_can);
    EXPECT_EQ(can_state("no-such-can"), CanState::missing);
    EXPECT_EQ(can_state("a name that is much too long for the kernel"), CanState::missing);
}

TEST(CanInterface, ThatIsMissingIsRefusedByTheOpener) {
    boost::asio::io_context loop;
    AsioScheduler scheduler{loop};
    RealLinkOpener opener{scheduler};
    LinkSettings settings;
    settings.kind = LinkSettings::Kind::can;
    settings.path = "no-can0";
    EXPECT_EQ(settings.describe(), "CAN no-can0");
    std::optional<Result<std::unique_ptr<CanLink>>> opened;
    auto opening = opener.open_can(settings, scheduler.now());
    boost::asio::co_spawn(loop, keep_result(std::move(opening), opened), boost::asio::detached);
    ASSERT_TRUE(testing::loop_until(loop, [&] { return opened.has_value(); }));
    ASSERT_FALSE(*opened);
    EXPECT_EQ(opened->error().fault, Fault::link_closed);
    EXPECT_NE(opened->error().detail.find("no-can0"), std::string::npos);
}

} // namespace
} // namespace axiscal::can_link_test
