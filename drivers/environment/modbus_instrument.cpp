// Modbus sensors by profile: air and material temperature, humidity, pressure; RTU and TCP.
//
// Document: Modbus Application Protocol Specification V1.1b3 (2012-04-26), "[6.3]" read holding
// registers, "[6.4]" read input registers. What the registers of one model hold stands, with its
// manual, in config/profiles/<model>.toml. The line is shared (drivers/wire/modbus_bus.hpp).

#include "drivers/environment/modbus_instrument.hpp"

#include "config/settings.hpp"
#include "drivers/appearance.hpp"
#include "drivers/clock/placed_time.hpp"
#include "drivers/environment/stated_settings.hpp"
#include "drivers/wire/arrival.hpp"
#include "drivers/wire/link_settings.hpp"
#include "drivers/wire/modbus_bus.hpp"

#include <algorithm>
#include <utility>

namespace axiscal {
namespace {

/// After so many rounds without any answer the instrument is given up and opened anew.
constexpr int silent_rounds = 3;

std::vector<Channel> channels_of(const ModbusProfile& profile) {
    std::vector<Channel> channels;
    for (const ModbusChannel& channel : profile.channels)
        channels.push_back(channel.channel);
    return channels;
}

/// The address of a register that this offset moves off the wire's 0 to 65535.
std::optional<int> register_outside(const ModbusProfile& profile, int offset) {
    const auto outside = [&](const ModbusField& field) {
        const int first = field.address + offset;
        return first < 0 || first + field.count > 65536;
    };
    for (const auto& fields : {channel_fields(profile), setting_fields(profile)})
        for (const ModbusField& field : fields)
            if (outside(field)) return field.address;
    if (profile.serial_number && outside(*profile.serial_number))
        return profile.serial_number->address;
    return std::nullopt;
}

class ModbusInstrument final : public Instrument {
public:
    ModbusInstrument(ModbusProfile profile, ModbusStation station)
        : profile_{std::move(profile)}
        , station_{std::move(station)}
        , channels_{channels_of(profile_)}
        , blocks_{register_blocks(channel_fields(profile_))}
        , settings_{profile_} {}
    [[nodiscard]] const std::vector<Channel>& channels() const override { return channels_; }
    Task<Result<void>> run(InstrumentContext context) override;
    [[nodiscard]] const InstrumentCounters& counters() const override { return counters_; }

private:
    [[nodiscard]] ModbusRead request(int function, int address, int count) const;
    Task<void> identify(ModbusBus& bus, SampleSink& sink);
    Task<Result<int>> round(ModbusBus& bus, InstrumentContext context);
    Task<bool> answers_for_values(ModbusBus& bus);
    [[nodiscard]] std::string place() const;
    Task<Result<bool>> check_settings(ModbusBus& bus, SampleSink& sink);
    void hand_up(const RegisterBlock& block, const ModbusWords& reply, SampleSink& sink);
    void hand_up_absent(const RegisterBlock& block, MonotonicTime at, SampleSink& sink);
    void count(Fault fault);

