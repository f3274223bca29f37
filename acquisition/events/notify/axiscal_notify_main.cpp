// axiscal-notify: a process of its own, started while an event waits and ended when none does. TLS
// and the bytes of a foreign server stay out of the daemon, and so does their memory.

#include "acquisition/events/event_folder.hpp"
#include "acquisition/events/notify/http_post.hpp"
#include "acquisition/runfile/durable_file.hpp"
#include "acquisition/runfile/folder_owner.hpp"
#include "config/standard_streams.hpp"
#include "config/station_config.hpp"
#include "config/version.hpp"
#include "tools/describe/describe.hpp"

#include <CLI/CLI.hpp>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <csignal>
#include <ctime>
#include <fcntl.h>
#include <iostream>
#include <random>
#include <sys/file.h>

namespace axiscal {
namespace {

enum ExitCode : int { exit_done = 0, exit_still_waiting = 1, exit_usage = 2, exit_refused = 3 };

struct Options {
    std::string config;
    bool once = false;
};

struct NotifySettings {
    std::string state_directory;
    std::optional<WebhookConfig> webhook;
};

sigset_t end_signals() {
    sigset_t signals;
    ::sigemptyset(&signals);
    ::sigaddset(&signals, SIGTERM);
    ::sigaddset(&signals, SIGINT);
    return signals;
}

/// true: asked to end within that time. The wait counts no time that the computer sleeps.
bool ended_within(Duration patience) {
    const sigset_t signals = end_signals();
    constexpr Duration::rep second = 1'000'000'000;
    const timespec wait{static_cast<time_t>(patience.count() / second),
                        static_cast<long>(patience.count() % second)};
    return ::sigtimedwait(&signals, nullptr, &wait) > 0;
}

/// What instruments and kinds of test have in the file is axiscald's to judge.
Result<NotifySettings> read_settings(const std::string& file) {
    auto document = SettingsDocument::load(file);
    if (!document) return fail(Fault::bad_configuration, describe(document.error()));
    StationConfig station = read_station(*document);
    for (KindSection& section : station.kind_sections)
        section.table.accept_rest();
    for (const Refusal& refusal : document->finish())
        if (refusal.key.starts_with("webhook") || refusal.key.starts_with("station"))
            return fail(Fault::bad_configuration, refusal.describe());
    return NotifySettings{std::move(station.state_directory), std::move(station.webhook)};
}

/// One sender a folder. Held for the life of the process.
Result<FileHandle> hold_events(const std::string& state_directory) {
    const std::string path = state_directory + "/events/lock";
    FileHandle file{::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0640)};
    if (!file) return fail_io("cannot open", path);
    if (::flock(file.get(), LOCK_EX | LOCK_NB) != 0)
        return fail(Fault::busy, "another axiscal-notify works on " + state_directory);
    return file;
}

double chance_of_now() {
    static std::minstd_rand numbers{std::random_device{}()};
    return std::uniform_real_distribution<double>{0, 1}(numbers);
}

/// What changed since the pass before, so that a receiver that is away for days costs a line.
class Teller {
public:
    void tell(const EventDelivery& delivery, std::size_t waiting) {
        if (delivery.delivered() > told_)
            spdlog::info("{} delivered, {} wait", delivery.delivered() - told_, waiting);
        if (!delivery.trouble().empty() && delivery.trouble() != trouble_)
            spdlog::warn("{}; {} wait and are tried again", delivery.trouble(), waiting);
        told_ = delivery.delivered();
        trouble_ = delivery.trouble();
    }

private:
    std::size_t told_ = 0;
    std::string trouble_;
};

int deliver(const NotifySettings& settings, std::vector<WebhookKey> keys, bool once) {
    HttpPost post{*settings.webhook};
    bool ending = false;
    const auto go_on = [&] { return !(ending = ending || ended_within({})); };
    EventDelivery delivery{settings.state_directory,
                           std::move(keys),
                           {[&](const WebhookPost& one) { return post(one); },
                            [] { return std::int64_t{std::time(nullptr)}; }, chance_of_now, go_on}};
    Teller teller;
    if (const auto dropped = dropped_events(settings.state_directory); dropped > 0)
        spdlog::warn("{} events were dropped so far: more than {} waited", dropped,
                     most_waiting_events);
    for (;;) {
        const std::size_t waiting = delivery.pass();
        teller.tell(delivery, waiting);
        if (waiting == 0) return exit_done;
        if (once) return exit_still_waiting;
        if (delivery.trouble().empty() && go_on()) continue; // laid down meanwhile
        if (ending || ended_within(delivery.pause())) return exit_done;
    }
}

int complain_of(const Error& error) {
    std::cerr << "axiscal-notify: " << describe(error) << '\n';
    return exit_refused;
}

int serve(const Options& options) {
    const auto settings = read_settings(options.config);
    if (!settings) return complain_of(settings.error());
    if (!settings->webhook || waiting_events(settings->state_directory).empty()) return exit_done;
    const auto owned =
        refuse_root_on_foreign(settings->state_directory + "/events", "axiscal-notify");
    if (!owned) return complain_of(owned.error());
    auto keys = read_webhook_secret(settings->webhook->secret_file);
    if (!keys) {
        tell_event_trouble(settings->state_directory, describe(keys.error()));
        return complain_of(keys.error());
    }
    const auto held = hold_events(settings->state_directory);
    if (!held) return complain_of(held.error());
    return deliver(*settings, *std::move(keys), options.once);
}

int run(int count, char** words) {
    CLI::App app{"Tells a receiver of the web that a run is complete or that something is wrong.",
                 "axiscal-notify"};
    app.footer("One signed POST for each event that waits below <state>/events, tried again until "
               "the receiver has taken it.\nExit: 0 nothing waits any more, or stopped; 1 with "
               "--once: something waits; 2 usage; 3 station file or secret refused, or another "
               "axiscal-notify works there.");
    Options options;
    app.add_option("--config", options.config, "station file; reads state_directory and [webhook]")
        ->required();
    app.add_flag("--once", options.once, "one attempt at everything, then exit");
    app.set_version_flag("--version", std::string{"axiscal-notify "} + software_version());
    describe_on_request(app);
    try {
        app.parse(count, words);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? exit_done : exit_usage;
    }
    const sigset_t signals = end_signals();
    ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    return serve(options);
}

} // namespace
} // namespace axiscal

int main(int count, char** words) {
    axiscal::open_standard_streams();
    std::signal(SIGHUP, SIG_IGN);
    // No time stamps: the service manager's journal has its own.
    spdlog::set_default_logger(spdlog::stderr_logger_st("axiscal-notify"));
    spdlog::set_pattern("%^%l%$: %v");
    try {
        return axiscal::run(count, words);
    } catch (const std::exception& error) {
        spdlog::critical("{}", error.what());
        return 70; // EX_SOFTWARE
    }
}
