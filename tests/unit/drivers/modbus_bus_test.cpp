// The shared Modbus line under virtual time, against slaves that answer late, twice, wrong or not
// at all. What they send is made here, checksum and all, apart from what reads it.
#include "drivers/loop/spawn.hpp"
#include "drivers/wire/modbus_bus.hpp"
#include "modbus_wire.hpp"
#include "tests/support/asked_seed.hpp"

#include <boost/asio/bind_cancellation_slot.hpp>
#include <gtest/gtest.h>

#include <random>

namespace axiscal::modbus_bus_test {
namespace {

using namespace std::chrono_literals;
using testing::Bytes, testing::Wire, testing::WireOpener, testing::with_checksum;

LinkSettings serial_line() {
    LinkSettings settings;
    settings.path = "/dev/no-such-line";
    return settings;
}

LinkSettings connection() {
    LinkSettings settings;
    settings.kind = LinkSettings::Kind::tcp;
    settings.host = "gateway";
    settings.port = 502;
    return settings;
}

struct Bench {
    explicit Bench(const LinkSettings& settings)
        : bus{settings, scheduler, opener} {}
    Task<void> ask(ModbusRead request, std::optional<Result<ModbusWords>>& said) {
        said = co_await bus.read(request);
    }
    Result<ModbusWords> read(const ModbusRead& request, Duration patience = 20s) {
        std::optional<Result<ModbusWords>> said;
        spawn(scheduler, ask(request, said));
        const MonotonicTime end = scheduler.now() + patience;
        while (!said && scheduler.now() < end)
            scheduler.run_for(1ms);
        return said ? *std::move(said) : fail(Fault::internal, "never said");
    }