    ModbusProfile profile_;
    ModbusStation station_;
    std::vector<Channel> channels_;
    std::vector<RegisterBlock> blocks_;
    StatedSettings settings_;
    InstrumentCounters counters_;
    Error last_failure_;
    bool refusal_told_ = false;
};

ModbusRead ModbusInstrument::request(int function, int address, int count) const {
    ModbusRead read;
    read.unit_id = station_.unit_id;
    read.function = function;
    read.address = address + station_.address_offset;
    read.count = count;
    read.timeout = profile_.timeout;
    read.gap = profile_.gap;
    return read;
}

void ModbusInstrument::count(Fault fault) {
    switch (fault) {
    case Fault::link_timeout: ++counters_.timeouts; break;
    case Fault::checksum: ++counters_.checksum_errors; break;
    case Fault::bad_frame: ++counters_.bad_frames; break;
    default: break;
    }
}

/// A serial number that is none tells that the addresses are shifted by one.
Task<void> ModbusInstrument::identify(ModbusBus& bus, SampleSink& sink) {
    std::string serial;
    if (profile_.serial_number) {
        const ModbusField field = *profile_.serial_number;
        const ModbusRead read = request(field.function, field.address, field.count);
        const auto reply = co_await bus.read(read);
        const auto number = reply ? decode_words(reply->words, field) : std::nullopt;
        if (number && *number > 0)
            serial = std::to_string(static_cast<long long>(*number));
        else if (reply)
            sink.note(Fault::bad_configuration,
                      profile_.model + ": no serial number where the profile has it; try another "
                                       "address_offset (-1, 0 or 1)");
    }
    if (!serial.empty() && !station_.stated_serial.empty() && serial != station_.stated_serial)
        sink.note(Fault::bad_configuration,
                  profile_.model + ": the instrument's serial number is " + serial +
                      ", the station file states " + station_.stated_serial);
    sink.identify(Identity{profile_.maker, profile_.model, serial, ""});
}

void ModbusInstrument::hand_up(const RegisterBlock& block,
                               const ModbusWords& reply,
                               SampleSink& sink) {
    ++counters_.frames;
    const PlacedTime placed = placed_between(reply.asked_at, reply.read_at);
    for (const std::size_t place : block.places) {
        const ModbusChannel& channel = profile_.channels[place];
        const auto value = channel_value(words_of(block, reply.words, channel.field), channel);
        ++counters_.samples;
        sink.take(sample_at(static_cast<int>(place), placed,
                            settings_.spoils(place) ? std::nullopt : value));
    }
}

void ModbusInstrument::hand_up_absent(const RegisterBlock& block,
                                      MonotonicTime at,
                                      SampleSink& sink) {
    for (const std::size_t place : block.places)
        sink.take(Sample::bad(static_cast<int>(place), at, Quality::absent));
}

/// Whether all settings were read or refused: without them no value can be taken.
Task<Result<bool>> ModbusInstrument::check_settings(ModbusBus& bus, SampleSink& sink) {
    for (const RegisterBlock& block : settings_.blocks()) {
        const ModbusRead read = request(block.function, block.address, block.count);
        const auto reply = co_await bus.read(read);
        const Fault fault = reply ? Fault::none : reply.error().fault;
        count(fault);
        if (reply) ++counters_.frames;
        if (!reply && fault != Fault::refused) {
            last_failure_ = reply.error();
            if (fault == Fault::link_closed) co_return tl::unexpected<Error>(reply.error());
            co_return false;
        }
        const auto complaints = reply ? settings_.take(block, reply->words)
                                      : settings_.refuse(block, reply.error().detail);
        for (const std::string& text : complaints)
            sink.note(reply ? Fault::bad_configuration : Fault::refused, text);
    }
    co_return true;
}

/// The number of blocks that were answered, a Modbus exception being an answer.
Task<Result<int>> ModbusInstrument::round(ModbusBus& bus, InstrumentContext context) {
    int answered = 0;
    const auto checked = co_await check_settings(bus, *context.sink);
    if (!checked) {
        for (const RegisterBlock& block : blocks_)
            hand_up_absent(block, context.scheduler->now(), *context.sink);
        co_return tl::unexpected<Error>(checked.error());
    }
    if (!*checked) co_return 0;
    for (const RegisterBlock& block : blocks_) {
        const ModbusRead read = request(block.function, block.address, block.count);
        const auto reply = co_await bus.read(read);
        if (reply) {
            ++answered;
            hand_up(block, *reply, *context.sink);
            continue;
        }
        const Fault fault = reply.error().fault;
        count(fault);
        last_failure_ = reply.error();
        // A late or damaged answer says nothing about the sensor: its last value only grows old.
        if (fault != Fault::link_closed && fault != Fault::refused) continue;
        hand_up_absent(block, context.scheduler->now(), *context.sink);
        if (fault == Fault::link_closed) co_return tl::unexpected<Error>(reply.error());
        ++answered;
        if (!std::exchange(refusal_told_, true))
            context.sink->note(Fault::refused, reply.error().detail);
    }
    co_return answered;
}

/// Some look-alikes pass over what they do not know instead of refusing it.
Task<bool> ModbusInstrument::answers_for_values(ModbusBus& bus) {
    if (settings_.blocks().empty()) co_return false; // it was asked for values alone
    const RegisterBlock& block = blocks_.front();
    const ModbusRead read = request(block.function, block.address, block.count);
    const auto reply = co_await bus.read(read);
    co_return reply.has_value();
}

std::string ModbusInstrument::place() const {
    return profile_.model + " unit " + std::to_string(station_.unit_id) + " on " +
           station_.link.describe();
}

Task<Result<void>> ModbusInstrument::run(InstrumentContext context) {
    ModbusBuses* const buses = context.links->modbus_buses();
    if (!buses) co_return fail(Fault::link_closed, "no Modbus lines here");
    const auto bus = buses->bus(station_.link);
    if (!bus) co_return tl::unexpected<Error>(bus.error());
    refusal_told_ = false;
    settings_.forget();
    bool identified = false;
    int silent = 0;
    MonotonicTime next = context.scheduler->now();
    for (;;) {
        const auto answered = co_await round(**bus, context);
        if (!answered) { // the line is closed
            if (auto* listener = dynamic_cast<ClosedLineListener*>(context.links))
                listener->missed(station_.link);
            co_return tl::unexpected<Error>(answered.error());
        }
        silent = *answered > 0 ? 0 : silent + 1;
        if (silent == silent_rounds && last_failure_.fault != Fault::link_timeout)
            co_return tl::unexpected<Error>(last_failure_); // damaged, or another's
        if (silent == silent_rounds && co_await answers_for_values(**bus))
            co_return fail(Fault::link_timeout,
                           place() + " gives values and does not answer how it is set: another "
                                     "model? A copy of the profile without its [[setting]] blocks "
                                     "reads it; then look at its display");
        if (silent == silent_rounds)
            co_return fail(Fault::link_timeout, place() + " does not answer");
        if (*answered > 0 && !std::exchange(identified, true))
            co_await identify(**bus, *context.sink);
        // A slow line delays the next round instead of piling rounds up.
        next = std::max(next + station_.poll_period, context.scheduler->now());
        co_await context.scheduler->sleep_until(next);
    }
}

} // namespace

const Appearance modbus_appearance{Wire::serial,
                                   {},
                                   true,
                                   "material",
                                   "profile = \"tm-th8\"             # the sensor's: "
                                   "/usr/share/axiscal/profiles lists them; unit_id, "
                                   "where its address is another\n"};

std::unique_ptr<Instrument> make_modbus_instrument(ModbusProfile profile, ModbusStation station) {
    return std::make_unique<ModbusInstrument>(std::move(profile), std::move(station));
}

std::unique_ptr<Instrument> make_modbus(const InstrumentConfig& config, Settings& options) {
    const std::string name = options.text("profile");
    Result<ModbusProfile> profile = ModbusProfile{};
    if (!options.refused("profile")) {
        const auto path = find_profile(name, profile_folders());
        if (path)
            profile = load_profile(*path);
        else
            profile = tl::unexpected<Error>(path.error());
    }
    if (!profile) {
        options.refuse("profile", profile.error().detail);
        profile = ModbusProfile{};
    }
    ModbusStation station;
    station.link = read_link(options, profile->link);
    // Modbus over serial line V1.02, 2.2: 0 is everybody, 248 to 255 are reserved.
    const bool serial = station.link.kind == LinkSettings::Kind::serial;
    const int lowest = serial ? 1 : 0, highest = serial ? 247 : 255;
    station.unit_id =
        static_cast<int>(options.integer("unit_id", lowest, highest, profile->unit_id));
    if (station.unit_id < lowest || station.unit_id > highest)
        options.refuse("unit_id",
                       "of the profile is for TCP: a unit on a serial line has 1 to 247");
    station.address_offset =
        static_cast<int>(options.integer("address_offset", -1, 1, profile->address_offset));
    if (const auto outside = register_outside(*profile, station.address_offset))
        options.refuse("address_offset", "register " + std::to_string(*outside) +
                                             " of the profile would lie outside 0 to 65535");
    station.poll_period = options.duration("poll_period", std::chrono::milliseconds{20},
                                           std::chrono::seconds{600}, profile->poll_period);
    station.stated_serial = config.serial;
    return make_modbus_instrument(*std::move(profile), std::move(station));
}

} // namespace axiscal
