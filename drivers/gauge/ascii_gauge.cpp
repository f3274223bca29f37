// Length gauges, read-outs and autocollimators on a serial line that answer a request with one line
// of ASCII. What differs between makers is a row in gauge_answer.cpp; there is one driver.
//
// Documents:
//   nd-28x    HEIDENHAIN, user's manuals ND 281B (page 47), ND 280, ND 287: "Data format and
//   control
//             characters", "Measured value output".
//   mitutoyo  Mitutoyo, QM-Height user's manual, 6.2.2 (output format). The request "1" and the
//             error codes 91n are common knowledge and not in it.
//   sylvac    Sylvac and Bowers, manuals of the opto RS duplex interface (commands ?, SET?, MM,
//   IN), and the settings 4800 baud, 7 bits, even, 2 stop bits (page 12).
//   elcomat-* Two open programs that agree on line, request and answer of the ELCOMAT 3000:
//             dls-controls/elcomat3000 (elcomat3000.cpp and stexample.src at 2ef0b5187a0c, and the
//             bytes of etc/simulations/elcomat3000.py at 7079e644fad5), lnls-ima/ima-utils
//             (imautils/devices/ElcomatLib.py at db70e0b3dff1). The maker's manual was not seen.
// Of all manuals: revision not stated. Nothing here was seen on a real device yet.
//
// A gauge is asked each period and heard all the time: a value that a person sends with the DATA
// key counts as well. A value belongs to the arrival of its last byte less the time that its line
// needs on the wire. One that was asked for may be as old as its request, and u(t) says so, also
// where the answer comes after the next request.

#include "drivers/gauge/ascii_gauge.hpp"

#include "config/settings.hpp"
#include "drivers/appearance.hpp"
#include "drivers/clock/late_answers.hpp"
#include "drivers/clock/placed_time.hpp"
#include "drivers/framing/line_framer.hpp"
#include "drivers/gauge/gauge_answer.hpp"
#include "drivers/wire/link_settings.hpp"

#include <algorithm>
#include <utility>

