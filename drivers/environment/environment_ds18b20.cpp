// DS18B20 contact thermometers on a 1-Wire adapter that the Linux kernel knows (DS9490R by ds2490).
//
// Documents: Linux, Documentation/w1/slaves/w1_therm.rst, kernel 6.1; Maxim DS18B20 data sheet
// 19-7487 (scratchpad, power-on value); Maxim application note 27 (CRC). Nothing here was seen on a
// real device yet.
//
// [w1_slave]     two lines: nine bytes of the scratchpad, ": crc=hh YES" or "NO"; the bytes again,
//                "t=" and millidegrees. Reading it starts a conversion and takes up to 750 ms.
//                Empty where the kernel itself has read wrong checksums (5 times), since 5.8.
// [temperature]  millidegrees alone; empty while a conversion of all sensors is going on.
//
// Every reading blocks in the kernel: a thread of the link reads the files, the loop only awaits
// it.

#include "drivers/environment/environment_ds18b20.hpp"

#include "config/settings.hpp"
#include "drivers/appearance.hpp"
#include "drivers/environment/w1_text.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace axiscal {
namespace {

/// The kernel's driver works in milliseconds; a reading is up to 750 ms long.
constexpr Duration conversion_half = std::chrono::milliseconds{375};
/// So many readings in a row without a value are no single disturbance.
constexpr int worth_telling = 3;
constexpr Duration open_patience = std::chrono::seconds{2};
/// The kernel ends every reading by itself, and a real link waits for that; this bounds what waits
/// for a tape.
constexpr Duration reading_patience = std::chrono::seconds{10};

/// What stood in a file, and when it was asked for and there.
struct W1Reading {
    std::string text;
    MonotonicTime begun_at, read_at;
};

struct W1Setup {
    std::vector<std::string> sensors; ///< "28-0000075b3c2a"
    LinkSettings link;                ///< the folder of all sensors
    bool with_scratchpad = true;
    Duration poll_period{};
};

std::vector<Channel> channels_of(const W1Setup& setup) {
    std::vector<Channel> channels;
    channels.reserve(setup.sensors.size());
    for (std::size_t i = 0; i < setup.sensors.size(); ++i)
        channels.push_back(
            {"contact " + std::to_string(i + 1), ChannelKind::temperature, Medium::none});
    return channels;
}

class Ds18b20 final : public Instrument {
public:
    explicit Ds18b20(W1Setup setup)
        : setup_{std::move(setup)}
        , channels_{channels_of(setup_)}
        , unread_(channels_.size(), 0) {}
    [[nodiscard]] const std::vector<Channel>& channels() const override { return channels_; }
    Task<Result<void>> run(InstrumentContext context) override;
    [[nodiscard]] const InstrumentCounters& counters() const override { return counters_; }

private:
    Task<Result<int>> round(ByteLink& link, InstrumentContext context);
    Task<Result<W1Reading>> read(ByteLink& link, Scheduler& scheduler, std::size_t sensor);
    [[nodiscard]] std::string file_of(const std::string& sensor) const;
    std::optional<Error> take(std::size_t sensor, const W1Reading& file, SampleSink& sink);
    std::optional<Error> misread(std::size_t sensor, const Error& error);
    void count(Fault fault);

