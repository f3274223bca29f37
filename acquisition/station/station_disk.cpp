// The disk fails under an open run: nothing is acknowledged, and the station waits for the disk as
// a new daemon would find it: the file is opened, verified and synced anew.
#include "acquisition/capture/wording.hpp"
#include "acquisition/run/resume.hpp"
#include "acquisition/station/station.hpp"

#include <utility>

namespace axiscal {
namespace {

constexpr Duration try_every = std::chrono::seconds{1};

int points_asked(const RunRevisions& orders) {
    std::size_t points = 0;
    for (const RetakeRecord& retake : orders.retakes)
        points += retake.points.size();
    return static_cast<int>(points);
}

} // namespace

Task<void> Station::wait_for_disk() {
    const MonotonicTime since = scheduler_.now();
    const std::string path = run_ ? run_->path : std::string{};
    if (const auto why = journal_.failure())
        note(std::string{fault_sentence(why->fault)} + " " + disk_text(*why));
    while (!stopping_) {
        co_await scheduler_.sleep_for(try_every);
        if (is_being_closed()) continue; // its own attempt to close is under way
        if (co_await try_disk(path, since)) break;
    }
    waiting_for_disk_ = false;
}

/// At a start nobody waits for a reader: wait_for_readers() does what is left.
Task<Result<void>> Station::close_file_for_now(bool complete, std::string reason) {
    Result<void> closed = co_await journal_.close(complete, std::move(reason));
    if (closed || closed.error().fault != Fault::busy) co_return closed;
    note("The run is closed and safe. " + closed.error().detail + ".");
    co_await journal_.let_go();
    co_return Result<void>{};
}

/// A closed run has its certificate once it is one file: its bytes are what the certificate names.
Task<void> Station::wait_for_readers() {
    while (!stopping_) {
        const auto tidied = co_await journal_.tidy(config_.state_directory + "/runs");
        if (tidied || tidied.error().fault != Fault::busy) co_return;
        co_await scheduler_.sleep_for(try_every);
    }
}

Task<std::optional<Error>> Station::disk_trouble() {
    const Result<void> tried = co_await journal_.try_folder(config_.state_directory + "/runs");
    std::optional<Error> trouble;
    if (!tried) trouble = Error{Fault::not_durable, tried.error().detail, tried.error().cause, {}};
    co_return trouble;
}

/// `told`: what was said of it. The same is not said again, however long it lasts.
Task<void> Station::take_over_when_disk_is_back(std::string message) {
    const MonotonicTime since = scheduler_.now();
    while (!stopping_) {
        co_await scheduler_.sleep_for(try_every);
        const std::optional<Error> trouble = co_await disk_trouble();
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

/// One attempt. The first thing written is how long nothing was.
Task<Result<void>> Station::try_disk(std::string path, MonotonicTime since) {
    if (circles_) {
        const auto test = circles_; // the next one may take its place meanwhile
        co_return co_await test->on_disk_back(since);
    }
    if (run_->closing_row_durable) co_return co_await look_for_lost_order(std::move(path));
    co_await journal_.let_go();
    const auto opened = co_await journal_.reopen(path);
    if (!opened && run_->closed && opened.error().fault == Fault::refused)
        co_return co_await finish_after_disk();
    if (!opened) co_return tl::unexpected<Error>(opened.error());
    auto contents = co_await files_.written_again(std::move(path), since);
    if (!contents) co_return tl::unexpected<Error>(contents.error());
    DiskBack back = disk_back(*std::move(contents));
    if (!run_->closed) co_return co_await go_on_after_disk(std::move(back));
    feed(std::move(back));
    co_return co_await close_after_disk();
}

/// What the file holds of an order that was lost holds: the next daemon would find it there.
DiskBack Station::disk_back(RunFileContents contents) {
    DiskBack back;
    if (std::exchange(revision_unknown_, false) && machine_) {
        const RunView view = machine_->view();
        const bool asked = points_asked(contents.revisions) > view.retakes_asked;
        const bool out = std::ssize(contents.revisions.exclusions) > view.excluded;
        const std::size_t answers = contents.revisions.answers.size();
        const bool answered = answers > std::exchange(run_->answers, answers);
        note(asked || out || answered
                 ? "The order that could not be written is in the run file all the same, "
                   "and holds."
                 : "The run file can be written again, and nothing of the order is in it: "
                   "give it anew.");
        back.reopened = asked && run_->closing_row_durable && !contents.closed;
    }
    back.on_disk = std::make_shared<const RunRecord>(std::move(contents.run));
    back.orders = std::make_shared<const RunRevisions>(std::move(contents.revisions));
    back.at = scheduler_.now();
    return back;
}

Task<Result<void>> Station::go_on_after_disk(DiskBack back) {
    if (last_durable_request(*back.on_disk).sequence != 0) {
        const auto published = co_await publish_last_done(*back.on_disk);
        if (!published) co_return published;
    }
    run_->refusal.reset();
    feed(std::move(back));
    co_return Result<void>{};
}

/// For a run that was closed long ago: an order that should have opened its file was lost. The file
/// that cannot be read is not waited for: the next run has one of its own.
Task<Result<void>> Station::look_for_lost_order(std::string path) {
    co_await journal_.let_go();
    const std::optional<Error> trouble = co_await disk_trouble();
    if (trouble) co_return tl::unexpected<Error>(*trouble);
    auto contents = co_await journal_.contents(path);
    if (!contents) {
        note("What the run file holds of the order is not known: " + describe(contents.error()));
        co_return Result<void>{};
    }
    if (!contents->closed) co_return co_await take_up_order(std::move(path), *std::move(contents));
    const auto tidied = co_await journal_.tidy(runs_folder());
    if (!tidied && tidied.error().fault != Fault::busy) co_return tidied;
    feed(disk_back(*std::move(contents)));
    co_return Result<void>{};
}

/// Points to be taken open the run again; readings that were left out only its file.
Task<Result<void>> Station::take_up_order(std::string path, RunFileContents contents) {
    if (auto opened = co_await journal_.reopen(path); !opened) co_return opened;
    DiskBack back = disk_back(std::move(contents));
    const bool reopened = back.reopened;
    if (reopened) run_is_open_again();
    feed(std::move(back));
    if (reopened) {
        co_await show_last_number();
        co_return Result<void>{};
    }
    if (run_->taken_over) mark_another_boot(run_->header.boot_id);
    co_return co_await close_again();
}

/// The run ended while nothing could be written: its closing row is due.
Task<Result<void>> Station::close_after_disk() {
    const Close wanted =
        run_->outcome.value_or(Close{false, "The disk failed.", Fault::not_durable});
    const auto closed = co_await files_.close(wanted.complete, wanted.reason);
    if (!closed) co_return closed;
    co_return co_await finish_after_disk();
}

/// The closing row is there; what may be left is to fold the file and to report.
Task<Result<void>> Station::finish_after_disk() {
    const auto tidied = co_await journal_.tidy(config_.state_directory + "/runs");
    if (!tidied) co_return tidied;
    run_->closing_row_durable = true;
    run_->closing_error.reset();
    if (run_->outcome && run_->outcome->complete) co_await certify(run_->header.run_id, run_->path);
    co_return Result<void>{};
}

} // namespace axiscal
