// JUMO CANtrans T and other contact thermometers of the CANopen profile CiA 404.
//
// Documents: JUMO CANtrans T, operating instructions B 90.2910 (type 902910), cited as [jumo]; CiA
// 404 V1.2, measuring devices. Nothing here was seen on a real device yet.
//
// [jumo] delivered with 500 kbit/s and node number 125. TPDO1, five bytes: 0x9130 (32 bits, the low
//        byte first) and 0x6150 (bit 0 the sensor is faulty, 1 above, 2 below the range); sent by
//        event, or by time. A faulty sensor also sends emergency 0x5030 once a second. No heartbeat
//        until it is set. The second probe of a twin stands in TPDO5, which is off when delivered.
//
// What the PDOs hold, the number of digits and the unit are read from the device itself.

#include "drivers/environment/environment_canopen_404.hpp"

#include "config/settings.hpp"
#include "drivers/appearance.hpp"
#include "drivers/canopen/canopen_session.hpp"
#include "drivers/environment/cia404_input.hpp"
#include "drivers/wire/link_settings.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace axiscal {
namespace {

constexpr int jumo_node = 125, most_inputs = 8, most_digits = 9;

struct Cia404Setup {
    CanOpenSetup bus;
    int inputs = 1;
    std::optional<Cia404Unit> unit; ///< as the station file states it; empty: as the device tells
    std::optional<int> digits;      ///< the same
};

std::vector<Channel> channels_of(const Cia404Setup& setup) {
    std::vector<Channel> channels;
    channels.reserve(static_cast<std::size_t>(setup.inputs));
    for (int input = 1; input <= setup.inputs; ++input)
        channels.push_back(
            {"contact " + std::to_string(input), ChannelKind::temperature, Medium::none});
    return channels;
}

class CanOpen404 final : public Instrument {
public:
    explicit CanOpen404(Cia404Setup setup)
        : setup_{std::move(setup)}
        , channels_{channels_of(setup_)}
        , session_{setup_.bus, counters_} {}
    [[nodiscard]] const std::vector<Channel>& channels() const override { return channels_; }
    Task<Result<void>> run(InstrumentContext context) override;
    [[nodiscard]] const InstrumentCounters& counters() const override { return counters_; }

private:
    Task<Result<void>> serve(InstrumentContext context);
    Task<Result<void>> find_inputs();
    Task<Result<Cia404Unit>> read_unit(std::uint8_t sub);
    Task<Result<int>> read_digits(std::uint8_t sub);
    void take(const PdoArrival& arrival, SampleSink& sink);

