#include "acquisition/measurement/circular/left_circles.hpp"

#include "acquisition/capture/wording.hpp"
#include "acquisition/live/live_readings.hpp"
#include "acquisition/live/roles.hpp"
#include "acquisition/live/supervisor.hpp"
#include "acquisition/live/time_limits.hpp"
#include "acquisition/measurement/instrument_serials.hpp"
#include "acquisition/measurement/run_header.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "acquisition/runfile/stream_packing.hpp"
#include "analysis/record/circular_setup.hpp"
#include "analysis/record/stream_record.hpp"
#include "drivers/instrument.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <variant>

namespace axiscal {
namespace {

constexpr Duration settling = std::chrono::milliseconds{500};
constexpr double least_span_s = 1; // below it the stored numbers tell no rate

/// How fast the instrument numbers its samples, from what is stored; 0: too little to tell.
double stored_rate_hz(const std::vector<StreamBlock>& blocks) {
    if (blocks.empty() || blocks.front().first_count == 0) return 0;
    const StreamBlock &first = blocks.front(), &last = blocks.back();
    const double span_s = seconds_of(last.begin - first.begin);
    if (span_s < least_span_s || last.first_count <= first.first_count) return 0;
    return static_cast<double>(last.first_count - first.first_count) / span_s;
}

MonotonicTime last_sign_of(const RunFileContents& contents) {
    const MonotonicTime noted = last_sign_of_life(contents.run);
    return contents.blocks.empty() ? noted : std::max(noted, contents.blocks.back().end);
}

BarNow bar_now(const CncContext& context,
               const std::vector<StreamBlock>& blocks,
               const CircularSetup& setup) {
    BarNow now;
    now.config_hash = context.config_hash;
    now.boot_id = context.boot_id;
    const std::optional<int> id = context.roles.ballbar;
    if (!id) return now;
    const int seat = context.instruments.channels()[static_cast<std::size_t>(*id)].instrument;
    const Instrument& bar = context.instruments.instrument(seat);
    const auto& reading = context.readings.latest(*id);
    now.speaks = reading.has_value();
    if (reading && reading->value()) now.bar = reading;
    now.incremental = bar.incremental();
    now.limits.count_modulus = bar.count_modulus();
    now.limits.rate_hz = stored_rate_hz(blocks);
    if (now.limits.rate_hz <= 0) now.limits.rate_hz = setup.capture.sample_rate_hz;
    return now;
}

CircleResume ends_with(Fault fault, std::string sentence) {
    return {CircleResume::Decision::close_incomplete, fault, std::move(sentence), {}};
}

} // namespace

Task<void> ballbar_is_back(CncContext context) {
    if (!context.roles.ballbar) co_return;
    const int bar = *context.roles.ballbar;
    // Its first bytes may have waited since before: their numbers would prove nothing.
    const MonotonicTime settled = context.scheduler.now() + settling;
    const MonotonicTime limit = settled + return_limit;
    const auto is_back = [&context, bar, settled] {
        const auto& reading = context.readings.latest(bar);
        return reading && reading->at >= settled;
    };
    while (!is_back() && context.scheduler.now() < limit)
        co_await context.scheduler.sleep_for(look_every);
}

std::optional<CounterSighting> last_sighting_of(const RunFileContents& contents) {
    if (contents.blocks.empty() || contents.blocks.back().first_count == 0) return std::nullopt;
    const StreamBlock& block = contents.blocks.back();
    const auto chunk = unpacked(block);
    if (!chunk) return std::nullopt;
    const auto behind_first = static_cast<std::uint64_t>(block.samples) - 1;
    return CounterSighting{block.end, metre(chunk->value.back()), block.first_count + behind_first};
}

CircleResume judge_left_circles(const CncContext& context, const RunFileContents& contents) {
    const auto* setup = std::get_if<CircularSetup>(&contents.attachments.setup);
    if (setup == nullptr)
        return ends_with(Fault::incomplete_run,
                         "The station ended before the plan of the circles was kept.");
    const auto stored = samples_of(contents.blocks, 0);
    const StreamSamples none;
    CircleResume verdict = decide_circle_resume(
        {contents.run, *setup, stored ? *stored : none, last_sighting_of(contents)},
        bar_now(context, contents.blocks, *setup));
    if (verdict.decision != CircleResume::Decision::go_on) return verdict;
    std::string exchanged = exchanged_instrument(contents.run, serials_of_circles(context));
    if (!exchanged.empty()) return ends_with(Fault::unknown_instrument, std::move(exchanged));
    return verdict;
}

std::string
interruption_text(const RunFileContents& contents, const CircleResume& verdict, MonotonicTime now) {
    const std::string away = in_seconds(now - last_sign_of(contents));
    return "The station recorded nothing for " + away + ". " + taken_up_text(contents.run) +
           verdict.sentence;
}

std::vector<InstrumentSerial> serials_of_circles(const CncContext& context) {
    std::vector<int> channels = context.roles.of_circles();
    if (context.roles.ballbar) channels.push_back(*context.roles.ballbar);
    return answered_serials(context.instruments, channels);
}

} // namespace axiscal
