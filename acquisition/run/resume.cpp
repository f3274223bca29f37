#include "acquisition/run/resume.hpp"

#include "acquisition/capture/wording.hpp"
#include "acquisition/run/sequence.hpp"
#include "analysis/record/run_clock.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

namespace axiscal {
namespace {

constexpr Duration shortest_rate_base = std::chrono::seconds{10};
constexpr Duration shortest_count = std::chrono::seconds{1};

void add_sightings(const WindowSamples& samples, std::vector<CounterSighting>& out) {
    for (const auto* sample : {&samples.front(), &samples.back()})
        if (sample->device_count != 0)
            out.push_back({sample->at, metre(sample->reading_m), sample->device_count});
}

/// First and last of every window, in time.
std::vector<CounterSighting> sightings(const RunRecord& run) {
    std::vector<CounterSighting> seen;
    for (const auto& datum : run.datums)
        if (datum.device_count != 0) seen.push_back({datum.at, datum.reading, datum.device_count});
    for (const auto& point : run.points)
        if (!point.samples.empty()) add_sightings(point.samples, seen);
    std::ranges::stable_sort(seen, {}, &CounterSighting::at);
    return seen;
}

ContinuityVerdict lost(std::string reason) {
    return {false, "The datum is lost: " + std::move(reason)};
}

std::string serial_of_laser(const RunRecord& run) {
    const auto laser =
        std::ranges::find(run.instruments, run.laser.instrument, &InstrumentRecord::name);
    return laser == run.instruments.end() ? std::string{} : laser->serial;
}

std::string begun_large(std::string sentence) {
    sentence.front() = static_cast<char>(std::toupper(sentence.front()));
    return sentence;
}

ResumeVerdict judge_datum(const RunRecord& run, const StationNow& now) {
    const auto closing = [](std::string why) {
        return ResumeVerdict{ResumeDecision::close_datum_lost, Fault::datum_lost, std::move(why)};
    };
    const bool armed = std::ranges::any_of(
        run.events, [](const EventRecord& event) { return event.kind == EventKind::armed; });
    if (run.datums.empty() && !armed)
        return {ResumeDecision::close_never_armed, Fault::no_run_armed,
                "The station went down before the datum was tied; nothing was measured yet."};
    // The air and the temperatures kept so far count by a clock that has begun anew.
    const bool same_boot = is_same_boot(now.boot_id, run.boot_id);
    const std::string restart = same_boot ? "" : restart_text(run.boot_id, now.boot_id);
    if (run.datums.empty() && !same_boot)
        return {ResumeDecision::close_never_armed, Fault::no_run_armed,
                begun_large(restart) + " before the datum was tied; nothing was measured yet."};
    if (run.datums.empty()) return {};
    if (!same_boot) return closing("The datum is lost: " + restart + " since.");
    const std::string reference{reference_word_of(run)};
    const auto before = last_sighting(run);
    if (!before)
        return closing("The datum is lost: the run kept no number of the " + reference +
                       "'s samples.");
    if (!now.laser) return closing("The datum is lost: the " + reference + " gives no reading.");
    auto limits = now.limits;
    if (limits.rate_hz <= 0) limits.rate_hz = counting_rate_hz(run).value_or(0);
    const auto verdict = datum_continues(*before, *now.laser, limits, reference);
    if (!verdict.continues) return closing(verdict.reason);
    return {ResumeDecision::wait_for_request, Fault::none, verdict.reason};
}

} // namespace

std::optional<CounterSighting> last_sighting(const RunRecord& run) {
    const auto seen = sightings(run);
    return seen.empty() ? std::nullopt : std::optional{seen.back()};
}

std::optional<double> counting_rate_hz(const RunRecord& run) {
    const auto seen = sightings(run);
    if (seen.size() < 2) return std::nullopt;
    const auto span = seen.back().at - seen.front().at;
    if (span < shortest_rate_base || seen.back().device_count <= seen.front().device_count)
        return std::nullopt;
    return static_cast<double>(seen.back().device_count - seen.front().device_count) /
           seconds_of(span);
}

std::optional<double> counting_rate_hz(std::span<const Sample> samples) {
    if (samples.empty()) return std::nullopt;
    const Sample &first = samples.front(), &last = samples.back();
    if (last.at - first.at < shortest_count || last.device_count <= first.device_count)
        return std::nullopt;
    return static_cast<double>(last.device_count - first.device_count) /
           seconds_of(last.at - first.at);
}

MonotonicTime last_sign_of_life(const RunRecord& run) {
    MonotonicTime last = run.opened.after;
    for (const auto& datum : run.datums)
        last = std::max(last, datum.at);
    for (const auto& point : run.points)
        last = std::max(last, point.window_end);
    for (const auto& event : run.events)
        last = std::max(last, event.at);
    for (const auto& reading : run.environment)
        last = std::max(last, reading.at);
    return last;
}

ContinuityVerdict datum_continues(const CounterSighting& last_before,
                                  const Sample& first_after,
                                  const ContinuityLimits& limits,
                                  std::string_view reference) {
    const auto reading = first_after.value();
    if (!reading) return lost("the axis has no good reading.");
    if (last_before.device_count == 0 || first_after.device_count == 0)
        return lost(
            "this instrument does not number its samples, so nothing proves that it ran on.");
    if (limits.rate_hz <= 0)
        return lost("the run was too young to tell how fast the counter runs.");
    const Duration elapsed = first_after.at - last_before.at;
    if (elapsed < Duration{}) return lost("its reading is older than the run's last one.");
    const double expected = seconds_of(elapsed) * limits.rate_hz;
    const double tolerance =
        limits.rate_share * expected + seconds_of(limits.stamp_slack) * limits.rate_hz;
    const auto before = static_cast<double>(last_before.device_count);
    if (limits.count_modulus == 0 && before <= 2 * tolerance)
        return lost("the counter was switched on too shortly before to tell that it was not "
                    "switched off again.");
    double advance = static_cast<double>(first_after.device_count) - before;
    if (limits.count_modulus > 0) {
        const auto modulus = static_cast<double>(limits.count_modulus);
        if (expected + tolerance >= modulus)
            return lost("after " + in_seconds(elapsed) +
                        " the counter's short number says nothing.");
        advance = std::fmod(std::fmod(advance, modulus) + modulus, modulus);
    }
    const std::string numbers = "its number advanced by " + plain_number(advance, 0) + " in " +
                                in_seconds(elapsed) + ", " + plain_number(expected, 0) +
                                " were due";
    if (std::abs(advance - expected) > tolerance) return lost(numbers + ".");
    const auto jump = abs(metre(*reading) - last_before.reading);
    const auto reach = metre(limits.fastest.si() * seconds_of(elapsed + limits.stamp_slack));
    if (limits.fastest.si() > 0 && jump > reach)
        return lost("the reading differs by " + in_mm(jump) + " after " + in_seconds(elapsed) +
                    ", faster than the axis can move.");
    return {true, "The " + std::string{reference} + " counted on during the interruption: " +
                      numbers + "; the reading is " + in_mm(jump) + " from the last one."};
}

DurableRequest last_durable_request(const RunRecord& run) {
    MonotonicTime newest{Duration::min()};
    DurableRequest last;
    const auto consider = [&](MonotonicTime at, DurableRequest request) {
        if (request.sequence != 0 && at >= newest) newest = at, last = request;
    };
    for (const auto& datum : run.datums)
        consider(datum.at, {datum.sequence, -1});
    for (const auto& event : run.events)
        if (const auto step = skipped_step(event)) consider(event.at, {event.sequence, *step});
    for (const auto& point : run.points)
        consider(point.window_end, {point.sequence, point.step});
    return last;
}

ResumeVerdict judge_first_request(std::uint16_t last_durable,
                                  std::optional<std::uint16_t> request) {
    if (!request || (*request == 0 && last_durable == 0))
        return {ResumeDecision::wait_for_request, Fault::none,
                "The CNC has asked for nothing yet."};
    if (*request == last_durable)
        return {ResumeDecision::republish_done, Fault::none,
                "Resumed: request " + std::to_string(*request) +
                    " was durable before the interruption, done is published again."};
    if (*request == next_sequence(last_durable))
        return {ResumeDecision::capture_standing, Fault::none,
                "Resumed: request " + std::to_string(*request) + " still stands and is captured."};
    return {ResumeDecision::close_sequence_lost, Fault::sequence_lost,
            describe_disorder(*request, last_durable)};
}

std::string exchanged_instrument(const RunRecord& run, const std::vector<InstrumentSerial>& now) {
    for (const auto& [name, serial] : now) {
        const auto then = std::ranges::find(run.instruments, name, &InstrumentRecord::name);
        if (then == run.instruments.end() || then->serial.empty() || serial.empty()) continue;
        if (serial == then->serial) continue;
        std::string sentence = "The instrument '";
        sentence.append(name).append("' has the serial number '").append(serial);
        sentence.append("', the run's has '").append(then->serial).append("'.");
        return sentence;
    }
    return {};
}

ResumeVerdict
decide_resume(const RunRecord& run, std::optional<std::uint16_t> request, const StationNow& now) {
    if (now.config_hash != run.config_hash)
        return {ResumeDecision::close_config_changed, Fault::bad_configuration,
                "The station file was changed since the run was opened."};
    const auto serial = serial_of_laser(run);
    if (now.laser_serial != serial)
        return {ResumeDecision::close_other_instrument, Fault::unknown_instrument,
                "The " + std::string{reference_word_of(run)} + " has the serial number '" +
                    now.laser_serial + "', the run's has '" + serial + "'."};
    auto datum = judge_datum(run, now);
    if (datum.fault != Fault::none) return datum;
    if (std::string exchanged = exchanged_instrument(run, now.instruments); !exchanged.empty())
        return {ResumeDecision::close_other_instrument, Fault::unknown_instrument,
                std::move(exchanged)};
    if (!now.outside_limits.empty())
        return {ResumeDecision::close_environment, Fault::environment_outside,
                "The environment is out of limits: " + now.outside_limits + "."};
    auto verdict = judge_first_request(last_durable_request(run).sequence, request);
    if (!request && !datum.sentence.empty())
        verdict.sentence = datum.sentence;
    else if (!datum.sentence.empty())
        verdict.sentence += " " + datum.sentence;
    return verdict;
}

} // namespace axiscal
