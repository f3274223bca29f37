// Vaisala PTU300 (pressure, temperature, humidity) and PTB330 (pressure) on RS-232.
//
// Documents: Vaisala, PTU300 user's guide and PTB330 user's guide, chapters on the serial line,
// revision not stated of both.
// "[FORM]" cites the table of format modifiers, "[modes]" SMODE, OPEN and CLOSE, "[SEND]" one
// reading. Nothing here was seen on a real device yet. Not in them, and therefore a key of the
// station file or told on the page: the port settings of one unit (4800 7E1 is the family's
// default), the asterisks in place of a faulty value.
//
// [SEND]  SEND or SEND <address>, CR: one message in the format that FORM has set.
// [FORM]  x.y digits and decimals of what follows, Un the unit in n places, CSX and CS4 the
// checksum
//         of the message so far. The transmitter answers OK. With checksum = "none" its own format
//         stays as it is.
// [modes] S ends continuous output. In POLL mode OPEN <address> makes it take commands, CLOSE ends.

#include "drivers/environment/environment_vaisala.hpp"

#include "config/settings.hpp"
#include "drivers/appearance.hpp"
#include "drivers/clock/late_answers.hpp"
#include "drivers/clock/placed_time.hpp"
#include "drivers/environment/vaisala_line.hpp"
#include "drivers/framing/line_framer.hpp"
#include "drivers/wire/link_settings.hpp"

#include <algorithm>

namespace axiscal {
namespace {

constexpr std::size_t longest_line = 160;
constexpr Duration link_patience = std::chrono::seconds{2};
/// What the transmitter says to commands is waited for no longer than this.
constexpr Duration talk = std::chrono::milliseconds{500};
/// One that was switched off has forgotten nothing but may be in another mode: it is told anew
/// after three silent requests. After three more the line is opened anew: an adapter that stalled
/// reads no more until then, and a reading must be back within 5 s.
constexpr int silent_requests = 3;

struct VaisalaSetup {
    LinkSettings link;
    bool pressure_only = false;
    VaisalaChecksum checksum = VaisalaChecksum::csx;
    std::optional<int> address; ///< in POLL mode
    Duration poll_period{};
};

std::vector<Channel> channels_of(const VaisalaSetup& setup) {
    std::vector<Channel> channels{{"air pressure", ChannelKind::pressure, Medium::air}};
    if (setup.pressure_only) return channels;
    channels.push_back({"air temperature", ChannelKind::temperature, Medium::air});
    channels.push_back({"air humidity", ChannelKind::humidity, Medium::air});
    return channels;
}

std::string form_of(const VaisalaSetup& setup) {
    const std::string pressure = R"(form 4.2 "P=" P " " U6)";
    const std::string others = R"( 3.2 "T=" T " " U3 3.1 "RH=" RH " " U4)";
    const std::string sum = setup.checksum == VaisalaChecksum::csx ? " CSX" : " CS4";
    return pressure + (setup.pressure_only ? "" : others) + sum + R"( \r \n)";
}

/// What is sent before the first request, in this order.
std::vector<std::string> opening_commands(const VaisalaSetup& setup) {
    std::vector<std::string> commands{"s"};
    const std::string address = setup.address ? std::to_string(*setup.address) : "";
    if (setup.checksum == VaisalaChecksum::none) return commands;
    if (setup.address) commands.push_back("open " + address);
    commands.push_back(form_of(setup));
    if (setup.address) commands.emplace_back("close");
    return commands;
}

std::vector<std::byte> bytes_of(const std::string& command) {
    const std::string line = command + "\r";
    const auto bytes = std::as_bytes(std::span{line});
    return {bytes.begin(), bytes.end()};
}

/// The message without the prompt that may stand before it.
std::string_view without_prompt(std::string_view line) {
    const auto begin = line.find_first_not_of("> \r");
    return begin == std::string_view::npos ? std::string_view{} : line.substr(begin);
}

/// Echoes and answers to commands; they tell nothing.
bool is_talk(std::string_view line) {
    constexpr std::string_view words[] = {"ok", "send", "form", "open", "close",
                                          "s",  "ptb",  "ptu",  "line"};
    const std::string_view first = line.substr(0, line.find_first_of(" :0123456789"));
    return std::ranges::any_of(words, [&](std::string_view word) {
        return std::ranges::equal(first, word,
                                  [](char a, char b) { return (a | 0x20) == (b | 0x20); });
    });
}

class Vaisala final : public Instrument {
public:
    explicit Vaisala(VaisalaSetup setup)
        : setup_{std::move(setup)}
        , channels_{channels_of(setup_)}
        , request_{setup_.address ? "send " + std::to_string(*setup_.address) : "send"} {}
    [[nodiscard]] const std::vector<Channel>& channels() const override { return channels_; }
    Task<Result<void>> run(InstrumentContext context) override;
    [[nodiscard]] const InstrumentCounters& counters() const override { return counters_; }

private:
    Task<Result<void>>
    hear_until(ByteLink& link, InstrumentContext context, LineFramer& framer, MonotonicTime end);
    Task<Result<void>> prepare(ByteLink& link, InstrumentContext context, LineFramer& framer);
    Task<Result<void>> ask(ByteLink& link, InstrumentContext context, LineFramer& framer);
    Task<Result<int>>
    ask_while_heard(ByteLink& link, InstrumentContext context, LineFramer& framer);
    void take_line(std::string_view line, MonotonicTime read_at, SampleSink& sink);
    void take_reading(const VaisalaReading& reading, const PlacedTime& at, SampleSink& sink);
    [[nodiscard]] PlacedTime placed(MonotonicTime read_at) const;
    void close_request(MonotonicTime read_at);

