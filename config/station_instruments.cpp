#include "config/station_readers.hpp"

#include <algorithm>

namespace axiscal {
namespace {

/// Corrections come from a certificate; beyond this one (in stored units: K, Pa, %, ppm) is a slip.
constexpr double largest_correction = 5000;

std::optional<Medium> read_medium(Settings& channel) {
    if (!channel.has("medium")) return std::nullopt;
    const std::string medium = channel.choice("medium", {"air", "material"});
    return medium == "air" ? Medium::air : Medium::material;
}

ChannelConfig read_channel(Settings& channel) {
    ChannelConfig config;
    config.line = channel.line();
    config.channel = channel.text("channel");
    config.name = channel.text("name", config.channel);
    config.medium = read_medium(channel);
    config.place = channel.text("place", "");
    const ChannelCorrection correction = channel.correction("correction", largest_correction);
    config.correction = correction.amount;
    config.correction_unit = correction.stored_unit;
    return config;
}

void read_channels(Settings& instrument, InstrumentConfig& config) {
    for (Settings& table : instrument.tables("channel")) {
        ChannelConfig channel = read_channel(table);
        const bool twice =
            std::any_of(config.channels.begin(), config.channels.end(), [&](const auto& other) {
                return !channel.channel.empty() && other.channel == channel.channel;
            });
        if (twice)
            table.refuse("channel", "\"" + channel.channel + "\" is described twice: keep one");
        config.channels.push_back(std::move(channel));
    }
}

void check_name(Settings& instrument,
                const InstrumentConfig& config,
                const StationConfig& station) {
    if (instrument.refused("name")) return;
    if (config.name.empty() || config.name.find('/') != std::string::npos)
        instrument.refuse("name",
                          "\"" + config.name + "\" cannot be a name: use a word without \"/\"");
    for (const InstrumentConfig& other : station.instruments)
        if (other.name == config.name)
            instrument.refuse("name", "\"" + config.name +
                                          "\" is the name of the instrument in line " +
                                          std::to_string(other.line) + " too: give each its own");
}

} // namespace

void read_instruments(Settings root, StationConfig& config) {
    for (Settings& table : root.tables("instrument")) {
        InstrumentConfig instrument;
        instrument.line = table.line();
        instrument.name = table.text("name");
        instrument.driver = table.text("driver");
        instrument.serial = table.text("serial", "");
        instrument.certificate_number = table.text("certificate_number", "");
        instrument.calibrated_on = table.date("calibrated_on", "");
        instrument.due_on = table.date("due_on", "");
        if (!instrument.due_on.empty() && instrument.due_on < instrument.calibrated_on)
            table.refuse("due_on", "is before calibrated_on: exchange or correct the dates");
        read_channels(table, instrument);
        check_name(table, instrument, config);
        config.instruments.push_back(std::move(instrument));
        config.instrument_options.push_back(table);
    }
    if (config.instruments.empty() && !root.refused("instrument"))
        root.refuse("instrument", "is missing: write one [[instrument]] for each instrument");
}

} // namespace axiscal
