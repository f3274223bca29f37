// What the station's lines are about, as the daemon's log gets it.
#include "drivers/loop/log_line.hpp"
#include "tests/unit/station/station_bench.hpp"

#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <mutex>
#include <vector>

namespace axiscal::testing::station_log_test {
namespace {

class Log {
public:
    Log()
        : before_{spdlog::default_logger()} {
        spdlog::set_default_logger(std::make_shared<spdlog::logger>("station", sink_));
    }
    ~Log() { spdlog::set_default_logger(before_); }
    Log(const Log&) = delete;
    Log& operator=(const Log&) = delete;
    [[nodiscard]] const std::vector<LogLine>& lines() const { return sink_->lines; }
    /// The last one with these words; an empty one where there is none.
    [[nodiscard]] LogLine with(const std::string& words) const {
        LogLine found;
        for (const LogLine& line : lines())
            if (line.text.find(words) != std::string::npos) found = line;
        return found;
    }

private:
    struct Sink final : spdlog::sinks::base_sink<std::mutex> {
        void sink_it_(const spdlog::details::log_msg& message) override {
            lines.push_back({std::string{message.payload.data(), message.payload.size()}, 6,
                             LogAbout::of_this_thread()});
        }
        void flush_() override {}
        std::vector<LogLine> lines;
    };
    std::shared_ptr<Sink> sink_ = std::make_shared<Sink>();
    std::shared_ptr<spdlog::logger> before_;
};

TEST(StationLog, NamesARunFromItsArmingToItsClosing) {
    const Log log;
    Shop shop;
    shop.shorten();
    Life life{shop};
    for (const LogLine& line : log.lines())
        EXPECT_EQ(line.facts.run, "") << line.text;
    const auto run_id = life.arm();
    ASSERT_TRUE(run_id) << describe(run_id.error());
    EXPECT_EQ(log.with("was armed by").facts.run, *run_id);
    ASSERT_TRUE(life.abort("enough"));
    EXPECT_EQ(log.with("was aborted by").facts.run, *run_id);
    EXPECT_EQ(log.with("is closed as incomplete").facts.run, *run_id);
}

TEST(StationLog, NamesTheInstrumentOfItsLine) {
    const Log log;
    Shop shop;
    const Life life{shop};
    const LogLine line = log.with(" is available.");
    ASSERT_NE(line.text, "");
    EXPECT_EQ(line.facts.instrument + " is available.", line.text);
    EXPECT_EQ(line.facts.fault, Fault::none);
}

} // namespace
} // namespace axiscal::testing::station_log_test