    VaisalaSetup setup_;
    std::vector<Channel> channels_;
    std::string request_;
    InstrumentCounters counters_;
    bool heard_ = false, identified_ = false;
    bool spoke_ = false; ///< any byte came since the line was opened
    OpenRequests requests_;
    std::optional<MonotonicTime>
        asked_at_; ///< what was answered last; empty: none since it was told
};

/// A line that nobody asked for (it still sent by itself) states no u(t).
PlacedTime Vaisala::placed(MonotonicTime read_at) const {
    return asked_at_ ? placed_between(*asked_at_, read_at) : PlacedTime{read_at, Duration{}};
}

/// What answers nothing, a line more, keeps the request that was answered last: it is older.
void Vaisala::close_request(MonotonicTime read_at) {
    if (const auto asked = requests_.answered(read_at)) asked_at_ = asked;
}

void Vaisala::take_reading(const VaisalaReading& reading, const PlacedTime& at, SampleSink& sink) {
    if (!std::exchange(identified_, true))
        sink.identify(Identity{"Vaisala", setup_.pressure_only ? "PTB330" : "PTU300", "", ""});
    const std::optional<double> values[] = {reading.pressure_Pa, reading.temperature_degC,
                                            reading.humidity_percent};
    for (std::size_t i = 0; i < channels_.size(); ++i) {
        ++counters_.samples;
        sink.take(sample_at(static_cast<int>(i), at, values[i]));
    }
}

void Vaisala::take_line(std::string_view text, MonotonicTime read_at, SampleSink& sink) {
    const std::string_view line = without_prompt(text);
    if (line.empty() || is_talk(line)) return;
    const auto body = verify_vaisala_line(line, setup_.checksum);
    const auto reading = body ? parse_vaisala_line(*body) : tl::unexpected<Error>(body.error());
    // A damaged reading is an answer as well; what is no reading at all may be anything.
    if (reading || reading.error().fault == Fault::checksum) close_request(read_at);
    if (!reading) {
        ++(reading.error().fault == Fault::checksum ? counters_.checksum_errors
                                                    : counters_.bad_frames);
        return;
    }
    ++counters_.frames;
    heard_ = true;
    take_reading(*reading, placed(read_at), sink);
}

/// The link and the framer are owned by run()'s frame, which waits.
Task<Result<void>> Vaisala::hear_until(ByteLink& link,
                                       InstrumentContext context,
                                       LineFramer& framer,
                                       MonotonicTime end) {
    while (context.scheduler->now() < end) {
        const auto arrived = co_await link.read_some(end);
        if (!arrived && arrived.error().fault == Fault::link_timeout) break;
        if (!arrived) co_return tl::unexpected<Error>(arrived.error());
        spoke_ = true;
        const auto oversized = framer.feed(arrived->bytes, [&](std::string_view line) {
            take_line(line, arrived->read_at, *context.sink);
        });
        counters_.bad_frames += oversized;
    }
    co_return Result<void>{};
}

Task<Result<void>> Vaisala::prepare(ByteLink& link, InstrumentContext context, LineFramer& framer) {
    asked_at_.reset();
    requests_.forget();
    const auto commands = opening_commands(setup_);
    for (const std::string& text : commands) {
        const MonotonicTime end = context.scheduler->now() + talk;
        auto command = bytes_of(text);
        const auto written = co_await link.write_all(std::move(command), end + link_patience);
        if (!written) co_return written;
        const auto heard = co_await hear_until(link, context, framer, end);
        if (!heard) co_return heard;
    }
    co_return Result<void>{};
}

/// One request and what comes until the next is due; heard_ tells whether a reading did.
Task<Result<void>> Vaisala::ask(ByteLink& link, InstrumentContext context, LineFramer& framer) {
    const auto hear = [&](MonotonicTime end) { return hear_until(link, context, framer, end); };
    const auto late = co_await hear_late(requests_, *context.scheduler, setup_.poll_period, hear);
    if (!late) co_return late;
    heard_ = false;
    const MonotonicTime asked = context.scheduler->now();
    requests_.asked(asked);
    const MonotonicTime next = asked + setup_.poll_period;
    auto request = bytes_of(request_);
    const auto written = co_await link.write_all(std::move(request), next + link_patience);
    if (!written) co_return written;
    co_return co_await hear_until(link, context, framer, next);
}

/// How many requests were answered before three in a row were not. Where not a byte came since the
/// line was opened one is enough: an adapter that stalled must be opened anew.
Task<Result<int>>
Vaisala::ask_while_heard(ByteLink& link, InstrumentContext context, LineFramer& framer) {
    int answered = 0;
    for (int silent = 0; silent < (spoke_ ? silent_requests : 1);
         silent = heard_ ? 0 : silent + 1) {
        const auto asked = co_await ask(link, context, framer);
        if (!asked) co_return tl::unexpected<Error>(asked.error());
        if (heard_)
            ++answered;
        else
            ++counters_.timeouts;
    }
    co_return answered;
}

Task<Result<void>> Vaisala::run(InstrumentContext context) {
    auto opened =
        co_await context.links->open(setup_.link, context.scheduler->now() + link_patience);
    if (!opened) co_return tl::unexpected<Error>(opened.error());
    const std::unique_ptr<ByteLink> link = *std::move(opened);
    identified_ = spoke_ = false;
    LineFramer framer{longest_line};
    std::uint64_t wrong_before = 0;
    for (int answers = 1; answers > 0;) {
        const auto prepared = co_await prepare(*link, context, framer);
        if (!prepared) co_return prepared;
        wrong_before = counters_.checksum_errors;
        AXISCAL_CO_TRY(answers, co_await ask_while_heard(*link, context, framer));
    }
    if (counters_.checksum_errors > wrong_before)
        co_return fail(Fault::checksum,
                       "no right checksum on " + setup_.link.describe() +
                           ": the transmitter did not take FORM; try checksum = \"none\"");
    co_return fail(Fault::link_timeout, "no reading from the Vaisala on " + setup_.link.describe() +
                                            ": is it switched on, are its line settings these?");
}

VaisalaChecksum read_checksum(Settings& options) {
    const auto text = options.choice("checksum", {"CSX", "CS4", "none"}, "CSX");
    return text == "CSX"   ? VaisalaChecksum::csx
           : text == "CS4" ? VaisalaChecksum::cs4
                           : VaisalaChecksum::none;
}

} // namespace

const Appearance vaisala_appearance{
    Wire::serial, {}, true, "air", "model = \"ptu300\"               # or \"ptb330\"\n"};

std::unique_ptr<Instrument> make_vaisala(const InstrumentConfig& /*config*/, Settings& options) {
    LinkSettings defaults;
    defaults.baud = 4800;
    defaults.parity = 'E';
    defaults.data_bits = 7;
    VaisalaSetup setup;
    setup.pressure_only = options.choice("model", {"ptu300", "ptb330"}) == "ptb330";
    setup.link = read_link(options, defaults);
    setup.checksum = read_checksum(options);
    if (options.has("address"))
        setup.address = static_cast<int>(options.integer("address", 0, 255));
    setup.poll_period = options.duration("poll_period", std::chrono::milliseconds{200},
                                         std::chrono::seconds{60}, std::chrono::seconds{1});
    return std::make_unique<Vaisala>(std::move(setup));
}

} // namespace axiscal
