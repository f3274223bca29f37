#include "acquisition/journal/journal_clock.hpp"

namespace axiscal {
namespace {

class SteadyClock final : public JournalClock {
public:
    [[nodiscard]] Time now() const override { return std::chrono::steady_clock::now(); }
    void sleep(const Sleeper& sleeper,
               std::optional<Time> until,
               const std::function<bool()>& ready) override {
        if (until)
            sleeper.wake.wait_until(sleeper.lock, sleeper.stop, *until, ready);
        else
            sleeper.wake.wait(sleeper.lock, sleeper.stop, ready);
    }
};

} // namespace

JournalClock& JournalClock::steady() {
    static SteadyClock clock;
    return clock;
}

} // namespace axiscal
