// `axiscal record`: the daemon's driver and link, with a recorder between.
#include "acquisition/runfile/durable_file.hpp"
#include "acquisition/station/station_loader.hpp"
#include "analysis/quantity/counted.hpp"
#include "config/json_text.hpp"
#include "drivers/loop/asio_scheduler.hpp"
#include "drivers/loop/spawn.hpp"
#include "drivers/recording/tape_recording.hpp"
#include "drivers/registry.hpp"
#include "drivers/wire/link_opener.hpp"
#include "tools/axiscal/exit_code.hpp"
#include "tools/axiscal/tape/tape_header.hpp"
#include "tools/axiscal/tape_commands.hpp"

#include <nlohmann/json.hpp>

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/use_awaitable.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <map>
#include <sstream>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

constexpr Duration before_again = std::chrono::seconds{1};

/// What the instrument says while it is recorded.
class Listener final : public SampleSink {
public:
    explicit Listener(std::vector<Channel> channels)
        : channels_{std::move(channels)} {}
    void take(const Sample& sample) override {
        const auto value = sample.value();
        if (!value) return;
        ++samples;
        last[channels_[static_cast<std::size_t>(sample.channel)].name] = *value;
    }
    void identify(const Identity& who) override { identity = who; }
    void note(Fault /*fault*/, std::string sentence) override {
        if (sentence != last_note) std::cerr << sentence << "\n";
        last_note = std::move(sentence);
    }

    Identity identity;
    std::uint64_t samples = 0;
    std::map<std::string, double> last; ///< by channel, in its stored unit
    std::string last_note;

private:
    std::vector<Channel> channels_;
};

class Recording {
public:
    explicit Recording(std::unique_ptr<Instrument> instrument)
        : listener{instrument->channels()}
        , instrument_{std::move(instrument)} {}

    void run(Duration span) {
        spawn(scheduler_, keep_running());
        spawn(scheduler_, end_after(span));
        spawn(scheduler_, end_on_signal());
        loop_.run();
        if (!tape_.view().empty()) opener_.end();
    }
    [[nodiscard]] std::string transfers() const { return tape_.str(); }
    [[nodiscard]] std::string_view wire() const { return opener_.wire(); }

private:
    Task<void> keep_running() {
        for (;;) {
            const InstrumentContext context{&scheduler_, &opener_, &listener};
            const auto ended = co_await instrument_->run(context);
            if (!ended) listener.note(ended.error().fault, describe(ended.error()));
            co_await scheduler_.sleep_for(before_again);
        }
    }
    Task<void> end_after(Duration span) {
        co_await scheduler_.sleep_for(span);
        loop_.stop();
    }
    Task<void> end_on_signal() {
        boost::asio::signal_set signals{loop_, SIGTERM, SIGINT};
        co_await signals.async_wait(boost::asio::as_tuple(boost::asio::use_awaitable));
        loop_.stop();
    }

    std::ostringstream tape_;
    boost::asio::io_context loop_{1};
    AsioScheduler scheduler_{loop_};
    RealLinkOpener links_{scheduler_};
    RecordingOpener opener_{scheduler_, links_, tape_};

public:
    Listener listener;

private:
    std::unique_ptr<Instrument> instrument_;
};

std::string now_utc() {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return iso8601_utc(std::chrono::nanoseconds{now}.count());
}

HeaderLines header_of(const RecordRequest& request,
                      const Recording& recording,
                      const StationConfig& config,
                      const std::string& driver) {
    const Identity& identity = recording.listener.identity;
    HeaderLines lines{{"maker", identity.maker},
                      {"model", identity.model},
                      {"serial", identity.serial},
                      {"firmware", identity.firmware},
                      {"who", request.who},
                      {"when", now_utc()},
                      {"what", request.what},
                      {"origin", request.origin},
                      {"wire", std::string{recording.wire()}},
                      {"driver", driver}};
    for (auto& line : driver_keys(config.text, request.instrument))
        lines.push_back(std::move(line));
    return lines;
}

int refused(const std::string& sentence, int code) {
    std::cerr << sentence << "\n";
    return code;
}

std::string names_of(const StationConfig& config) {
    std::string names;
    for (const InstrumentConfig& instrument : config.instruments)
        names += (names.empty() ? "" : ", ") + instrument.name;
    return names;
}

/// Of a driver that opens its line itself the tape is played on a wire, not into the driver.
std::string
how_to_try(const std::string& tape, const std::string& driver_name, std::string_view wire) {
    const auto driver = find_driver(driver_name);
    if (!driver || (*driver)->no_tape.empty()) return "axiscal replay --print " + tape;
    const bool by_network = wire.find("tcp") != std::string_view::npos;
    return "axiscal replay " + tape + (by_network ? " --port 1502" : " --link /tmp/wire") +
           ", with link = " + (by_network ? "\"tcp:127.0.0.1:1502\"" : "\"serial:/tmp/wire\"") +
           " in a station file";
}

int keep(const RecordRequest& request,
         const Recording& recording,
         const StationConfig& config,
         const std::string& driver,
         bool json) {
    const std::string transfers = recording.transfers();
    if (transfers.empty())
        return refused("nothing passed over the wire of \"" + request.instrument +
                           "\": is it plugged in, and is axiscald stopped (sudo systemctl stop "
                           "axiscald)?",
                       exit_failed);
    const auto written =
        replace_synced(request.tape, header_text(header_of(request, recording, config, driver)) +
                                         "\n" + transfers);
    if (!written) return refused(describe(written.error()), exit_failed);
    const auto count = std::ranges::count(transfers, '\n');
    const Listener& listener = recording.listener;
    if (json)
        std::cout << json_text(Json{{"tape", request.tape},
                                    {"transfers", count},
                                    {"samples", listener.samples},
                                    {"last", listener.last}})
                  << "\n";
    else
        std::cout << request.tape << ": " << counted(count, "transfer") << ", "
                  << counted(static_cast<long>(listener.samples), "sample") << " of "
                  << listener.identity.model
                  << ". Try it: " << how_to_try(request.tape, driver, recording.wire()) << "\n";
    return exit_ok;
}

} // namespace

int command_record(const RecordRequest& request, bool json) {
    if (std::filesystem::exists(request.tape))
        return refused(request.tape + " is there already; a tape is never overwritten", exit_usage);
    auto station = load_station(request.station_file);
    if (!station) {
        for (const Refusal& refusal : station.error())
            std::cerr << refusal.describe() << "\n";
        return exit_refused;
    }
    const auto& configs = station->config.instruments;
    const auto found = std::ranges::find(configs, request.instrument, &InstrumentConfig::name);
    if (found == configs.end())
        return refused("the station has no instrument \"" + request.instrument + "\"; it has " +
                           names_of(station->config),
                       exit_refused);
    if (!found->tape.empty())
        return refused(
            "\"" + found->name + "\" is the tape " + found->tape +
                " itself: take the line `tape` out of its block to record the instrument",
            exit_refused);
    const auto seat = static_cast<std::size_t>(found - configs.begin());
    Recording recording{std::move(station->instruments[seat])};
    recording.run(
        std::chrono::duration_cast<Duration>(std::chrono::duration<double>{request.seconds}));
    return keep(request, recording, station->config, found->driver, json);
}

} // namespace axiscal
