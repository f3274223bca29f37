// The disk fails under an open run: nothing is acknowledged, and the station waits for the disk as
// a new daemon would find it.
#include "acquisition/station/station.hpp"

#include "acquisition/capture/wording.hpp"

#include <utility>

namespace axiscal {
namespace {

constexpr Duration try_every = std::chrono::seconds{1};

} // namespace

Task<void> Station::wait_for_disk() {
    const MonotonicTime since = scheduler_.now();
    if (const auto why = journal_.failure())
        note(std::string{fault_sentence(why->fault)} + " " + disk_text(*why));
    while (!stopping_) {
        co_await scheduler_.sleep_for(try_every);
        if (is_being_closed()) continue; // its own attempt to close is under way
        if (co_await try_disk(since)) break;
    }
    waiting_for_disk_ = false;
}

/// One attempt. The next test may take the place of this one meanwhile.
Task<Result<void>> Station::try_disk(MonotonicTime since) {
    if (circles_) {
        const auto test = circles_;
        co_return co_await test->on_disk_back(since);
    }
    const auto test = positioning_;
    co_return co_await test->on_disk_back(since);
}

/// `message`: what was said of it. The same is not said again, however long it lasts.
Task<void> Station::take_over_when_disk_is_back(std::string message) {
    const MonotonicTime since = scheduler_.now();
    while (!stopping_) {
        co_await scheduler_.sleep_for(try_every);
        const std::optional<Error> trouble = co_await files_.trouble_in(runs_folder());
        if (trouble || stopping_) continue;
        co_await journal_.let_go();
        const Result<void> taken = co_await take_over_stored_runs();
        if (!taken) {
            std::string why = disk_text(taken.error());
            if (why != message) note("What the last daemon left cannot be taken over yet: " + why);
            message = std::move(why);
            continue;
        }
        waiting_for_disk_ = false;
        note("The disk takes records again after " + in_seconds(scheduler_.now() - since) + ".");
        open_port();
        co_return;
    }
}

} // namespace axiscal