    VirtualScheduler scheduler;
    Wire wire;
    WireOpener opener{scheduler, wire};
    ModbusBus bus;
};

ModbusRead one_register(int unit, int address) {
    ModbusRead request;
    request.unit_id = unit;
    request.function = 4;
    request.address = address;
    request.timeout = 300ms;
    return request;
}

Bytes answer_of(int unit, int word) {
    return with_checksum({static_cast<std::uint8_t>(unit), 4, 2,
                          static_cast<std::uint8_t>(word >> 8), static_cast<std::uint8_t>(word)});
}

// 23.1 degC at register 0, 45.6 % at register 16; once an answer comes 450 ms late.
TEST(ModbusBus, ALateAnswerIsNeverThatOfTheNextRequest) {
    Bench bench{serial_line()};
    int request_number = 0;
    bench.wire.slave = [&](const Bytes& request, MonotonicTime at) {
        const Duration after = ++request_number == 5 ? 450ms : 20ms;
        bench.wire.send(at + after, answer_of(1, request[3] == 0 ? 231 : 456));
    };
    int late = 0;
    for (int round = 0; round < 20; ++round)
        for (const auto& [address, word] : {std::pair{0, 231}, std::pair{16, 456}}) {
            const auto said = bench.read(one_register(1, address));
            late += said ? 0 : 1;
            EXPECT_TRUE(!said || said->words[0] == word) << said->words[0];
        }
    EXPECT_EQ(late, 1);
}

TEST(ModbusBus, AFrameThatWaitsAtTheOpeningIsNoAnswer) {
    Bench bench{serial_line()};
    bench.wire.send(bench.scheduler.now() + 100ms, answer_of(1, 456)); // whoever asked is gone
    bench.wire.slave = [&](const Bytes&, MonotonicTime at) {
        bench.wire.send(at + 20ms, answer_of(1, 231));
    };
    EXPECT_EQ(bench.read(one_register(1, 0))->words[0], 231);
}

TEST(ModbusBus, ADeadUnitHoldsItsNeighboursForItsTimeoutAlone) {
    Bench bench{serial_line()};
    bench.wire.slave = [&](const Bytes& request, MonotonicTime at) {
        if (request[0] == 1) bench.wire.send(at + 20ms, answer_of(1, 231));
    };
    EXPECT_TRUE(bench.read(one_register(1, 0)));
    const auto begin = bench.scheduler.now();
    EXPECT_EQ(bench.read(one_register(2, 0)).error().fault, Fault::link_timeout);
    EXPECT_TRUE(bench.read(one_register(1, 0)));
    EXPECT_LT(bench.scheduler.now() - begin, 400ms);
    const auto again = bench.read(one_register(2, 0));
    EXPECT_FALSE(again);
    EXPECT_GE(bench.scheduler.now() - begin, ModbusBus::latest_answer);
}

TEST(ModbusBus, WhoeverIsGivenUpWhileItAsksLeavesNoAnswerToTheNext) {
    Bench bench{serial_line()};
    int request_number = 0;
    bench.wire.slave = [&](const Bytes&, MonotonicTime at) {
        bench.wire.send(at + 200ms, answer_of(1, ++request_number));
    };
    std::optional<Result<ModbusWords>> said;
    boost::asio::cancellation_signal give_up;
    boost::asio::co_spawn(
        bench.scheduler.executor(), bench.ask(one_register(1, 0), said),
        boost::asio::bind_cancellation_slot(give_up.slot(), [](const std::exception_ptr&) {}));
    bench.scheduler.run_for(400ms); // 300 ms of silence, then it has asked
    ASSERT_EQ(request_number, 1);
    give_up.emit(boost::asio::cancellation_type::terminal);
    bench.scheduler.run_for(1ms);
    EXPECT_FALSE(said);
    EXPECT_EQ(bench.read(one_register(1, 16))->words[0], 2);
}

TEST(ModbusBus, ALineThatIsNeverSilentGivesNoValue) {
    Bench bench{serial_line()};
    for (int i = 0; i < 2000; ++i)
        bench.wire.send(bench.scheduler.now() + i * 2ms, answer_of(1, 456));
    bench.wire.slave = [](const Bytes&, MonotonicTime) { ADD_FAILURE() << "it asked"; };
    const auto said = bench.read(one_register(1, 0), 1s);
    ASSERT_FALSE(said);
    EXPECT_EQ(said.error().fault, Fault::bad_frame);
    EXPECT_NE(said.error().detail.find("another master"), std::string::npos);
}

TEST(ModbusBus, AGatewaysExceptionIsTheSilenceOfItsUnitAlone) {
    Bench bench{connection()};
    bench.wire.slave = [&](const Bytes& request, MonotonicTime at) {
        const bool dead = request[6] == 2;
        const Bytes answer = dead ? Bytes{request[0], request[1], 0, 0, 0, 3, 2, 0x84, 0x0B}
                                  : Bytes{request[0], request[1], 0, 0, 0, 5, 1, 4, 2, 0, 0xE7};
        bench.wire.send(at + 10ms, answer);
    };
    for (int round = 0; round < 20; ++round) {
        EXPECT_EQ(bench.read(one_register(2, 0)).error().fault, Fault::link_timeout);
        EXPECT_EQ(bench.read(one_register(1, 0))->words[0], 231);
    }
    EXPECT_EQ(bench.wire.openings, 1);
}

TEST(ModbusBus, ALineOnWhichAllAreSilentIsOpenedAnew) {
    Bench bench{serial_line()};
    bench.wire.slave = [&](const Bytes& request, MonotonicTime at) {
        if (request[0] == 1) bench.wire.send(at + 20ms, answer_of(1, 231));
    };
    for (int round = 0; round < 5; ++round)
        for (const int unit : {1, 2})
            (void)bench.read(one_register(unit, 0));
    EXPECT_EQ(bench.wire.openings, 1); // one is dead, the other one alive
    bench.wire.slave = [](const Bytes&, MonotonicTime) {};
    for (const int unit : {1, 2, 1})
        EXPECT_FALSE(bench.read(one_register(unit, 0)));
    EXPECT_EQ(bench.wire.openings, 2);
}

/// Answers with the number of the request; by chance late, damaged, twice, with an exception, after
/// a foreign answer or not at all.
class CapriciousSlaves {
public:
    CapriciousSlaves(Wire& wire, bool serial, unsigned seed)
        : wire_{wire}
        , serial_{serial}
        , chance_{seed} {}
    void hear(const Bytes& request, MonotonicTime at) {
        ++number;
        const std::size_t unit_at = serial_ ? 0 : 6;
        const std::uint8_t unit = request[unit_at];
        const std::uint8_t other = unit == 1 ? 2 : 1;
        const int fate = dice(100);
        const MonotonicTime soon = at + dice(250) * 1ms, late = at + (300 + dice(1650)) * 1ms;
        if (fate < 8) return;
        if (fate < 16) return wire_.send(late, framed(request, unit, word()));
        if (fate < 20) return wire_.send(soon, framed(request, unit, {0x84, 1}));
        if (fate < 24) return wire_.send(soon, bit_turned(framed(request, unit, word())));
        if (fate < 28) wire_.send(soon, framed(request, other, {4, 2, 0xAA, 0xAA}));
        if (fate < 30) wire_.send(soon, framed(request, unit, word()));
        if (fate < 32) return wire_.send(soon, framed(request, unit, {0x84, 0x0B}));
        wire_.send(soon, framed(request, unit, word()));
    }
    [[nodiscard]] std::uint16_t last() const { return static_cast<std::uint16_t>(number); }