    W1Setup setup_;
    std::vector<Channel> channels_;
    std::vector<int> unread_; ///< readings in a row that gave no value, for each sensor
    InstrumentCounters counters_;
};

std::string Ds18b20::file_of(const std::string& sensor) const {
    return sensor + (setup_.with_scratchpad ? "/w1_slave" : "/temperature");
}

/// @errors Fault::not_found where the sensor is not; link_closed when the link is.
Task<Result<W1Reading>> Ds18b20::read(ByteLink& link, Scheduler& scheduler, std::size_t sensor) {
    W1Reading file;
    file.begun_at = scheduler.now();
    const MonotonicTime latest = file.begun_at + reading_patience;
    const std::string name = file_of(setup_.sensors[sensor]);
    const auto letters = std::as_bytes(std::span{name});
    std::vector<std::byte> bytes{letters.begin(), letters.end()};
    const auto asked = co_await link.write_all(std::move(bytes), latest);
    if (!asked) co_return tl::unexpected<Error>(asked.error());
    const auto answer = co_await link.read_some(latest);
    if (!answer) co_return tl::unexpected<Error>(answer.error());
    for (const std::byte letter : answer->bytes)
        file.text += std::to_integer<char>(letter);
    file.read_at = answer->read_at;
    co_return file;
}

void Ds18b20::count(Fault fault) {
    if (fault == Fault::checksum) ++counters_.checksum_errors;
    if (fault == Fault::bad_frame) ++counters_.bad_frames;
}

/// A damaged reading says nothing about the sensor: its last value only grows old. Told when it
/// lasts.
std::optional<Error> Ds18b20::misread(std::size_t sensor, const Error& error) {
    count(error.fault);
    if (++unread_[sensor] < worth_telling) return std::nullopt;
    return Error{error.fault, channels_[sensor].name + " was read wrongly " +
                                  std::to_string(worth_telling) +
                                  " times in a row: " + error.detail};
}

/// The value is that of a conversion between the beginning and the end of the reading.
/// @return why there is none, for people
std::optional<Error> Ds18b20::take(std::size_t sensor, const W1Reading& file, SampleSink& sink) {
    const int channel = static_cast<int>(sensor);
    const MonotonicTime at = file.begun_at + (file.read_at - file.begun_at) / 2;
    const auto value =
        setup_.with_scratchpad ? parse_w1_slave(file.text) : parse_w1_temperature(file.text);
    if (!value && value.error().fault != Fault::signal_error) return misread(sensor, value.error());
    unread_[sensor] = 0;
    if (!value) {
        sink.take(Sample::bad(channel, at, Quality::absent));
        return Error{Fault::signal_error, channels_[sensor].name + ": " + value.error().detail};
    }
    ++counters_.frames;
    ++counters_.samples;
    Sample sample{channel, at, *value};
    sample.time_uncertainty = conversion_half;
    sink.take(sample);
    return std::nullopt;
}

/// How many sensors there are. What is wrong with any is one note a round: while it stays the same,
/// it is one line in a log.
Task<Result<int>> Ds18b20::round(ByteLink& link, InstrumentContext context) {
    int present = 0;
    std::optional<Error> wrong;
    for (std::size_t i = 0; i < setup_.sensors.size(); ++i) {
        const auto file = co_await read(link, *context.scheduler, i);
        const bool ended = !file && (file.error().fault == Fault::link_closed ||
                                     file.error().fault == Fault::internal);
        if (ended) co_return tl::unexpected<Error>(file.error());
        std::optional<Error> this_one;
        if (file) {
            ++present;
            this_one = take(i, *file, *context.sink);
        } else {
            this_one = Error{file.error().fault,
                             "no sensor " + setup_.sensors[i] + ": " + describe(file.error())};
            context.sink->take(
                Sample::bad(static_cast<int>(i), context.scheduler->now(), Quality::absent));
        }
        if (wrong && this_one) wrong->detail += "; " + this_one->detail;
        if (!wrong) wrong = std::move(this_one);
    }
    if (present > 0 && wrong) context.sink->note(wrong->fault, std::move(wrong->detail));
    co_return present;
}

Task<Result<void>> Ds18b20::run(InstrumentContext context) {
    const MonotonicTime latest = context.scheduler->now() + open_patience;
    auto opened = co_await context.links->open(setup_.link, latest);
    if (!opened) co_return tl::unexpected<Error>(opened.error());
    const std::unique_ptr<ByteLink> link = *std::move(opened);
    std::string serials;
    for (const std::string& sensor : setup_.sensors)
        serials += (serials.empty() ? "" : " ") + sensor;
    context.sink->identify(Identity{"Maxim", "DS18B20", serials, ""});
    MonotonicTime next = context.scheduler->now();
    for (;;) {
        const auto present = co_await round(*link, context);
        if (!present) co_return tl::unexpected<Error>(present.error());
        if (*present == 0)
            co_return fail(Fault::link_closed, "none of the sensors is in " + setup_.link.path +
                                                   ": is the 1-Wire adapter plugged in, and are "
                                                   "ds2490 and w1_therm loaded?");
        next = std::max(next + setup_.poll_period, context.scheduler->now());
        co_await context.scheduler->sleep_until(next);
    }
}

/// Family in two hex digits, '-', serial number in twelve, as the kernel names its folders.
bool is_sensor_name(const std::string& name) {
    const auto hex = [](char letter) {
        return (letter >= '0' && letter <= '9') || (letter >= 'a' && letter <= 'f');
    };
    const bool family = name.starts_with("28-") || name.starts_with("22-") ||
                        name.starts_with("3b-") || name.starts_with("42-");
    return family && name.size() == 15 && std::all_of(name.begin() + 3, name.end(), hex);
}

void check_sensors(const std::vector<std::string>& sensors, Settings& options) {
    if (options.refused("sensors")) return;
    if (sensors.empty())
        options.refuse("sensors", "names no sensor: ls /sys/bus/w1/devices shows them");
    for (auto sensor = sensors.begin(); sensor != sensors.end(); ++sensor) {
        if (!is_sensor_name(*sensor))
            options.refuse("sensors", "\"" + *sensor +
                                          "\" is no name of a thermometer: write it as the kernel "
                                          "does, \"28-0000075b3c2a\"");
        if (std::find(sensors.begin(), sensor, *sensor) != sensor)
            options.refuse("sensors", "\"" + *sensor + "\" stands here twice");
    }
}

} // namespace

const Appearance ds18b20_appearance{Wire::one_wire, {}, false, "material", ""};

std::unique_ptr<Instrument> make_ds18b20(const InstrumentConfig& /*config*/, Settings& options) {
    W1Setup setup;
    setup.sensors = options.texts("sensors");
    check_sensors(setup.sensors, options);
    setup.with_scratchpad =
        options.choice("file", {"w1_slave", "temperature"}, "w1_slave") == "w1_slave";
    setup.link.kind = LinkSettings::Kind::files;
    setup.link.path = options.text("sysfs", "/sys/bus/w1/devices");
    setup.poll_period = options.duration("poll_period", std::chrono::milliseconds{100},
                                         std::chrono::seconds{60}, std::chrono::seconds{2});
    return std::make_unique<Ds18b20>(std::move(setup));
}

} // namespace axiscal
