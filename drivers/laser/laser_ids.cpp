// attocube IDS3010: fibre interferometer with three axes, JSON-RPC over TCP port 9090.
//
// Document: the maker's repository attocube-systems/IDS-APIs (MATLAB and Python wrappers with their
// comments), state of 2024. Nothing here was seen on a real device yet.
//
// [request]  {"jsonrpc":"2.0","method":...,"params":[...],"id":n,"api":2}
// [reply]    {"jsonrpc":"2.0","result":[error number, values...],"id":n} CR LF, or an "error"
// member [length]   displacement.getAxisDisplacement [axis 0..2]: picometres, whole number
// [quality]  displacement.getAxisSignalQuality [axis]: contrast and baseline in permille
// [mode]     system.getCurrentMode []: "measurement running" and others; startMeasurement takes
//            many seconds and works from "system idle" only
// [air]      ecu.getRefractiveIndexCompensationMode [-1], ecu.getRefractiveIndexForCompensation
//            [-1], ecu.getConnected []; ecu.getTemperatureInDegrees, getPressureInHPa,
//            getHumidityInPercent. "Parameter has to be -1 for the moment".
// The ecu methods stand under com.attocube.ecu in the newer wrappers and under com.attocube.ids.ecu
// in older ones: the first is tried, then the other.
//
// A reading belongs to the middle between request and reply, with u(t) of what lies anywhere there.

#include "drivers/laser/laser_ids.hpp"

#include "config/settings.hpp"
#include "drivers/appearance.hpp"
#include "drivers/clock/placed_time.hpp"
#include "drivers/framing/line_framer.hpp"
#include "drivers/laser/ids_message.hpp"
#include "drivers/wire/link_settings.hpp"

#include <array>
#include <cmath>
#include <deque>
#include <utility>

namespace axiscal {
namespace {

constexpr std::size_t longest_line = 4096;
constexpr Duration link_patience = std::chrono::seconds{2};
constexpr std::string_view measuring = "measurement running";
constexpr Duration mode_period = std::chrono::seconds{1};
/// Quality of the signal and the environment unit change slowly.
constexpr Duration slow_period = std::chrono::seconds{1};
/// Somebody may switch the instrument's own correction by its web page during a run.
constexpr Duration air_period = std::chrono::seconds{10};
/// A reply may wander by this within one poll, beside the motion of the axis.
constexpr double jitter_m = 1e-6;
constexpr int no_parameter = -1000;
constexpr double metres_per_picometre = 1e-12;

enum IdsChannel : int {
    ids_displacement,
    ids_contrast,
    ids_temperature,
    ids_pressure,
    ids_humidity
};

struct EcuRow {
    IdsChannel channel;
    std::string_view method;
    double scale; ///< to the stored unit
};
constexpr std::array ecu_rows{EcuRow{ids_temperature, "getTemperatureInDegrees", 1},
                              EcuRow{ids_pressure, "getPressureInHPa", 100},
                              EcuRow{ids_humidity, "getHumidityInPercent", 1}};

struct IdsSetup {
    LinkSettings link;
    int axis = 1; ///< 1 to 3
    Length wavelength;
    Speed fastest;
    bool start = false;
    Duration poll_period{};
};

class Ids final : public Instrument {
public:
    explicit Ids(IdsSetup setup)
        : setup_{std::move(setup)}
        , channels_{{"axis " + std::to_string(setup_.axis), ChannelKind::displacement},
                    {"contrast", ChannelKind::strength},
                    {"air temperature", ChannelKind::temperature, Medium::air},
                    {"air pressure", ChannelKind::pressure, Medium::air},
                    {"air humidity", ChannelKind::humidity, Medium::air}} {}
    [[nodiscard]] const std::vector<Channel>& channels() const override { return channels_; }
    Task<Result<void>> run(InstrumentContext context) override;
    [[nodiscard]] const InstrumentCounters& counters() const override { return counters_; }
    [[nodiscard]] std::optional<Optics> optics() const override {
        return Optics{setup_.wavelength, 2};
    }

private:
    struct Timed {
        IdsReply reply;
        PlacedTime placed; ///< between request and reply
    };
    Task<Result<Timed>> ask(std::string method, int parameter = no_parameter);
    Task<Result<Timed>> ask_ecu(std::string method, int parameter = no_parameter);
    Task<Result<Timed>> await_reply(std::int64_t id, MonotonicTime sent);
    Task<Result<void>> introduce();
    Task<Result<void>> await_measurement();
    Task<Result<void>> check_mode();
    Task<Result<void>> check_air();
    Task<Result<void>> read_displacement();
    Task<Result<void>> read_quality();
    Task<Result<void>> read_environment();
    Task<Result<void>> measure();
    void take_displacement(const IdsReply& reply, const PlacedTime& placed);
    void judge_jump(double metres, MonotonicTime at);
    void lose_datum(Fault fault, std::string sentence);
    void hand_up(int channel, std::optional<double> value, const PlacedTime& placed);