namespace axiscal {
namespace {

constexpr std::size_t longest_line = 64;
constexpr Duration link_patience = std::chrono::seconds{2};
/// So many requests in a row without an answer, and the line is opened anew.
constexpr int silent_requests = 10;
/// A unit key or a mode key may be pressed at any time: so often the gauge is asked for its
/// settings.
constexpr Duration settings_period = std::chrono::seconds{1};

struct GaugeSetup {
    const GaugeModel* model = nullptr;
    LinkSettings link;
    std::optional<GaugeUnit> unit; ///< as stated; empty: the gauge tells
    int sign = 1, input = 1;
    std::optional<int> decimals; ///< as stated
    Duration poll_period{};
};

/// Of the longest answer, its characters with start, parity and stop bits.
Duration time_on_wire(const LinkSettings& line, int characters) {
    const int bits = 1 + line.data_bits + (line.parity == 'N' ? 0 : 1) + line.stop_bits;
    return std::chrono::nanoseconds{std::int64_t{1'000'000'000} * characters * bits / line.baud};
}

std::vector<std::byte> bytes_of(std::string_view text) {
    const auto bytes = std::as_bytes(std::span{text});
    return {bytes.begin(), bytes.end()};
}

class AsciiGauge final : public Instrument {
public:
    explicit AsciiGauge(GaugeSetup setup)
        : setup_{std::move(setup)}
        , latency_{time_on_wire(setup_.link, setup_.model->longest_answer)}
        , channels_{setup_.model->angular()
                        ? Channel{"angle", ChannelKind::angle, Medium::none}
                        : Channel{"length", ChannelKind::displacement, Medium::none}} {}
    [[nodiscard]] const std::vector<Channel>& channels() const override { return channels_; }
    Task<Result<void>> run(InstrumentContext context) override;
    [[nodiscard]] const InstrumentCounters& counters() const override { return counters_; }

private:
    Task<Result<void>>
    hear_until(ByteLink& link, InstrumentContext context, LineFramer& framer, MonotonicTime end);
    Task<Result<void>> ask_unit(ByteLink& link, InstrumentContext context, LineFramer& framer);
    Task<Result<void>> ask(ByteLink& link, InstrumentContext context, LineFramer& framer);
    void take_line(std::string_view line, MonotonicTime read_at, SampleSink& sink);
    void take_answer(const GaugeAnswer& answer, MonotonicTime at, SampleSink& sink);
    void take_error(const Error& error, MonotonicTime at, SampleSink& sink);
    void take_settings(std::string_view line, GaugeUnit unit);
    [[nodiscard]] std::string why_no_length(const GaugeAnswer& answer, GaugeUnit unit) const;
    void tell_identity(SampleSink& sink);
    [[nodiscard]] Duration uncertainty_at(MonotonicTime at);
    void learn_unit(GaugeUnit unit);
    [[nodiscard]] tl::unexpected<Error> why_no_unit(const InstrumentCounters& before) const;
    [[nodiscard]] bool is_echo(std::string_view line) const;

    GaugeSetup setup_;
    Duration latency_, time_uncertainty_{};
    std::vector<Channel> channels_;
    InstrumentCounters counters_;
    OpenRequests requests_;
    std::optional<GaugeUnit> told_unit_; ///< by the gauge, on this connection
    std::string held_;                   ///< the extreme that it holds, as it says; empty: none
    MonotonicTime settings_told_at_{};
    std::optional<Error> contradiction_;
    bool answered_ = false, identified_ = false;
    bool counted_before_ = false; ///< a value was handed up on an earlier connection
    std::uint32_t epoch_ = 0;
};

/// An opto cable sends back what it was sent.
bool AsciiGauge::is_echo(std::string_view line) const {
    const auto without_end = [](std::string_view text) { return text.substr(0, text.find('\r')); };
    return line == without_end(setup_.model->request) ||
           (!setup_.model->unit_request.empty() && line == without_end(setup_.model->unit_request));
}

void AsciiGauge::learn_unit(GaugeUnit unit) {
    told_unit_ = unit;
    if (!setup_.unit || *setup_.unit == unit) return;
    contradiction_ = Error{Fault::bad_configuration,
                           "the gauge on " + setup_.link.describe() +
                               " shows another unit than the station file states: press its unit "
                               "key or correct `unit`"};
}

void AsciiGauge::take_settings(std::string_view line, GaugeUnit unit) {
    ++counters_.frames;
    held_ = held_in_settings(line);
    learn_unit(unit);
}

/// Why a number that came is not what the gauge measures, in this unit; empty: it is.
std::string AsciiGauge::why_no_length(const GaugeAnswer& answer, GaugeUnit unit) const {
    if (!held_.empty())
        return "the gauge holds an extreme (" + held_ + ") and not its value: press its mode key";
    const bool fits =
        setup_.decimals ? answer.decimals == *setup_.decimals
                        : !setup_.model->decimals_tell_unit || decimals_fit(answer.decimals, unit);
    if (fits) return "";
    const std::string read_in = unit == GaugeUnit::inches ? "inches" : "mm";
    return "the gauge sends " + std::to_string(answer.decimals) + " decimals and is read in " +
           read_in +
           ": was its unit key pressed? One that always shows so many needs `decimals = " +
           std::to_string(answer.decimals) + "`";
}

/// u(t) of a value at `at`: what its line on the wire leaves open, or more where it is the answer
/// of a gauge that took its time. The first value after a request answers it, or is one that a
/// person sent meanwhile; the next ones are a person's.
Duration AsciiGauge::uncertainty_at(MonotonicTime at) {
    const auto asked = requests_.answered(at);
    if (!asked) return time_uncertainty_;
    return std::max(time_uncertainty_, placed_at_end(at, at - *asked).uncertainty);
}

void AsciiGauge::take_answer(const GaugeAnswer& answer, MonotonicTime at, SampleSink& sink) {
    if (answer.input != setup_.input) return; // another input of the multiplexer
    answered_ = true;
    const Duration uncertainty = uncertainty_at(at - latency_);
    if (answer.unit) learn_unit(*answer.unit);
    const auto unit = told_unit_ ? told_unit_ : setup_.unit;
    if (contradiction_ || !unit) return;
    tell_identity(sink);
    if (const std::string why = why_no_length(answer, *unit); !why.empty()) {
        sink.note(Fault::signal_error, why);
        return sink.take(Sample::bad(0, at - latency_, Quality::signal_error, 0, epoch_));
    }
    ++counters_.samples;
    const double stored =
        setup_.model->angular() ? answer.number : length_of(answer.number, *unit).si();
    Sample sample{0, at - latency_, setup_.sign * stored, 0, epoch_};
    sample.time_uncertainty = uncertainty;
    sink.take(sample);
    counted_before_ = true;
}

void AsciiGauge::tell_identity(SampleSink& sink) {
    if (std::exchange(identified_, true)) return;
    sink.identify(
        Identity{std::string{setup_.model->maker}, std::string{setup_.model->model}, "", ""});
}

/// An autocollimator sees no mirror whenever the axis turns: its quality says so, and no note.
void AsciiGauge::take_error(const Error& error, MonotonicTime at, SampleSink& sink) {
    answered_ = true;
    requests_.answered(at - latency_);
    if (error.fault == Fault::beam_lost) {
        tell_identity(sink);
        return sink.take(Sample::bad(0, at - latency_, Quality::beam_lost, 0, epoch_));
    }
    sink.note(error.fault, error.detail);
    sink.take(Sample::bad(0, at - latency_, Quality::signal_error, 0, epoch_));
}

void AsciiGauge::take_line(std::string_view line, MonotonicTime read_at, SampleSink& sink) {
    if (line.starts_with('\n')) line.remove_prefix(1); // CR LF of a gauge whose lines end with CR
    if (line.empty() || is_echo(line)) return;
    if (const auto unit = unit_in_settings(line); unit && !setup_.model->unit_request.empty())
        return take_settings(line, *unit);
    const auto answer = decode_gauge_answer(line, *setup_.model);
    if (answer) {
        ++counters_.frames;
        return take_answer(*answer, read_at, sink);
    }
    if (answer.error().fault == Fault::bad_frame) {
        ++counters_.bad_frames;
        return;
    }
    ++counters_.frames;
    take_error(answer.error(), read_at, sink);
}

/// The link and the framer are owned by run()'s frame, which waits.
Task<Result<void>> AsciiGauge::hear_until(ByteLink& link,
                                          InstrumentContext context,
                                          LineFramer& framer,
                                          MonotonicTime end) {
    while (context.scheduler->now() < end && !contradiction_) {
        const auto arrived = co_await link.read_some(end);
        if (!arrived && arrived.error().fault == Fault::link_timeout) break;
        if (!arrived) co_return tl::unexpected<Error>(arrived.error());
        const auto oversized = framer.feed(arrived->bytes, [&](std::string_view line) {
            take_line(line, arrived->read_at, *context.sink);
        });
        counters_.bad_frames += oversized;
    }
    if (contradiction_) co_return tl::unexpected<Error>(*contradiction_);
    co_return Result<void>{};
}

/// A gauge that does not tell its unit when asked is believed what the station file states; without
/// such a statement there is no value.
Task<Result<void>>
AsciiGauge::ask_unit(ByteLink& link, InstrumentContext context, LineFramer& framer) {
    if (setup_.model->unit_request.empty()) co_return Result<void>{};
    const InstrumentCounters before = counters_;
    auto request = bytes_of(setup_.model->unit_request);
    const MonotonicTime end = context.scheduler->now() + link_patience;
    auto written = co_await link.write_all(std::move(request), end);
    if (!written) co_return written;
    told_unit_.reset();
    while (!told_unit_ && context.scheduler->now() < end) {
        const MonotonicTime soon =
            std::min(end, context.scheduler->now() + std::chrono::milliseconds{100});
        const auto heard = co_await hear_until(link, context, framer, soon);
        if (!heard) co_return heard;
    }
    settings_told_at_ = context.scheduler->now();
    if (!told_unit_ && !setup_.unit) co_return why_no_unit(before);
    co_return Result<void>{};
}

/// Of a gauge that was asked for its unit, by what was heard of it since `before`.
tl::unexpected<Error> AsciiGauge::why_no_unit(const InstrumentCounters& before) const {
    const std::string gauge = "the gauge on " + setup_.link.describe();
    if (counters_.frames > before.frames)
        return fail(Fault::bad_configuration,
                    gauge + " does not tell its unit: state `unit` in the station file");
    if (counters_.bad_frames > before.bad_frames)
        return fail(Fault::bad_frame, gauge + " sends what cannot be read: is it this model, and "
                                              "are its line settings these?");
    return fail(Fault::link_timeout,
                gauge + " says nothing when it is asked for its unit: is it switched on, and are "
                        "its line settings these? One that cannot tell needs `unit` in the station "
                        "file");
}

Task<Result<void>> AsciiGauge::ask(ByteLink& link, InstrumentContext context, LineFramer& framer) {
    const auto hear = [&](MonotonicTime end) { return hear_until(link, context, framer, end); };
    const auto late = co_await hear_late(requests_, *context.scheduler, setup_.poll_period, hear);
    if (!late) co_return late;
    // One that never told is not asked again: what the station file states holds.
    if (told_unit_ && context.scheduler->now() >= settings_told_at_ + settings_period) {
        const auto known = co_await ask_unit(link, context, framer);
        if (!known) co_return known;
    }
    answered_ = false;
    const MonotonicTime now = context.scheduler->now();
    const MonotonicTime next = now + setup_.poll_period;
    requests_.asked(now);
    auto request = bytes_of(setup_.model->request);
    const auto written = co_await link.write_all(std::move(request), next + link_patience);
    if (!written) co_return written;
    const auto heard = co_await hear_until(link, context, framer, next);
    if (heard && !answered_) ++counters_.timeouts;
    co_return heard;
}

Task<Result<void>> AsciiGauge::run(InstrumentContext context) {
    auto opened =
        co_await context.links->open(setup_.link, context.scheduler->now() + link_patience);
    if (!opened) co_return tl::unexpected<Error>(opened.error());
    const std::unique_ptr<ByteLink> link = *std::move(opened);
    // Answers have 10 to 24 characters; an adapter keeps them for as long as its timer runs.
    time_uncertainty_ = link->latency_uncertainty() + latency_ / 2;
    if (!link->remark().empty()) context.sink->note(Fault::none, link->remark());
    requests_.forget();
    told_unit_.reset();
    held_.clear();
    contradiction_.reset();
    identified_ = false;
    // The read-out may have been switched off meanwhile, and its zero with it.
    if (std::exchange(counted_before_, false)) ++epoch_;
    LineFramer framer{longest_line, false, setup_.model->line_end};
    const auto known = co_await ask_unit(*link, context, framer);
    if (!known) co_return known;
    for (int silent = 0; silent < silent_requests; silent = answered_ ? 0 : silent + 1) {
        const auto asked = co_await ask(*link, context, framer);
        if (!asked) co_return asked;
    }
    co_return fail(Fault::link_timeout,
                   "no value from the gauge on " + setup_.link.describe() +
                       ": is it switched on, and are its line settings these?");
}

std::vector<std::string> model_names() {
    std::vector<std::string> names;
    for (const GaugeModel& model : gauge_models())
        names.emplace_back(model.name);
    return names;
}

std::optional<GaugeUnit> read_unit(Settings& options, const GaugeModel& model) {
    if (model.angular()) {
        options.choice("unit", {"arcsec"}, "arcsec"); // the key is known, there is no other one
        return GaugeUnit::arcseconds;
    }
    if (!options.has("unit") && model.tells_unit()) {
        options.choice("unit", {"mm", "inch"}, "mm"); // the key is known, the gauge tells
        return std::nullopt;
    }
    return options.choice("unit", {"mm", "inch"}) == "inch" ? GaugeUnit::inches
                                                            : GaugeUnit::millimetres;
}

} // namespace

const Appearance ascii_gauge_appearance{
    Wire::serial,
    {},
    true,
    "gauge",
    "model = \"nd-28x\"               # or \"mitutoyo\" with unit = \"mm\", or \"sylvac\", or\n"
    "                               # \"elcomat-x\", an autocollimator\n"};

std::unique_ptr<Instrument> make_ascii_gauge(const InstrumentConfig& /*config*/,
                                             Settings& options) {
    const GaugeModel* const named = find_gauge_model(options.choice("model", model_names()));
    GaugeSetup setup;
    setup.model = named ? named : &gauge_models().front(); // refused above
    setup.link = read_link(options, setup.model->line);
    const bool known = !options.refused("model");
    if (known) setup.unit = read_unit(options, *setup.model);
    if (!known) options.choice("unit", {"mm", "inch", "arcsec"}, "mm"); // one of them has it
    setup.sign = options.choice("counting", {"normal", "reversed"}, "normal") == "normal" ? 1 : -1;
    setup.input = static_cast<int>(options.integer("input", 1, 9, 1));
    if (setup.input != 1 && known && !setup.model->has_inputs())
        options.refuse("input", "this gauge has one input only: remove the key");
    if (known && !setup.model->angular() && options.has("decimals"))
        setup.decimals = static_cast<int>(options.integer("decimals", 0, 6));
    setup.poll_period = options.duration("poll_period", std::chrono::milliseconds{20},
                                         std::chrono::seconds{60}, setup.model->poll_period);
    return std::make_unique<AsciiGauge>(std::move(setup));
}

} // namespace axiscal
