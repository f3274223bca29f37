#include "acquisition/measurement/disk_wait.hpp"

#include "acquisition/capture/wording.hpp"
#include "acquisition/journal/journal.hpp"
#include "acquisition/live/notices.hpp"
#include "acquisition/measurement/latest_tests.hpp"
#include "acquisition/measurement/recovery.hpp"
#include "acquisition/measurement/run_file_closer.hpp"
#include "acquisition/runfile/durable_file.hpp"
#include "drivers/loop/spawn.hpp"

#include <memory>
#include <optional>
#include <utility>

namespace axiscal {
namespace {

constexpr Duration try_disk_every = std::chrono::seconds{1};
constexpr const char* not_taken_over = "What the last daemon left cannot be taken over yet: ";

} // namespace

DiskWait::DiskWait(const MeasurementContext& context, LatestTests& tests)
    : context_(context)
    , tests_{tests} {}

std::string DiskWait::text_of(const Error& error) const {
    return disk_text(error, context_.config.state_directory);
}

/// disk_text() ends with the way out, where one is known.
DiskTrouble DiskWait::trouble_of(const std::string& sentence, const Error& error) const {
    DiskTrouble trouble{sentence + text_of(error),
                        way_out(error.cause, context_.config.state_directory)};
    if (!trouble.next.empty() && trouble.seen.ends_with(" " + trouble.next))
        trouble.seen.resize(trouble.seen.size() - trouble.next.size() - 1);
    return trouble;
}

void DiskWait::begin() {
    if (!std::exchange(waiting_, true)) spawn(context_.scheduler, wait());
}

/// The next test may take the place of the one that is tried, which is held meanwhile.
Task<void> DiskWait::wait() {
    const MonotonicTime since = context_.scheduler.now();
    trouble_ = {std::string{fault_sentence(Fault::not_durable)}, ""};
    if (const auto why = context_.journal.failure()) {
        const std::string sentence = std::string{fault_sentence(why->fault)} + " ";
        context_.notices.note(sentence + text_of(*why), {why->fault});
        trouble_ = trouble_of(sentence, *why);
    }
    while (!context_.stopping) {
        co_await context_.scheduler.sleep_for(try_disk_every);
        if (tests_.is_being_closed()) continue; // its own attempt to close is under way
        const std::shared_ptr<Measurement> test = tests_.run();
        if (co_await test->on_disk_back(since)) break;
    }
    waiting_ = false;
}

std::string DiskWait::begin_to_take_over(const Error& why) {
    waiting_ = true;
    std::string text = text_of(why);
    trouble_ = trouble_of(not_taken_over, why);
    context_.notices.note(
        not_taken_over + text +
            " The station tries again by itself; until then the trigger port stays shut.",
        {why.fault});
    return text;
}

Task<bool> DiskWait::until_taken_over(Recovery& recovery, std::string told) {
    const MonotonicTime since = context_.scheduler.now();
    while (!context_.stopping) {
        co_await context_.scheduler.sleep_for(try_disk_every);
        const std::string runs_folder = context_.config.state_directory + "/runs";
        const std::optional<Error> trouble = co_await context_.files.trouble_in(runs_folder);
        if (trouble || context_.stopping) continue;
        co_await context_.journal.let_go();
        const Result<void> taken = co_await recovery.take_over_stored_runs();
        if (!taken) {
            std::string why = text_of(taken.error());
            trouble_ = trouble_of(not_taken_over, taken.error());
            if (why != told) context_.notices.note(not_taken_over + why, {taken.error().fault});
            told = std::move(why);
            continue;
        }
        waiting_ = false;
        context_.notices.note("The disk takes records again after " +
                              in_seconds(context_.scheduler.now() - since) + ".");
        co_return true;
    }
    co_return false;
}

} // namespace axiscal