    IdsSetup setup_;
    std::vector<Channel> channels_;
    InstrumentCounters counters_;
    std::uint32_t epoch_ = 0;
    // Of one connection:
    InstrumentContext context_{};
    std::unique_ptr<ByteLink> link_;
    std::optional<LineFramer> framer_;
    std::deque<std::string> lines_;
    std::string ecu_prefix_;
    std::int64_t last_id_ = 0, told_error_ = 0;
    bool unit_connected_ = false, datum_in_use_ = false, signal_lost_ = false;
    std::optional<double> last_metres_;
    MonotonicTime last_at_{};
};

void Ids::lose_datum(Fault fault, std::string sentence) {
    if (datum_in_use_) {
        ++epoch_;
        context_.sink->note(fault, std::move(sentence));
    }
    datum_in_use_ = false;
    last_metres_.reset();
}

void Ids::hand_up(int channel, std::optional<double> value, const PlacedTime& placed) {
    ++counters_.samples;
    context_.sink->take(sample_at(channel, placed, value));
}

/// Replies to requests that were given up come late; their numbers tell.
Task<Result<Ids::Timed>> Ids::await_reply(std::int64_t id, MonotonicTime sent) {
    MonotonicTime read_at = sent;
    for (;;) {
        while (!lines_.empty()) {
            const std::string line = std::exchange(lines_.front(), {});
            lines_.pop_front();
            if (line.empty()) continue;
            auto reply = parse_ids_reply(line);
            if (!reply && reply.error().fault == Fault::bad_frame) {
                ++counters_.bad_frames;
                continue;
            }
            if (!reply) co_return tl::unexpected<Error>(reply.error());
            ++counters_.frames;
            if (reply->id != id) continue;
            co_return Timed{*std::move(reply), placed_between(sent, read_at)};
        }
        const auto arrived = co_await link_->read_some(sent + link_patience);
        if (!arrived) {
            if (arrived.error().fault == Fault::link_timeout) ++counters_.timeouts;
            co_return tl::unexpected<Error>(arrived.error());
        }
        read_at = arrived->read_at;
        counters_.bad_frames += framer_->feed(
            arrived->bytes, [&](std::string_view line) { lines_.emplace_back(line); });
    }
}

Task<Result<Ids::Timed>> Ids::ask(std::string method, int parameter) {
    std::vector<int> parameters;
    if (parameter != no_parameter) parameters.push_back(parameter);
    const std::int64_t id = ++last_id_;
    const std::string request = ids_request(method, parameters, id);
    const auto raw = std::as_bytes(std::span{request});
    std::vector<std::byte> bytes{raw.begin(), raw.end()};
    const MonotonicTime sent = context_.scheduler->now();
    const auto written = co_await link_->write_all(std::move(bytes), sent + link_patience);
    if (!written) co_return tl::unexpected<Error>(written.error());
    auto reply = co_await await_reply(id, sent);
    co_return reply;
}

Task<Result<Ids::Timed>> Ids::ask_ecu(std::string method, int parameter) {
    auto reply = co_await ask(ecu_prefix_ + method, parameter);
    const bool unknown = !reply && reply.error().fault == Fault::refused;
    if (!unknown) co_return reply;
    ecu_prefix_ =
        ecu_prefix_ == "com.attocube.ecu." ? "com.attocube.ids.ecu." : "com.attocube.ecu.";
    reply = co_await ask(ecu_prefix_ + method, parameter);
    co_return reply;
}

/// A device that does not tell its serial number is believed the station file's.
Task<Result<void>> Ids::introduce() {
    const auto serial = co_await ask("com.attocube.system.getSerialNumber");
    if (!serial && serial.error().fault != Fault::refused)
        co_return tl::unexpected<Error>(serial.error());
    const auto firmware = co_await ask("com.attocube.system.getFirmwareVersion");
    if (!firmware && firmware.error().fault != Fault::refused)
        co_return tl::unexpected<Error>(firmware.error());
    context_.sink->identify(Identity{"attocube", "IDS3010",
                                     serial ? text_of(serial->reply, 0) : std::string{},
                                     firmware ? text_of(firmware->reply, 0) : std::string{}});
    co_return Result<void>{};
}

/// Until it measures there is no value; the mode is told when it changes.
Task<Result<void>> Ids::await_measurement() {
    std::string reported;
    bool started = false;
    for (;;) {
        const auto asked = co_await ask("com.attocube.ids.system.getCurrentMode");
        if (!asked) co_return tl::unexpected<Error>(asked.error());
        const std::string mode = text_of(asked->reply, 0);
        if (mode == measuring) co_return Result<void>{};
        context_.sink->take(
            Sample::bad(ids_displacement, asked->placed.at, Quality::absent, 0, epoch_));
        const bool idle = mode == "system idle";
        if (std::exchange(reported, mode) != mode)
            context_.sink->note(Fault::signal_error,
                                "the IDS does not measure: " + mode +
                                    (idle && !setup_.start ? "; start it by its web page, or state "
                                                             "start = \"by axiscal\""
                                                           : ""));
        if (idle && setup_.start && !std::exchange(started, true)) {
            const auto begun = co_await ask("com.attocube.ids.system.startMeasurement");
            if (!begun) co_return tl::unexpected<Error>(begun.error());
        }
        co_await context_.scheduler->sleep_for(mode_period);
    }
}

Task<Result<void>> Ids::check_mode() {
    const auto asked = co_await ask("com.attocube.ids.system.getCurrentMode");
    if (!asked) co_return tl::unexpected<Error>(asked.error());
    const std::string mode = text_of(asked->reply, 0);
    if (mode == measuring) co_return Result<void>{};
    co_return fail(Fault::signal_error, "the IDS stopped measuring: " + mode);
}

Task<Result<void>> Ids::check_air() {
    const auto mode = co_await ask_ecu("getRefractiveIndexCompensationMode", -1);
    if (!mode) co_return tl::unexpected<Error>(mode.error());
    const auto index = co_await ask_ecu("getRefractiveIndexForCompensation", -1);
    if (!index) co_return tl::unexpected<Error>(index.error());
    const auto connected = co_await ask_ecu("getConnected");
    if (!connected) co_return tl::unexpected<Error>(connected.error());
    unit_connected_ = whole_number_of(connected->reply, 0).value_or(0) != 0;
    const auto found_mode = whole_number_of(mode->reply, 0);
    const auto found_index = number_of(index->reply, 0);
    if (!found_mode || !found_index)
        co_return fail(Fault::bad_configuration,
                       "the IDS does not tell whether it corrects for air; without that nothing "
                       "can be measured by it");
    const IdsCompensation found{*found_mode, *found_index, unit_connected_};
    const std::string wrong = correction_of_its_own(found);
    if (!wrong.empty()) co_return fail(Fault::bad_configuration, wrong);
    co_return Result<void>{};
}

void Ids::judge_jump(double metres, MonotonicTime at) {
    if (last_metres_) {
        const double way_m = std::abs(metres - *last_metres_) - jitter_m;
        if (way_m > setup_.fastest.in(metre_per_second)*seconds_of(at - last_at_))
            lose_datum(Fault::implausible_jump,
                       "the reading jumped further than the axis can move: zeroed by another "
                       "program, or the beam was lost");
    }
    last_metres_ = metres;
    last_at_ = at;
}

void Ids::take_displacement(const IdsReply& reply, const PlacedTime& placed) {
    ++counters_.samples;
    const auto picometres = whole_number_of(reply, 0);
    if (reply.error_number != 0 || !picometres) {
        if (std::exchange(told_error_, reply.error_number) != reply.error_number)
            context_.sink->note(Fault::beam_lost, "the IDS reports error " +
                                                      std::to_string(reply.error_number) +
                                                      ": look at the beam");
        signal_lost_ = true;
        return context_.sink->take(
            Sample::bad(ids_displacement, placed.at, Quality::beam_lost, 0, epoch_));
    }
    told_error_ = 0;
    if (std::exchange(signal_lost_, false))
        lose_datum(Fault::datum_lost, "the signal is back, its zero is not");
    const double metres = static_cast<double>(*picometres) * metres_per_picometre;
    judge_jump(metres, placed.at);
    datum_in_use_ = true;
    Sample sample{ids_displacement, placed.at, metres, 0, epoch_};
    sample.time_uncertainty = placed.uncertainty;
    context_.sink->take(sample);
}

Task<Result<void>> Ids::read_displacement() {
    const auto reply =
        co_await ask("com.attocube.ids.displacement.getAxisDisplacement", setup_.axis - 1);
    if (!reply) co_return tl::unexpected<Error>(reply.error());
    take_displacement(reply->reply, reply->placed);
    co_return Result<void>{};
}

Task<Result<void>> Ids::read_quality() {
    const auto reply =
        co_await ask("com.attocube.ids.displacement.getAxisSignalQuality", setup_.axis - 1);
    if (!reply) co_return tl::unexpected<Error>(reply.error());
    const auto permille =
        reply->reply.error_number == 0 ? number_of(reply->reply, 0) : std::nullopt;
    hand_up(ids_contrast, permille ? std::optional{*permille / 10} : std::nullopt, reply->placed);
    co_return Result<void>{};
}

Task<Result<void>> Ids::read_environment() {
    for (const EcuRow& row : ecu_rows) {
        const auto reply = co_await ask_ecu(std::string{row.method});
        if (!reply) co_return tl::unexpected<Error>(reply.error());
        const auto value =
            reply->reply.error_number == 0 ? number_of(reply->reply, 0) : std::nullopt;
        hand_up(row.channel, value ? std::optional{*value * row.scale} : std::nullopt,
                reply->placed);
    }
    co_return Result<void>{};
}

/// What is asked seldom is due by the grid of the polls, half a poll beside it: by the moment of an
/// answer, a tape that is played could ask it one poll earlier than the recorder did.
Task<Result<void>> Ids::measure() {
    const Duration half = setup_.poll_period / 2;
    MonotonicTime next = context_.scheduler->now(), slow = next, air = next + air_period - half;
    for (;;) {
        auto done = co_await read_displacement();
        if (done && next >= slow) {
            slow = next + slow_period + half;
            done = co_await check_mode();
            if (done) done = co_await read_quality();
            if (done && unit_connected_) done = co_await read_environment();
        }
        if (done && next >= air) {
            air = next + air_period + half;
            done = co_await check_air();
        }
        if (!done) co_return done;
        next = std::max(next + setup_.poll_period, context_.scheduler->now());
        co_await context_.scheduler->sleep_until(next);
    }
}

Task<Result<void>> Ids::run(InstrumentContext context) {
    context_ = context;
    auto opened =
        co_await context.links->open(setup_.link, context.scheduler->now() + link_patience);
    if (!opened) co_return tl::unexpected<Error>(opened.error());
    link_ = *std::move(opened);
    framer_.emplace(longest_line);
    lines_.clear();
    ecu_prefix_ = "com.attocube.ecu.";
    told_error_ = 0;
    lose_datum(Fault::datum_lost, "the connection was lost, and perhaps the zero");
    auto done = co_await introduce();
    if (done) done = co_await check_air();
    if (done) done = co_await await_measurement();
    if (done) done = co_await measure();
    link_.reset();
    co_return done;
}

} // namespace

const Appearance ids_appearance{Wire::tcp, {}, false, "laser", ""};

std::unique_ptr<Instrument> make_ids(const InstrumentConfig& /*config*/, Settings& options) {
    IdsSetup setup;
    setup.link = read_link(options);
    if (setup.link.kind != LinkSettings::Kind::tcp && options.has("link"))
        options.refuse("link", "is a network connection: \"tcp:192.168.1.1:9090\"");
    setup.axis = static_cast<int>(options.integer("axis", 1, 3, 1));
    // Read to be refused with a reason: what the device has corrected cannot be told apart later.
    const auto air = options.choice("air", {"corrected here", "corrected by the device"});
    if (air == "corrected by the device")
        options.refuse("air", "cannot be evaluated here, where each reading is corrected by the "
                              "sensors beside the beam: set the index of the device to 1 by hand "
                              "(compensation mode 2) and write \"corrected here\"");
    setup.wavelength = options.length("wavelength", nm(400), nm(1600));
    setup.fastest =
        options.speed("fastest", mm_per_minute(1), metre_per_second(100), metre_per_second(1));
    setup.start = options.choice("start", {"by hand", "by axiscal"}, "by hand") == "by axiscal";
    setup.poll_period = options.duration("poll_period", std::chrono::milliseconds{2},
                                         std::chrono::seconds{10}, std::chrono::milliseconds{10});
    return std::make_unique<Ids>(std::move(setup));
}

} // namespace axiscal
