// The driver of the Lasertex HPI-3D on a pseudo terminal, before a laser that answers, loses its
// beam, is disturbed and unplugged.
#include "drivers/loop/asio_scheduler.hpp"
#include "tests/support/loop_until.hpp"
#include "tests/support/made_instrument.hpp"
#include "tests/support/pty_pair.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/watched_opener.hpp"
#include "tests/unit/drivers/lasertex_wire.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <gtest/gtest.h>

#include <filesystem>

namespace axiscal::laser_lasertex_test {
namespace {

using namespace lasertex_wire;

/// One running driver, and a laser that answers behind a path that stays, as udev's names do.
class LaserOnAPty {
public:
    explicit LaserOnAPty(boost::asio::io_context& loop)
        : loop_{loop}
        , scheduler_{loop}
        , device_{folder_.path() + "/device"}
        , instrument_{
              testing::instrument("lasertex", "link = \"serial:" + device_ + "\"\n" + raw_keys)} {
        plug();
    }
    void plug() {
        std::filesystem::remove(device_);
        pty_ = std::make_unique<testing::PtyPair>();
        std::filesystem::create_symlink(pty_->path, device_);
        asked_.clear();
        ended.reset();
        boost::asio::co_spawn(loop_, run(), boost::asio::detached);
    }
    void unplug() { pty_->unplug(); }
    void send(const Bytes& bytes) {
        pty_->send({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    }
    /// Answers what was ordered and sends a distance, until the condition holds.
    template <class Condition> bool until(Condition condition) {
        return testing::loop_until(loop_, [&] {
            serve();
            return condition();
        });
    }
    [[nodiscard]] bool shows(int wanted, std::uint32_t epoch) const {
        const auto found = positions(sink);
        return !found.empty() && found.back().epoch == epoch &&
               found.back().value() == std::optional{1e-10 * wanted};
    }

    testing::SampleRecorder sink;
    std::optional<Fault> ended;
    int steps = 0;
    bool beam = true, weak = false; ///< weak: kept until it is told to forget
    std::vector<int> ordered;

private:
    void serve() {
        if (ended) return;
        asked_ += pty_->receive(8 - asked_.size(), 0);
        weak = weak || !beam;
        if (asked_.size() == 8) {
            const int command = static_cast<unsigned char>(asked_[2]);
            ordered.push_back(command);
            if (command == 0x3D) weak = !beam;
            send(acknowledgement(command));
            asked_.clear();
        }
        send(distance(steps, weak ? 1 : 9));
    }
    Task<void> run() {
        const InstrumentContext context{&scheduler_, &opener_, &sink};
        const auto result = co_await instrument_->run(context);
        ended = result ? Fault::none : result.error().fault;
    }

    boost::asio::io_context& loop_;
    AsioScheduler scheduler_;
    testing::WatchedOpener opener_{scheduler_};
    testing::ScratchFolder folder_;
    std::string device_;
    std::unique_ptr<Instrument> instrument_;
    std::unique_ptr<testing::PtyPair> pty_;
    std::string asked_;
};

TEST(LasertexOnAPty, IsOrderedToSendAndNeverToSetItsZero) {
    boost::asio::io_context loop;
    LaserOnAPty laser{loop};
    laser.steps = 5;
    ASSERT_TRUE(laser.until([&] { return laser.shows(5, 0); }));
    EXPECT_EQ(laser.ordered, (std::vector<int>{0x32, 0x35, 0x79, 0x3F, 0x3D}));
    EXPECT_EQ(laser.sink.identities.front().model, "HPI-3D");
}

TEST(LasertexOnAPty, ALostBeamIsToldAndItsReturnIsANewDatum) {
    boost::asio::io_context loop;
    LaserOnAPty laser{loop};
    ASSERT_TRUE(laser.until([&] { return laser.shows(0, 0); }));
    laser.beam = false;
    ASSERT_TRUE(
        laser.until([&] { return positions(laser.sink).back().quality() == Quality::beam_lost; }));
    EXPECT_EQ(laser.sink.notes.back(), Fault::beam_lost);
    laser.beam = true;
    laser.steps = 3;
    ASSERT_TRUE(laser.until([&] { return laser.shows(3, 1); }));
    EXPECT_EQ(laser.ordered.back(), 0x3D) << "the laser keeps the flag until it is told";
    EXPECT_EQ(laser.sink.notes.back(), Fault::datum_lost);
}

TEST(LasertexOnAPty, UnpluggedIsToldAndItComesBackWithANewEpoch) {
    boost::asio::io_context loop;
    LaserOnAPty laser{loop};
    ASSERT_TRUE(laser.until([&] { return laser.shows(0, 0); }));
    laser.unplug();
    ASSERT_TRUE(laser.until([&] { return laser.ended.has_value(); }));
    EXPECT_EQ(*laser.ended, Fault::link_closed);
    laser.plug();
    ASSERT_TRUE(laser.until([&] { return laser.shows(0, 1); }));
    EXPECT_FALSE(laser.ended);
}

TEST(LasertexOnAPty, NoiseBetweenFramesIsCountedAndGivesNoPosition) {
    boost::asio::io_context loop;
    LaserOnAPty laser{loop};
    ASSERT_TRUE(laser.until([&] { return laser.shows(0, 0); }));
    const Bytes torn = distance(1 << 22);
    laser.send(Bytes(torn.begin(), torn.begin() + 11));
    laser.steps = 2;
    ASSERT_TRUE(laser.until([&] { return laser.shows(2, 0); }));
    for (const Sample& sample : positions(laser.sink))
        EXPECT_TRUE(sample.value() == std::optional{0.0} || sample.value() == std::optional{2e-10});
}

} // namespace
} // namespace axiscal::laser_lasertex_test
