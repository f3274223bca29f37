// A circular test that was open when the last daemon ended: it goes on at the circle whose end is
// not durable yet, or is closed with the reason.
#include "acquisition/station/station.hpp"

#include "acquisition/capture/wording.hpp"
#include "acquisition/live/time_limits.hpp"
#include "acquisition/measurement/run_header.hpp"
#include "acquisition/runfile/stream_packing.hpp"

#include <algorithm>

namespace axiscal {
namespace {

constexpr Duration settling = std::chrono::milliseconds{500};
constexpr double second_s = 1;

/// The last stored sample with the instrument's own number of it; none without numbers.
std::optional<CounterSighting> last_sighting_of(const RunFileContents& contents) {
    if (contents.blocks.empty() || contents.blocks.back().first_count == 0) return std::nullopt;
    const StreamBlock& block = contents.blocks.back();
    const auto chunk = unpacked(block);
    if (!chunk) return std::nullopt;
    const auto behind_first = static_cast<std::uint64_t>(block.samples) - 1;
    return CounterSighting{block.end, metre(chunk->value.back()), block.first_count + behind_first};
}

/// How fast the instrument numbers its samples, from what is stored; 0: too little to tell.
double stored_rate_hz(const std::vector<StreamBlock>& blocks) {
    if (blocks.empty() || blocks.front().first_count == 0) return 0;
    const StreamBlock &first = blocks.front(), &last = blocks.back();
    const double span_s = seconds_of(last.begin - first.begin);
    if (span_s < second_s || last.first_count <= first.first_count) return 0;
    return static_cast<double>(last.first_count - first.first_count) / span_s;
}

MonotonicTime last_sign_of(const RunFileContents& contents) {
    const MonotonicTime noted = last_sign_of_life(contents.run);
    return contents.blocks.empty() ? noted : std::max(noted, contents.blocks.back().end);
}

} // namespace

CircleResume Station::judge_circles(const RunFileContents& contents) const {
    const auto* known = std::get_if<CircularSetup>(&contents.attachments.setup);
    const CircularSetup setup = known != nullptr ? *known : CircularSetup{};
    BarNow now;
    now.config_hash = config_hash_;
    now.boot_id = boot_id_;
    if (roles_.ballbar) {
        const Instrument& bar = supervisor_.instrument(channel_of(*roles_.ballbar).instrument);
        const auto& reading = readings_.latest(*roles_.ballbar);
        now.speaks = reading.has_value();
        if (reading && reading->value()) now.bar = reading;
        now.incremental = bar.incremental();
        now.limits.count_modulus = bar.count_modulus();
        now.limits.rate_hz = stored_rate_hz(contents.blocks);
        if (now.limits.rate_hz <= 0) now.limits.rate_hz = setup.capture.sample_rate_hz;
    }
    const auto stream = samples_of(contents.blocks, 0);
    const StreamSamples none;
    return decide_circle_resume(
        {contents.run, setup, stream ? *stream : none, last_sighting_of(contents)}, now);
}

Task<Result<void>> Station::resume_or_close_circles(std::string path, RunFileContents contents) {
    // Its first bytes may have waited since before: their numbers would prove nothing.
    const MonotonicTime settled = scheduler_.now() + settling, limit = settled + return_limit;
    const auto bar_is_back = [this, settled] {
        const auto& reading = readings_.latest(*roles_.ballbar);
        return reading && reading->at >= settled;
    };
    while (roles_.ballbar && !bar_is_back() && scheduler_.now() < limit)
        co_await scheduler_.sleep_for(look_every);
    CircleResume verdict = judge_circles(contents);
    if (!std::holds_alternative<CircularSetup>(contents.attachments.setup))
        verdict = {CircleResume::Decision::close_incomplete,
                   Fault::incomplete_run,
                   "The station ended before the plan of the circles was kept.",
                   {}};
    if (verdict.decision == CircleResume::Decision::go_on) {
        const std::string exchanged =
            exchanged_instrument(contents.run, answered_serials(contents.run));
        if (!exchanged.empty())
            co_return co_await close_left_over(path, exchanged, Fault::unknown_instrument, false);
        co_return co_await resume_circles(std::move(path), std::move(contents), std::move(verdict));
    }
    if (verdict.decision == CircleResume::Decision::close_complete)
        co_return co_await close_driven_circles(std::move(path));
    co_return co_await close_left_over(path, verdict.sentence, verdict.fault, false);
}

/// The CNC heard of its last request, or will: publish_done_of_closed() tells it again.
Task<Result<void>> Station::close_driven_circles(std::string path) {
    const auto stored = co_await journal_.summarize(path);
    if (auto reopened = co_await journal_.reopen(path); !reopened)
        co_return tl::unexpected<Error>(reopened.error());
    if (stored) mark_another_boot(stored->boot_id);
    const std::string reason = "Every circle was driven.";
    record(EventKind::closed, reason);
    if (auto closed = co_await close_file_for_now(true, reason); !closed) {
        co_await journal_.let_go();
        co_return closed;
    }
    note("The open run " + path + " is closed as complete: " + reason);
    co_return Result<void>{};
}

std::string Station::interruption_text(const RunFileContents& contents,
                                       const CircleResume& verdict) const {
    const std::string away = in_seconds(scheduler_.now() - last_sign_of(contents));
    return "The station recorded nothing for " + away + ". " + taken_up_text(contents.run) +
           verdict.sentence;
}

/// The port is not open yet. What the CNC stands at decides: the last durable request begins its
/// circle again, and is answered once that is durable, unless that circle is whole; the next one is
/// taken where the circle before it is whole.
Task<Result<void>>
Station::resume_circles(std::string path, RunFileContents contents, CircleResume verdict) {
    if (auto reopened = co_await journal_.reopen(path); !reopened)
        co_return tl::unexpected<Error>(reopened.error());
    const std::string message = interruption_text(contents, verdict);
    const auto setup = std::get<CircularSetup>(contents.attachments.setup);
    StreamChunker behind{0};
    if (!contents.blocks.empty())
        behind = StreamChunker{contents.blocks.back(), last_sighting_of(contents).has_value()};
    begin_circular(std::move(contents.run), std::move(path), setup);
    circular_.emplace(setup, verdict.before, std::move(behind));
    run_->resumed = true;
    if (verdict.before.whole) { // a CNC that stands at it may ask once more
        const auto last = static_cast<std::uint16_t>(verdict.before.last);
        AXISCAL_CO_TRY(last_receipt_, co_await journal_.receipt_for_circle(last));
    }
    record(EventKind::interrupted, message);
    if (verdict.before.last == 0) port_->publish_armed();
    perform(SetState{PortState::armed});
    note("Run " + run_->header.run_id + " goes on. " + message);
    co_return co_await journal_.flush();
}

} // namespace axiscal
