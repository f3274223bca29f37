// Rows that come while a run goes on: what was captured, what was decided, how it ended.
#include "acquisition/runfile/record_readers.hpp"

#include "acquisition/runfile/record_columns.hpp"
#include "acquisition/runfile/window_packing.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace axiscal::record_readers {
namespace {

WindowSamples samples_of(RowReader& in) {
    auto samples = unpacked_window(in.blob());
    if (!samples) return in.reject("does not hold packed samples"), WindowSamples{};
    if (!std::ranges::all_of(*samples, [](const auto& s) { return std::isfinite(s.reading_m); }))
        in.reject("holds a reading that is not a number");
    return *std::move(samples);
}

/// Empty where both columns are NULL: not stated.
std::optional<Synchronisation> read_synchronisation(RowReader& in) {
    const auto u_t_ns = in.optional_integer();
    const auto error_um = in.optional_real();
    if (u_t_ns.has_value() != error_um.has_value())
        in.reject("states one number without the other");
    if (!u_t_ns || !error_um) return std::nullopt;
    if (*u_t_ns <= 0 || *error_um < 0) in.reject("states an uncertainty that is none");
    return Synchronisation{Duration{*u_t_ns}, *error_um};
}

} // namespace

void read_datum(RecordedRun& run, RowReader& in) {
    DatumRecord datum;
    datum.id = in.text();
    datum.at = in.time();
    datum.coordinate = in.length();
    datum.reading = in.length();
    datum.epoch = in.number<std::uint32_t>();
    datum.spread = in.length();
    datum.slope_um_per_s = in.real();
    datum.n = in.number<int>();
    datum.sequence = in.number<std::uint16_t>();
    datum.device_count = std::bit_cast<std::uint64_t>(in.integer());
    run.attachments.synchronisation.push_back({-1, datum.id, read_synchronisation(in)});
    run.datums.push_back(std::move(datum));
}

void read_point(RecordedRun& run, RowReader& in) {
    PointRecord point;
    point.step = in.number<int>();
    point.sequence = in.number<std::uint16_t>();
    point.planned = read_planned(in);
    point.origin = in.choice({TriggerOrigin::cnc, TriggerOrigin::dwell, TriggerOrigin::manual});
    point.triggered_at = in.time();
    point.window_begin = in.time();
    point.window_end = in.time();
    point.reading = in.length();
    point.spread = in.length();
    point.slope_um_per_s = in.real();
    point.n = in.number<int>();
    point.approach_travel = in.length();
    point.datum_id = in.text();
    point.live_deviation = in.length();
    run.attachments.synchronisation.push_back(
        {point.step, point.datum_id, read_synchronisation(in)});
    point.samples = samples_of(in);
    run.points.push_back(std::move(point));
}

void read_environment(RunRecord& run, RowReader& in) {
    EnvironmentReading reading;
    reading.channel = in.number<int>();
    reading.at = in.time();
    reading.value = in.real();
    run.environment.push_back(reading);
}

void read_event(RunRecord& run, RowReader& in) {
    EventRecord event;
    event.kind =
        in.choice({EventKind::opened, EventKind::armed, EventKind::datum, EventKind::refused,
                   EventKind::skipped, EventKind::interrupted, EventKind::resumed,
                   EventKind::aborted, EventKind::closed, EventKind::note, EventKind::instrument});
    event.at = in.time();
    event.utc_ns = in.integer();
    event.text = in.text();
    const std::string fault = in.text();
    event.fault = fault_from_name(fault);
    if (fault_name(event.fault) != fault) in.reject("\"" + fault + "\" is not known");
    event.sequence = in.number<std::uint16_t>();
    run.events.push_back(std::move(event));
}

void read_stream(RecordedRun& run, RowReader& in) {
    StreamSetup stream;
    stream.id = in.number<int>();
    stream.channel = in.number<int>();
    stream.name = in.text();
    stream.unit = in.text();
    stream.nominal_rate_hz = in.real();
    run.streams.push_back(std::move(stream));
}

void read_stream_block(RecordedRun& run, RowReader& in) {
    StreamBlock block;
    block.stream = in.number<int>();
    block.index = in.integer();
    block.first_count = std::bit_cast<std::uint64_t>(in.integer());
    block.samples = in.number<int>();
    block.missing = std::bit_cast<std::uint64_t>(in.integer());
    block.before = in.text();
    block.begin = in.time();
    block.end = in.time();
    block.low = in.real();
    block.high = in.real();
    const auto u_t_ns = in.optional_integer();
    if (u_t_ns && *u_t_ns <= 0) in.reject("states an uncertainty that is none");
    block.time_uncertainty = Duration{u_t_ns.value_or(0)};
    block.packed = in.blob();
    run.blocks.push_back(std::move(block));
}

void read_preflight(RecordedRun& run, RowReader& in) {
    PreflightRecord check;
    check.name = in.text();
    check.passed = in.flag();
    check.warning = in.flag();
    check.verdict = in.text();
    check.override_reason = in.text();
    // A disk that failed between writing and syncing may hold them twice.
    std::erase_if(run.revisions.preflight,
                  [&](const PreflightRecord& other) { return other.name == check.name; });
    run.revisions.preflight.push_back(std::move(check));
}

void read_retake(RecordedRun& run, RowReader& in) {
    RetakeRecord retake;
    retake.number = in.number<int>();
    retake.at = in.time();
    retake.utc_ns = in.integer();
    retake.reason = in.text();
    run.revisions.retakes.push_back(std::move(retake));
}

void read_retake_point(RecordedRun& run, RowReader& in) {
    RetakePoint point;
    point.step = in.number<int>();
    point.planned_step = in.number<int>();
    auto& retakes = run.revisions.retakes;
    if (retakes.empty()) retakes.emplace_back(); // the writer checks each row by itself
    retakes.back().points.push_back(point);
}

void read_exclusion(RecordedRun& run, RowReader& in) {
    ExclusionRecord exclusion;
    exclusion.step = in.number<int>();
    exclusion.at = in.time();
    exclusion.utc_ns = in.integer();
    exclusion.reason = in.text();
    run.revisions.exclusions.push_back(std::move(exclusion));
}

void read_answer(RecordedRun& run, RowReader& in) {
    AnswerRecord answer;
    answer.finding = in.text();
    answer.at = in.time();
    answer.utc_ns = in.integer();
    answer.text = in.text();
    run.revisions.answers.push_back(std::move(answer));
}

void read_ordered(RecordedRun& run, RowReader& in) {
    OrderRecord order;
    order.kind = in.text();
    order.about = in.text();
    order.at = in.time();
    order.utc_ns = in.integer();
    order.by.door = in.text();
    order.by.uid = in.optional_integer();
    order.by.user = in.text();
    order.by.name = in.text();
    run.revisions.orders.push_back(std::move(order));
}

void read_closing(RecordedRun& run, RowReader& in) {
    ++run.revisions.closings;
    run.complete = in.flag();
    run.closing_reason = in.text();
    run.closed = read_tie(in);
}

} // namespace axiscal::record_readers
