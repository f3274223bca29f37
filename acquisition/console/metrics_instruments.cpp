#include "acquisition/console/metrics_instruments.hpp"

#include "acquisition/console/metrics_writer.hpp"
#include "config/settings.hpp"

#include <array>
#include <charconv>
#include <chrono>
#include <numbers>

namespace axiscal {
namespace {

constexpr std::array<std::string_view, 4> instrument_states{"unavailable", "available", "faulty",
                                                            "tape"};
constexpr std::array<std::string_view, 6> qualities{"good",      "stale",  "signal_error",
                                                    "beam_lost", "absent", "none"};

/// When a certificate has run out that is due on `date` ("2027-03-31"), which is itself still good:
/// the end of that day in UTC, in seconds since 1970. Empty where no date is stated.
std::optional<double> end_of_day_s(const std::string& date) {
    if (!is_calendar_date(date)) return std::nullopt;
    const auto part = [&date](std::size_t at, std::size_t length) {
        int number = 0;
        std::from_chars(date.data() + at, date.data() + at + length, number);
        return number;
    };
    const std::chrono::sys_days due{std::chrono::year{part(0, 4)} /
                                    std::chrono::month{static_cast<unsigned>(part(5, 2))} /
                                    std::chrono::day{static_cast<unsigned>(part(8, 2))}};
    const std::chrono::sys_seconds end = due + std::chrono::days{1};
    return static_cast<double>(end.time_since_epoch().count());
}

struct InstrumentFamily {
    std::string_view name, help;
    std::uint64_t InstrumentCounters::*count;
};
constexpr std::array instrument_families{
    InstrumentFamily{"axiscal_instrument_frames_total", "Frames of the instrument's protocol.",
                     &InstrumentCounters::frames},
    InstrumentFamily{"axiscal_instrument_samples_total", "Values that the instrument gave.",
                     &InstrumentCounters::samples},
    InstrumentFamily{"axiscal_instrument_bad_frames_total",
                     "Frames that were not the instrument's protocol.",
                     &InstrumentCounters::bad_frames},
    InstrumentFamily{"axiscal_instrument_checksum_errors_total", "Frames that arrived damaged.",
                     &InstrumentCounters::checksum_errors},
    InstrumentFamily{"axiscal_instrument_gaps_total", "Holes in the instrument's stream.",
                     &InstrumentCounters::gaps},
    InstrumentFamily{"axiscal_instrument_lost_records_total",
                     "Records that were sent and nobody got.", &InstrumentCounters::lost_records},
    InstrumentFamily{"axiscal_instrument_timeouts_total", "Questions without an answer in time.",
                     &InstrumentCounters::timeouts},
};

void write_instrument_facts(MetricsWriter& to, const std::vector<InstrumentView>& instruments) {
    to.family("axiscal_instrument_info", MetricType::gauge,
              "The driver of each instrument; always 1.");
    for (const InstrumentView& view : instruments)
        to.sample({{"instrument", view.name}, {"driver", view.driver}}, 1);
    to.family("axiscal_instrument_state", MetricType::gauge,
              "1 for the instrument's state, else 0.");
    for (const InstrumentView& view : instruments)
        to.states({{"instrument", view.name}}, "state", instrument_states, shown_state(view));
    to.family("axiscal_instrument_last_fault", MetricType::gauge,
              "1 for the fault that the instrument had last, which may be over; no line before.");
    for (const InstrumentView& view : instruments)
        if (view.last_fault != Fault::none)
            to.sample(
                {{"instrument", view.name}, {"fault", std::string{fault_name(view.last_fault)}}},
                1);
    to.family("axiscal_instrument_certificate_expiry_timestamp_seconds", MetricType::gauge,
              "End of the day (UTC) on which the instrument's certificate is due.");
    for (const InstrumentView& view : instruments)
        to.sample({{"instrument", view.name}}, end_of_day_s(view.due_on));
}

struct KindFamily {
    ChannelKind kind;
    std::string_view name, help;
    double units; ///< of stored_unit_of(kind), in one base unit
};
constexpr std::array kind_families{
    KindFamily{ChannelKind::displacement, "axiscal_channel_displacement_metres",
               "Bare displacement; of an interferometer in vacuum wavelengths.", 1},
    KindFamily{ChannelKind::temperature, "axiscal_channel_temperature_celsius", "Temperature.", 1},
    KindFamily{ChannelKind::pressure, "axiscal_channel_pressure_pascals", "Pressure.", 1},
    KindFamily{ChannelKind::humidity, "axiscal_channel_humidity_ratio", "Relative humidity.", 100},
    KindFamily{ChannelKind::carbon_dioxide, "axiscal_channel_carbon_dioxide_ratio",
               "Carbon dioxide as part of the air.", 1e6},
    KindFamily{ChannelKind::strength, "axiscal_channel_strength_ratio",
               "Strength of the returning beam.", 100},
    KindFamily{ChannelKind::angle, "axiscal_channel_angle_radians", "Angle of an autocollimator.",
               648000 / std::numbers::pi},
};

MetricLabels labels_of(const ChannelView& channel) {
    return {{"instrument", channel.instrument}, {"channel", channel.channel}};
}

void write_channel_facts(MetricsWriter& to, const std::vector<ChannelView>& channels) {
    to.family("axiscal_channel_info", MetricType::gauge,
              "What each channel is, and where; always 1.");
    for (const ChannelView& channel : channels) {
        MetricLabels labels = labels_of(channel);
        labels.push_back({"name", channel.name});
        labels.push_back({"place", channel.place});
        labels.push_back({"role", channel.role});
        to.sample(labels, 1);
    }
    to.family("axiscal_channel_quality", MetricType::gauge,
              "1 for the quality of the last value, else 0.");
    for (const ChannelView& channel : channels)
        to.states(labels_of(channel), "quality", qualities, channel.quality);
    to.family("axiscal_channel_age_seconds", MetricType::gauge,
              "Age of the channel's last value, good or not; no line before the first.");
    for (const ChannelView& channel : channels)
        to.sample(labels_of(channel), channel.age_s);
    to.family("axiscal_channel_certificate_expiry_timestamp_seconds", MetricType::gauge,
              "End of the day (UTC) on which the channel's own certificate is due.");
    for (const ChannelView& channel : channels)
        to.sample(labels_of(channel), end_of_day_s(channel.due_on));
}

} // namespace

void write_metrics_of(const std::vector<InstrumentView>& instruments, MetricsWriter& to) {
    write_instrument_facts(to, instruments);
    to.family("axiscal_instrument_restarts_total", MetricType::counter,
              "How often the connection to the instrument was begun anew.");
    for (const InstrumentView& view : instruments)
        to.sample({{"instrument", view.name}}, static_cast<double>(view.restarts));
    for (const InstrumentFamily& family : instrument_families) {
        to.family(family.name, MetricType::counter, family.help);
        for (const InstrumentView& view : instruments)
            to.sample({{"instrument", view.name}},
                      static_cast<double>(view.counters.*family.count));
    }
}

void write_metrics_of(const std::vector<ChannelView>& channels, MetricsWriter& to) {
    write_channel_facts(to, channels);
    for (const KindFamily& family : kind_families) {
        to.family(family.name, MetricType::gauge, family.help);
        for (const ChannelView& channel : channels)
            if (channel.kind == family.kind && channel.value)
                to.sample(labels_of(channel), *channel.value / family.units);
    }
}

} // namespace axiscal
