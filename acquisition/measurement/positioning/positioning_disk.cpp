// The disk failed under the run, and takes records again: the file is opened, verified and synced
// anew, as a new daemon would find it.
#include "acquisition/journal/journal.hpp"
#include "acquisition/measurement/positioning/positioning_measurement.hpp"
#include "acquisition/measurement/run_file_closer.hpp"
#include "acquisition/run/resume.hpp"
#include "acquisition/runfile/run_file.hpp"

#include <iterator>
#include <utility>

namespace axiscal {
namespace {

int points_asked(const RunRevisions& orders) {
    std::size_t points = 0;
    for (const RetakeRecord& retake : orders.retakes)
        points += retake.points.size();
    return static_cast<int>(points);
}

} // namespace

/// The first thing written is how long nothing was.
Task<Result<void>> PositioningMeasurement::on_disk_back(MonotonicTime since) {
    if (written_) co_return co_await look_for_lost_order();
    co_await context_.journal.let_go();
    const auto opened = co_await context_.journal.reopen(run_.path);
    if (!opened && !is_open() && opened.error().fault == Fault::refused)
        co_return co_await finish_after_disk();
    if (!opened) co_return tl::unexpected<Error>(opened.error());
    auto contents = co_await context_.files.written_again(run_.path, since);
    if (!contents) co_return tl::unexpected<Error>(contents.error());
    DiskBack back = disk_back(*std::move(contents));
    if (is_open()) co_return co_await go_on_after_disk(std::move(back));
    feed(std::move(back));
    co_return co_await close_after_disk();
}

/// What the file holds of an order that was lost holds: the next daemon would find it there.
DiskBack PositioningMeasurement::disk_back(RunFileContents contents) {
    DiskBack back;
    if (std::exchange(revision_unknown_, false)) {
        const RunView view = machine_.view();
        const bool asked = points_asked(contents.revisions) > view.retakes_asked;
        const bool out = std::ssize(contents.revisions.exclusions) > view.excluded;
        const std::size_t answers = contents.revisions.answers.size();
        const bool answered = answers > std::exchange(answers_, answers);
        note(asked || out || answered
                 ? "The order that could not be written is in the run file all the same, "
                   "and holds."
                 : "The run file can be written again, and nothing of the order is in it: "
                   "give it anew.");
        back.reopened = asked && written_ && !contents.closed;
    }
    back.on_disk = std::make_shared<const RunRecord>(std::move(contents.run));
    back.orders = std::make_shared<const RunRevisions>(std::move(contents.revisions));
    back.at = context_.scheduler.now();
    return back;
}

Task<Result<void>> PositioningMeasurement::go_on_after_disk(DiskBack back) {
    if (last_durable_request(*back.on_disk).sequence != 0) {
        const auto published = co_await publish_last_done(*back.on_disk);
        if (!published) co_return published;
    }
    refusal_.reset();
    feed(std::move(back));
    co_return Result<void>{};
}

/// For a run that was closed long ago: an order that should have opened its file was lost. The file
/// that cannot be read is not waited for: the next run has one of its own.
Task<Result<void>> PositioningMeasurement::look_for_lost_order() {
    co_await context_.journal.let_go();
    const std::optional<Error> trouble = co_await context_.files.trouble_in(runs_folder());
    if (trouble) co_return tl::unexpected<Error>(*trouble);
    auto contents = co_await context_.journal.contents(run_.path);
    if (!contents) {
        note("What the run file holds of the order is not known: " + describe(contents.error()));
        co_return Result<void>{};
    }
    if (!contents->closed) co_return co_await take_up_order(*std::move(contents));
    const auto tidied = co_await context_.journal.tidy(runs_folder());
    if (!tidied && tidied.error().fault != Fault::busy) co_return tidied;
    feed(disk_back(*std::move(contents)));
    co_return Result<void>{};
}

/// Points to be taken open the run again; readings that were left out only its file.
Task<Result<void>> PositioningMeasurement::take_up_order(RunFileContents contents) {
    if (auto opened = co_await context_.journal.reopen(run_.path); !opened) co_return opened;
    DiskBack back = disk_back(std::move(contents));
    const bool reopened = back.reopened;
    if (reopened) run_is_open_again();
    feed(std::move(back));
    if (!reopened) co_return co_await close_again();
    co_await show_last_number();
    co_return Result<void>{};
}

/// The run ended while nothing could be written: its closing row is due.
Task<Result<void>> PositioningMeasurement::close_after_disk() {
    const auto closed = co_await context_.files.close(run_.complete, run_.reason);
    if (!closed) co_return closed;
    co_return co_await finish_after_disk();
}

/// The closing row is there; what may be left is to fold the file and to report.
Task<Result<void>> PositioningMeasurement::finish_after_disk() {
    const auto tidied = co_await context_.journal.tidy(runs_folder());
    if (!tidied) co_return tidied;
    written_ = true;
    run_.closing_error.reset();
    if (run_.complete) co_await certify();
    co_return Result<void>{};
}

} // namespace axiscal
