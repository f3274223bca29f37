#include "acquisition/journal/journal.hpp"

#include "acquisition/journal/journal_worker.hpp"
#include "acquisition/runfile/complete_runs.hpp"
#include "acquisition/runfile/durable_file.hpp"
#include "acquisition/runfile/run_store.hpp"
#include "acquisition/runfile/stored_drift.hpp"

namespace axiscal {

Journal::Journal(Scheduler& scheduler, JournalThread thread, JournalClock& clock)
    : scheduler_{scheduler}
    , worker_{std::make_unique<Worker>(scheduler.executor(), thread, clock)} {}
Journal::~Journal() = default;

void Journal::sign_with(std::shared_ptr<const SecretKey> key) {
    worker_->key = std::move(key);
}

Task<Result<void>> Journal::open(std::string path, RunRecord header) {
    return open(std::move(path), std::move(header), RunAttachments{});
}

Task<Result<void>> Journal::open(std::string path, RunRecord header, RunAttachments attachments) {
    Worker* worker = worker_.get();
    auto shared = std::make_shared<const RunRecord>(std::move(header));
    auto beside = std::make_shared<const RunAttachments>(std::move(attachments));
    std::function<Result<void>()> work = [worker, path, shared, beside]() -> Result<void> {
        AXISCAL_CHECK(worker->may_open());
        return worker->take(RunFileWriter::create(path, *shared, *beside));
    };
    co_return co_await perform<Worker, void>(worker, std::move(work));
}

Task<Result<void>> Journal::reopen(std::string path) {
    Worker* worker = worker_.get();
    std::function<Result<void>()> work = [worker, path]() -> Result<void> {
        AXISCAL_CHECK(worker->may_open());
        return worker->take(RunFileWriter::reopen(path));
    };
    co_return co_await perform<Worker, void>(worker, std::move(work));
}

Task<Result<void>> Journal::reopen_closed(std::string path,
                                          std::optional<RetakeRecord> retake,
                                          std::vector<ExclusionRecord> exclusions,
                                          std::vector<OrderRecord> orders) {
    auto first = std::make_shared<RunBatch>();
    if (retake) first->retakes.push_back(*std::move(retake));
    first->exclusions = std::move(exclusions);
    first->orders = std::move(orders);
    co_return co_await reopen_closed(std::move(path), std::move(first));
}

Task<Result<void>>
Journal::reopen_closed(std::string path, AnswerRecord answer, OrderRecord order) {
    auto first = std::make_shared<RunBatch>();
    first->answers.push_back(std::move(answer));
    first->orders.push_back(std::move(order));
    co_return co_await reopen_closed(std::move(path), std::move(first));
}

Task<Result<void>> Journal::reopen_closed(std::string path, std::shared_ptr<RunBatch> first) {
    Worker* worker = worker_.get();
    std::function<Result<void>()> work = [worker, path, first]() -> Result<void> {
        AXISCAL_CHECK(worker->may_open());
        return worker->take(RunFileWriter::reopen_closed(path, *first));
    };
    co_return co_await perform<Worker, void>(worker, std::move(work));
}

Task<Result<JournalReceipt>> Journal::commit(RunBatch batch, std::uint16_t sequence, int step) {
    Worker* worker = worker_.get();
    auto shared = std::make_shared<RunBatch>(std::move(batch));
    std::function<Result<void>()> work = [worker, shared] {
        return worker->write_with_notes(std::move(*shared)); // called once
    };
    const auto written = co_await perform<Worker, void>(worker, std::move(work));
    if (!written) co_return tl::unexpected<Error>(written.error());
    co_return JournalReceipt{sequence, step};
}

Task<Result<JournalReceipt>> Journal::commit(PointRecord point,
                                             std::optional<Synchronisation> synchronisation) {
    const auto sequence = point.sequence;
    const int step = point.step;
    RunBatch batch;
    batch.point = std::move(point);
    batch.synchronisation = synchronisation;
    co_return co_await commit(std::move(batch), sequence, step);
}

Task<Result<JournalReceipt>> Journal::commit(DatumRecord datum,
                                             std::optional<Synchronisation> synchronisation) {
    const auto sequence = datum.sequence;
    RunBatch batch;
    batch.datum = std::move(datum);
    batch.synchronisation = synchronisation;
    co_return co_await commit(std::move(batch), sequence, -1);
}

Task<Result<JournalReceipt>> Journal::commit(EventRecord event, int step) {
    const auto sequence = event.sequence;
    RunBatch batch;
    batch.events.push_back(std::move(event));
    co_return co_await commit(std::move(batch), sequence, step);
}

Task<Result<JournalReceipt>> Journal::receipt_for(int step) {
    const Lookup lookup = [](const RunFileWriter& writer, int key) {
        return key < 0 ? writer.sequence_of_last_datum() : writer.sequence_of_point(key);
    };
    co_return co_await receipt_by(lookup, step, step);
}

Task<Result<JournalReceipt>> Journal::receipt_for_skip(std::uint16_t sequence, int step) {
    const Lookup lookup = [](const RunFileWriter& writer, int key) {
        return writer.sequence_of_skip(static_cast<std::uint16_t>(key));
    };
    co_return co_await receipt_by(lookup, sequence, step);
}

Task<Result<JournalReceipt>> Journal::receipt_for_circle(std::uint16_t sequence) {
    const Lookup lookup = [](const RunFileWriter& writer, int key) {
        return writer.sequence_of_circle(static_cast<std::uint16_t>(key));
    };
    co_return co_await receipt_by(lookup, sequence, sequence - 1);
}

Task<Result<JournalReceipt>> Journal::receipt_by(Lookup lookup, int key, int step) {
    Worker* worker = worker_.get();
    std::function<Result<std::uint16_t>()> work = [worker, lookup, key,
                                                   step]() -> Result<std::uint16_t> {
        if (!worker->writer) return fail(Fault::no_run_armed, "no run file is open");
        AXISCAL_TRY(const auto sequence, lookup(*worker->writer, key));
        if (!sequence)
            return fail(Fault::not_found,
                        worker->writer->path() + " holds no point of step " + std::to_string(step));
        return *sequence;
    };
    const auto sequence = co_await perform<Worker, std::uint16_t>(worker, std::move(work));
    if (!sequence) co_return tl::unexpected<Error>(sequence.error());
    co_return JournalReceipt{*sequence, step};
}

Task<Result<JournalReceipt>> Journal::receipt_of_closed(std::string path) {
    Worker* worker = worker_.get();
    std::function<Result<LastRequest>()> work = [path]() -> Result<LastRequest> {
        AXISCAL_TRY(const auto last, last_request_of_closed(path));
        if (!last) return fail(Fault::not_found, path + " holds nothing that a CNC asked for");
        return *last;
    };
    const auto last = co_await perform<Worker, LastRequest>(worker, std::move(work));
    if (!last) co_return tl::unexpected<Error>(last.error());
    co_return JournalReceipt{last->sequence, last->step};
}

Task<Result<StoredRuns>> Journal::stored_runs(std::string folder, BootId boot_id) {
    const PresentBoot present{std::move(boot_id), scheduler_.clock_tie()};
    std::function<Result<StoredRuns>()> work = [folder, present] {
        return look_through_runs(folder, present);
    };
    co_return co_await perform<Worker, StoredRuns>(worker_.get(), std::move(work));
}

Task<Result<RunSummary>> Journal::summarize(std::string path) {
    std::function<Result<RunSummary>()> work = [path] { return summarize_run_file(path); };
    co_return co_await perform<Worker, RunSummary>(worker_.get(), std::move(work));
}

Task<Result<StoredResult>> Journal::stored_result(std::string path) {
    std::function<Result<StoredResult>()> work = [path] { return read_stored_result(path); };
    co_return co_await perform<Worker, StoredResult>(worker_.get(), std::move(work));
}

Task<Result<StoredDrift>> Journal::find_drift(std::string folder, WantedDrift wanted) {
    std::function<Result<StoredDrift>()> work = [folder, wanted] {
        return axiscal::find_drift(folder, wanted);
    };
    co_return co_await perform<Worker, StoredDrift>(worker_.get(), std::move(work));
}

Task<Result<RunFileContents>> Journal::find_complete_run(std::string folder, WantedRun wanted) {
    std::function<Result<RunFileContents>()> work = [folder, wanted] {
        return axiscal::find_complete_run(folder, wanted);
    };
    co_return co_await perform<Worker, RunFileContents>(worker_.get(), std::move(work));
}

void Journal::note(EventRecord event) {
    std::vector<EventRecord> one_event;
    one_event.push_back(std::move(event));
    worker_->queue_note(worker_->noted.events, std::move(one_event));
}

void Journal::note(std::vector<EnvironmentReading> readings) {
    worker_->queue_note(worker_->noted.environment, std::move(readings));
}

void Journal::note(CircularSetup setup, std::vector<StreamSetup> streams) {
    worker_->queue_with([&](RunBatch& noted) {
        noted.circular = std::move(setup);
        noted.streams = std::move(streams);
        return true;
    });
}

bool Journal::note(StreamChunk chunk) {
    return worker_->queue_with([&](RunBatch& noted) {
        if (noted.chunks.size() >= most_chunks) return false;
        noted.chunks.push_back(std::move(chunk));
        return true;
    });
}

void Journal::note(std::vector<PreflightRecord> checks) {
    worker_->queue_note(worker_->noted.preflight, std::move(checks));
}

void Journal::note(RetakeRecord retake) {
    std::vector<RetakeRecord> one_retake;
    one_retake.push_back(std::move(retake));
    worker_->queue_note(worker_->noted.retakes, std::move(one_retake));
}

void Journal::note(std::vector<ExclusionRecord> exclusions) {
    worker_->queue_note(worker_->noted.exclusions, std::move(exclusions));
}

void Journal::note(OrderRecord order) {
    std::vector<OrderRecord> one_order;
    one_order.push_back(std::move(order));
    worker_->queue_note(worker_->noted.orders, std::move(one_order));
}

Task<Result<void>> Journal::flush() {
    Worker* worker = worker_.get();
    std::function<Result<void>()> work = [worker] { return worker->save_notes(); };
    co_return co_await perform<Worker, void>(worker, std::move(work));
}

Task<void> Journal::let_go() {
    Worker* worker = worker_.get();
    std::function<Result<void>()> work = [worker]() -> Result<void> {
        worker->let_go();
        return {};
    };
    (void)co_await perform<Worker, void>(worker, std::move(work)); // cannot fail
}

Task<Result<void>> Journal::tidy(std::string folder) {
    std::function<Result<void>()> work = [folder] { return tidy_run_files(folder); };
    co_return co_await perform<Worker, void>(worker_.get(), std::move(work));
}

Task<Result<void>> Journal::try_folder(std::string folder) {
    std::function<Result<void>()> work = [folder] { return axiscal::try_folder(folder); };
    co_return co_await perform<Worker, void>(worker_.get(), std::move(work));
}

Task<Result<RunRecord>> Journal::read(std::string path) {
    std::function<Result<RunRecord>()> work = [path] { return read_run_file(path); };
    co_return co_await perform<Worker, RunRecord>(worker_.get(), std::move(work));
}

Task<Result<RunFileContents>> Journal::contents(std::string path) {
    std::function<Result<RunFileContents>()> work = [path] { return read_run_file_contents(path); };
    co_return co_await perform<Worker, RunFileContents>(worker_.get(), std::move(work));
}

Task<Result<void>> Journal::close(bool complete, std::string reason) {
    Worker* worker = worker_.get();
    const ClockTie tie = scheduler_.clock_tie();
    std::function<Result<void>()> work = [worker, complete, reason, tie] {
        return worker->close(complete, reason, tie);
    };
    co_return co_await perform<Worker, void>(worker, std::move(work));
}

std::optional<Error> Journal::failure() const {
    return worker_->known_failure();
}

} // namespace axiscal