    int number = 0;

private:
    int dice(int sides) { return static_cast<int>(chance_() % static_cast<unsigned>(sides)); }
    [[nodiscard]] Bytes word() const {
        return {4, 2, static_cast<std::uint8_t>(number >> 8), static_cast<std::uint8_t>(number)};
    }
    [[nodiscard]] Bytes framed(const Bytes& request, std::uint8_t unit, const Bytes& pdu) const {
        Bytes frame;
        if (!serial_)
            frame = {request[0], request[1], 0, 0, 0, static_cast<std::uint8_t>(pdu.size() + 1)};
        frame.push_back(unit);
        frame.insert(frame.end(), pdu.begin(), pdu.end());
        return serial_ ? with_checksum(frame) : frame;
    }
    /// TCP has its own checksum: there a damaged answer is a lost one.
    Bytes bit_turned(Bytes frame) {
        if (!serial_) return {};
        frame[chance_() % frame.size()] ^= static_cast<std::uint8_t>(1U << chance_() % 8);
        return frame;
    }

    Wire& wire_;
    bool serial_;
    std::mt19937 chance_;
};

struct Tally {
    int right = 0, wrong = 0, none = 0;
};

/// One instrument among three on the line.
Task<void> poll(Bench& bench, CapriciousSlaves& slaves, int unit, int times, Tally& tally) {
    for (int i = 0; i < times; ++i) {
        const auto said = co_await bench.bus.read(one_register(unit, i % 2));
        if (!said)
            ++tally.none;
        else if (said->words == std::vector{slaves.last()})
            ++tally.right;
        else
            ++tally.wrong;
    }
}

class AnyWire : public ::testing::TestWithParam<bool> {};

TEST_P(AnyWire, GivesOfAHundredThousandRequestsNoWrongValue) {
    const bool serial = GetParam();
    Bench bench{serial ? serial_line() : connection()};
    CapriciousSlaves slaves{bench.wire, serial,
                            static_cast<unsigned>(testing::asked_seed().value_or(5))};
    bench.wire.slave = [&](const Bytes& request, MonotonicTime at) { slaves.hear(request, at); };
    constexpr int each = 33'400;
    Tally tally;
    for (const int unit : {1, 2, 3})
        spawn(bench.scheduler, poll(bench, slaves, unit, each, tally));
    bench.scheduler.run_for(24h * 7);
    EXPECT_EQ(tally.right + tally.wrong + tally.none, 3 * each);
    EXPECT_EQ(tally.wrong, 0);
    EXPECT_GT(tally.right, 2 * each); // and two in three are answered
}

INSTANTIATE_TEST_SUITE_P(Modbus, AnyWire, ::testing::Bool(), [](const auto& which) {
    return which.param ? "Rtu" : "Tcp";
});

} // namespace
} // namespace axiscal::modbus_bus_test