    Cia404Setup setup_;
    std::vector<Channel> channels_;
    InstrumentCounters counters_;
    CanOpenSession session_;
    std::vector<Cia404Input> inputs_; ///< by channel
};

Task<Result<Cia404Unit>> CanOpen404::read_unit(std::uint8_t sub) {
    if (setup_.unit) co_return *setup_.unit;
    const ObjectKey key{cia404_unit_index, sub};
    const auto word = co_await session_.node().read_number(key);
    if (!word && word.error().fault != Fault::refused)
        co_return tl::unexpected<Error>(word.error());
    const auto unit = word ? cia404_unit(*word) : std::nullopt;
    if (!unit)
        co_return fail(Fault::bad_configuration,
                       session_.node().name() + " states no unit of temperature in " +
                           name_of(key) +
                           ": set unit = \"degC\", \"K\" or \"degF\" in the station file");
    co_return *unit;
}

Task<Result<int>> CanOpen404::read_digits(std::uint8_t sub) {
    if (setup_.digits) co_return *setup_.digits;
    const ObjectKey key{cia404_digits_index, sub};
    const auto digits = co_await session_.node().read_number(key);
    if (!digits && digits.error().fault != Fault::refused)
        co_return tl::unexpected<Error>(digits.error());
    if (!digits || *digits > most_digits)
        co_return fail(Fault::bad_configuration,
                       session_.node().name() + " states no number of digits in " + name_of(key) +
                           ": set digits = ... in the station file");
    co_return static_cast<int>(*digits);
}

Task<Result<void>> CanOpen404::find_inputs() {
    inputs_.clear();
    for (int channel = 1; channel <= setup_.inputs; ++channel) {
        AXISCAL_CO_TRY(Cia404Input input, find_cia404_input(session_.layouts(), channel));
        AXISCAL_CO_TRY(input.unit, co_await read_unit(input.value.sub));
        if (!input.is_float()) {
            AXISCAL_CO_TRY(input.digits, co_await read_digits(input.value.sub));
        }
        inputs_.push_back(input);
    }
    co_return Result<void>{};
}

/// Each channel that stands in this PDO.
void CanOpen404::take(const PdoArrival& arrival, SampleSink& sink) {
    using Why = Cia404Reading::Why;
    for (std::size_t at = 0; at < inputs_.size(); ++at) {
        const Cia404Input& input = inputs_[at];
        if (input.layout != arrival.layout) continue;
        auto reading = read_cia404_input(input, session_.layouts()[arrival.layout], arrival.frame);
        if (reading.why == Why::short_frame) {
            session_.take_short_frame();
            continue; // it says nothing about the sensor: the last value only grows old
        }
        // Also where the input has a status: that knows of its sensor, not of the device.
        if (arrival.in_error) reading.celsius.reset();
        ++counters_.samples;
        const int channel = static_cast<int>(at);
        Sample sample = reading.celsius ? Sample{channel, arrival.at, *reading.celsius}
                                        : Sample::bad(channel, arrival.at, Quality::absent);
        // A value is at most one measuring cycle old when it is sent; nobody tells the cycle.
        sample.time_uncertainty = setup_.bus.sample_period;
        sink.take(sample);
    }
}

Task<Result<void>> CanOpen404::serve(InstrumentContext context) {
    const auto opened = co_await session_.open(context);
    if (!opened) co_return opened;
    const auto found = co_await find_inputs();
    if (!found) co_return found;
    std::vector<std::size_t> used;
    for (const Cia404Input& input : inputs_)
        if (std::ranges::find(used, input.layout) == used.end()) used.push_back(input.layout);
    const auto started = co_await session_.start(std::move(used));
    if (!started) co_return started;
    for (;;) {
        AXISCAL_CO_TRY(const std::vector<PdoArrival> arrived, co_await session_.next());
        for (const PdoArrival& arrival : arrived)
            take(arrival, *context.sink);
    }
}

Task<Result<void>> CanOpen404::run(InstrumentContext context) {
    auto ended = co_await serve(context);
    session_.close();
    co_return ended;
}

std::optional<Cia404Unit> read_stated_unit(Settings& options) {
    const auto unit = options.choice("unit", {"as told", "degC", "K", "degF"}, "as told");
    if (unit == "degC") return Cia404Unit::in_celsius;
    if (unit == "K") return Cia404Unit::in_kelvin;
    if (unit == "degF") return Cia404Unit::in_fahrenheit;
    return std::nullopt;
}

} // namespace

const Appearance canopen_404_appearance{
    Wire::can,
    {},
    false,
    "material",
    "node = 125                     # its node number on the bus\n"};

std::unique_ptr<Instrument> make_canopen_404(const InstrumentConfig& /*config*/,
                                             Settings& options) {
    using namespace std::chrono_literals;
    Cia404Setup setup;
    setup.bus.link = read_can_link(options);
    setup.bus.node = static_cast<int>(options.integer("node", 1, 127, jumo_node));
    setup.bus.profile = cia404_profile;
    setup.bus.sample_period = options.duration("sample_period", 10ms, 60s, 500ms);
    setup.inputs = static_cast<int>(options.integer("inputs", 1, most_inputs, 1));
    setup.unit = read_stated_unit(options);
    const bool states_digits = options.has("digits");
    const auto digits = static_cast<int>(options.integer("digits", 0, most_digits, 0));
    if (states_digits) setup.digits = digits;
    return std::make_unique<CanOpen404>(std::move(setup));
}

} // namespace axiscal
