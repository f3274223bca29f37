#include "config/station_readers.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal {
namespace {

/// Corrections come from a certificate; beyond this one (in stored units: K, Pa, %, ppm) is a slip.
constexpr double largest_correction = 5000;
constexpr double largest_length_correction_m = 1e-3;

void refuse_a_slip(Settings& table, const ChannelCorrection& correction) {
    if (correction.stored_unit == "m" && std::abs(correction.amount) > largest_length_correction_m)
        table.refuse("correction", "is more than 1 mm: look at its unit");
}

std::optional<Medium> read_medium(Settings& channel) {
    if (!channel.has("medium")) return std::nullopt;
    const std::string medium = channel.choice("medium", {"air", "material"});
    if (channel.refused("medium")) return std::nullopt; // no part it plays can be judged by it
    return medium == "air" ? Medium::air : Medium::material;
}

/// [[instrument.channel.correction_at]]: one line of the certificate's table each.
void read_table(Settings& channel, ChannelConfig& config) {
    std::vector<CorrectionPoint>& points = config.calibration.corrections;
    for (Settings& line : channel.tables("correction_at")) {
        const ChannelCorrection reading = line.channel_reading("reading");
        const ChannelCorrection correction = line.correction("correction", largest_correction);
        refuse_a_slip(line, correction);
        if (line.refused("reading") || line.refused("correction")) continue;
        if (!line.has("correction"))
            line.refuse("correction", "is missing: write \"0 K\" for none");
        else if (reading.stored_unit != correction.stored_unit)
            line.refuse("correction", "has a unit that does not belong to the reading's");
        else if (!config.table_unit.empty() && config.table_unit != reading.stored_unit)
            line.refuse("reading", "has another unit than the line before");
        else if (!points.empty() && reading.amount <= points.back().reading)
            line.refuse("reading", "must be above that of the line before: sort the table");
        else if (!points.empty() && reading.amount + correction.amount <=
                                        points.back().reading + points.back().correction)
            line.refuse("correction", "makes a higher reading the lower value: look at the table");
        config.table_unit = reading.stored_unit;
        points.push_back({reading.amount, correction.amount});
    }
    if (!points.empty() && channel.has("correction"))
        channel.refuse("correction",
                       "is given together with a table of corrections: remove one of the two");
}

/// What the channel's own certificate states; the instrument's holds for what is left out.
void read_calibration(Settings& channel, ChannelConfig& config) {
    constexpr double least_k = 1, largest_k = 5, usual_k = 2;
    ChannelCalibration& stated = config.calibration;
    read_certificate_dates(channel, stated);
    const ChannelUncertainty expanded = channel.channel_uncertainty("uncertainty");
    if (expanded.amount == 0.0 || expanded.per_metre == 0.0)
        channel.refuse("uncertainty", "is 0: state the certificate's, or leave the line out");
    stated.expanded_uncertainty = expanded.amount;
    stated.expanded_uncertainty_per_m = expanded.per_metre;
    config.uncertainty_unit = expanded.stored_unit;
    stated.coverage = channel.number("k", least_k, largest_k, usual_k);
    if (channel.has("k") && !channel.has("uncertainty"))
        channel.refuse("k", "belongs to uncertainty: state that one too");
    read_table(channel, config);
}

ChannelConfig read_channel(Settings& channel) {
    ChannelConfig config;
    config.line = channel.line();
    config.channel = channel.text("channel");
    config.name = channel.text("name", config.channel);
    config.medium = read_medium(channel);
    config.place = channel.text("place", "");
    const ChannelCorrection correction = channel.correction("correction", largest_correction);
    refuse_a_slip(channel, correction);
    config.correction = correction.amount;
    config.correction_unit = correction.stored_unit;
    read_calibration(channel, config);
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

void read_tape_path(Settings& instrument, InstrumentConfig& config) {
    config.tape = instrument.text("tape", "");
    const bool relative = !config.tape.empty() && config.tape.front() != '/';
    if (relative)
        instrument.refuse("tape", "\"" + config.tape +
                                      "\" is no full path, and axiscald is started in a folder of "
                                      "its own: begin it with \"/\"");
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
        read_tape_path(table, instrument);
        read_certificate_dates(table, instrument);
        read_channels(table, instrument);
        check_name(table, instrument, config);
        config.instruments.push_back(std::move(instrument));
        config.instrument_options.push_back(table);
    }
    if (config.instruments.empty() && !root.refused("instrument"))
        root.refuse("instrument", "is missing: write one [[instrument]] for each instrument");
}

} // namespace axiscal
