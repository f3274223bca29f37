// Bytes that are no text, through every driver of a wire that speaks text, up to the status.
#include "acquisition/console/api_json.hpp"
#include "acquisition/live/supervisor.hpp"
#include "tests/support/made_instrument.hpp"
#include "tests/support/virtual_scheduler.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <random>
#include <stdexcept>

namespace axiscal::noise_test {
namespace {

using namespace std::chrono_literals;

/// Noise with ends of lines in it; now and then a beginning that the driver knows.
class NoisyLink final : public ByteLink {
public:
    NoisyLink(Scheduler& scheduler, std::mt19937& dice, std::vector<std::string> known)
        : scheduler_{scheduler}
        , dice_{dice}
        , known_{std::move(known)} {}
    Task<Result<TimedBytes>> read_some(MonotonicTime deadline) override {
        const MonotonicTime next = scheduler_.now() + 20ms;
        co_await scheduler_.sleep_until(std::min(next, deadline));
        if (next > deadline) co_return fail(Fault::link_timeout, "no bytes");
        TimedBytes got;
        got.read_at = scheduler_.now();
        for (const char letter : words())
            got.bytes.push_back(static_cast<std::byte>(letter));
        co_return got;
    }
    Task<Result<void>> write_all(std::vector<std::byte> /*bytes*/, MonotonicTime) override {
        co_return Result<void>{};
    }
    [[nodiscard]] std::string remark() const override { return "a remark \xFF\x01"; }

private:
    std::string words() {
        std::string text = dice_() % 2 == 0 ? known_[dice_() % known_.size()] : std::string{};
        for (auto left = dice_() % 24; left > 0; --left)
            text += static_cast<char>(dice_() % 256);
        return text + "\xFF\xC0\r\n";
    }
    Scheduler& scheduler_;
    std::mt19937& dice_;
    std::vector<std::string> known_;
};

class NoisyOpener final : public LinkOpener {
public:
    NoisyOpener(Scheduler& scheduler, std::vector<std::string> known)
        : scheduler_{scheduler}
        , known_{std::move(known)} {}
    Task<Result<std::unique_ptr<ByteLink>>> open(const LinkSettings&, MonotonicTime) override {
        co_return std::unique_ptr<ByteLink>{std::make_unique<NoisyLink>(scheduler_, dice_, known_)};
    }

private:
    Scheduler& scheduler_;
    std::mt19937 dice_{20261121};
    std::vector<std::string> known_;
};

struct Listener final : SupervisorListener {
    void on_sample(const Sample&) override {}
    void on_instrument_state(const InstrumentView& view) override { judge(view); }
    void on_instrument_note(const InstrumentView& view) override {
        judge(view);
        ++notes;
    }
    /// The strict writer of the library throws at the first byte that is no text.
    void judge(const InstrumentView& view) {
        EXPECT_NO_THROW(words += to_json(view).dump()) << view.name;
    }
    int notes = 0;
    std::string words;
};

struct Wire {
    const char* name;
    const char* driver;
    const char* keys;
    std::vector<std::string> known; ///< how its good lines begin
};

class NoiseOnTheWireOf : public ::testing::TestWithParam<Wire> {};

TEST_P(NoiseOnTheWireOf, IsTextInTheStatus) {
    const Wire& wire = GetParam();
    VirtualScheduler scheduler;
    NoisyOpener links{scheduler, wire.known};
    Listener listener;
    Supervisor supervisor{scheduler, links, listener};
    InstrumentConfig config;
    config.name = wire.name;
    supervisor.add(config, testing::instrument(wire.driver, wire.keys));
    supervisor.start();
    for (int second = 0; second < 60; ++second) {
        scheduler.run_for(1s);
        supervisor.judge();
        listener.judge(supervisor.view().front());
    }
    EXPECT_NE(listener.words, "");
}

INSTANTIATE_TEST_SUITE_P(
    EveryTextDriver,
    NoiseOnTheWireOf,
    ::testing::Values(
        Wire{"umd",
             "umd",
             "link = \"serial:/dev/null\"\nwavelength = \"632.991354 nm\"\nfold = \"corner "
             "cube\"\nfastest = \"30 m/min\"\n",
             {"# ", "0 0 0 0 0 0 0 0 ", "uMD2 "}},
        Wire{"dracal", "dracal-vcp", "link = \"serial:/dev/null\"\n", {"I,", "D,", "P,", "E,"}},
        Wire{"ids",
             "ids3010",
             "link = \"tcp:127.0.0.1:9090\"\nfastest = \"1 m/s\"\nwavelength = \"1530 nm\"\nair = "
             "\"corrected here\"\n",
             {"{\"jsonrpc\":\"2.0\",\"id\":0,"}},
        Wire{"lasertex",
             "lasertex",
             "link = \"serial:/dev/null\"\nposition = \"compensated\"\n",
             {"\xAA\xB0\x15", "\xAA\xB0\x32"}},
        Wire{"vaisala",
             "vaisala",
             "link = \"serial:/dev/null\"\nmodel = \"ptu300\"\n",
             {"PTU300 / ", "P= 1013.2 T= 20.1 ", "Serial number : "}},
        Wire{"gauge",
             "ascii-gauge",
             "link = \"serial:/dev/null\"\nmodel = \"nd-28x\"\n",
             {"+     0.1234 ", "ERR "}},
        Wire{"temper",
             "temper-serial",
             "link = \"serial:/dev/null\"\n",
             {"Temp-Inner:", "TEMPerX232_"}}),
    [](const auto& wire) { return std::string{wire.param.name}; });

/// Speaks of itself in bytes that are no text, then meets a bug of its own.
class Careless final : public Instrument {
public:
    [[nodiscard]] const std::vector<Channel>& channels() const override { return channels_; }
    [[nodiscard]] const InstrumentCounters& counters() const override { return counters_; }
    Task<Result<void>> run(InstrumentContext context) override {
        context.sink->identify({"\xFF maker", "model\n", "se\xC0rial", std::string(1, '\0')});
        context.sink->note(Fault::bad_frame, "garbage \xFF\x1B[2J");
        co_await context.scheduler->sleep_for(1s);
        throw std::runtime_error{"index \xFE out of range"};
    }

private:
    std::vector<Channel> channels_;
    InstrumentCounters counters_;
};

TEST(CarelessDriver, SpeaksTextAndItsBugEndsItsConnectionAlone) {
    VirtualScheduler scheduler;
    NoisyOpener links{scheduler, {""}};
    Listener listener;
    Supervisor supervisor{scheduler, links, listener};
    supervisor.add({}, std::make_unique<Careless>());
    supervisor.start();
    scheduler.run_for(500ms);
    const InstrumentView before = supervisor.view().front();
    EXPECT_EQ(before.identity.maker, "\uFFFD maker");
    EXPECT_EQ(before.identity.model, "model ");
    EXPECT_EQ(before.identity.serial, "se\uFFFDrial");
    EXPECT_EQ(before.last_note, "garbage \uFFFD [2J");
    scheduler.run_for(10s);
    const InstrumentView after = supervisor.view().front();
    EXPECT_GT(after.restarts, 2U);
    EXPECT_NE(listener.words.find("index \uFFFD out of range"), std::string::npos)
        << listener.words;
}

} // namespace
} // namespace axiscal::noise_test
