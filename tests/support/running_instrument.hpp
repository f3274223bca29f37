#pragma once
// An instrument with simulated USB devices in its sockets, run as a supervisor runs it. Tests only.

#include "tests/support/made_instrument.hpp"
#include "tests/support/model_plug.hpp"
#include "tests/support/sample_recorder.hpp"

#include <boost/asio/co_spawn.hpp>

namespace axiscal::testing {

/// Opened again a quarter of a second after its end. Must live as long as the scheduler runs.
class RunningInstrument {
public:
    RunningInstrument(VirtualScheduler& scheduler,
                      const std::string& driver,
                      const std::string& keys)
        : sink{scheduler.now()}
        , plug{scheduler}
        , instrument{testing::instrument(driver, keys)}
        , scheduler_{scheduler} {
        sink.name_channels(instrument->channels());
    }
    void start() {
        boost::asio::co_spawn(scheduler_.loop(), keep_running(),
                              [](const std::exception_ptr& bug) { EXPECT_FALSE(bug); });
    }
    [[nodiscard]] std::optional<double> last(int channel) const {
        for (auto sample = sink.samples.rbegin(); sample != sink.samples.rend(); ++sample)
            if (sample->channel == channel) return sample->value();
        return std::nullopt;
    }
    [[nodiscard]] const InstrumentCounters& counters() const { return instrument->counters(); }

    SampleRecorder sink;
    ModelPlug plug;
    std::unique_ptr<Instrument> instrument;
    std::vector<Fault> ends;

private:
    Task<void> keep_running() {
        for (;;) {
            const InstrumentContext context{&scheduler_, &plug, &sink};
            const auto ended = co_await instrument->run(context);
            ends.push_back(ended.error().fault);
            co_await scheduler_.sleep_for(std::chrono::milliseconds{250});
        }
    }
    VirtualScheduler& scheduler_;
};

} // namespace axiscal::testing
