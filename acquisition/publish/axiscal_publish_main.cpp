// axiscal-publish: a process of its own, because a dead network share can hold one for ever.

#include "acquisition/publish/publisher.hpp"
#include "config/station_config.hpp"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <systemd/sd-daemon.h>

#include <csignal>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <iostream>

namespace axiscal {
namespace {

enum ExitCode : int { exit_done = 0, exit_still_waiting = 1, exit_usage = 2, exit_refused = 3 };

constexpr std::chrono::milliseconds look_every{500}; // into the outbox

struct Options {
    std::string config, outbox, destination;
    double retry_s = 5;
    bool once = false, json = false;
};

class Speaker final : public PublisherListener {
public:
    explicit Speaker(bool json)
        : json_{json} {}
    void published(const PublishReceipt& receipt) override {
        spdlog::info("{}: published, {} files in {}, read back and equal", receipt.run_id,
                     receipt.files.size(), receipt.folder);
        auto line = nlohmann::json::parse(receipt_json(receipt));
        line["event"] = "published";
        print(line);
    }
    void waiting(const std::string& run_id, const Error& why) override {
        const std::string words = describe(why);
        spdlog::warn("{}{}; tried again until it works", run_id.empty() ? "" : run_id + ": ",
                     words);
        print({{"event", "waiting"}, {"run_id", run_id}, {"reason", words}});
    }
    void destination_back() override {
        spdlog::info("the destination is there again");
        print({{"event", "destination_back"}});
    }
    void progress() override { ::sd_notify(0, "WATCHDOG=1"); }

private:
    void print(const nlohmann::json& line) const {
        using Handler = nlohmann::json::error_handler_t;
        if (json_) std::cout << line.dump(-1, ' ', false, Handler::replace) << std::endl;
    }
    bool json_;
};

std::int64_t clock_ns(clockid_t clock) {
    timespec now{};
    ::clock_gettime(clock, &now);
    return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

/// The drivers' own keys stay unread here and are axiscald's to judge.
bool concerns_publishing(const Refusal& refusal) {
    return !refusal.key.starts_with("instrument");
}

int read_config(const Options& options, PublisherSettings& settings) {
    auto document = SettingsDocument::load(options.config);
    if (!document) {
        std::cerr << describe(document.error()) << '\n';
        return exit_refused;
    }
    const StationConfig station = read_station(*document);
    bool refused = false;
    for (const auto& refusal : document->finish()) {
        if (!concerns_publishing(refusal)) continue;
        std::cerr << refusal.describe() << '\n';
        refused = true;
    }
    if (refused) return exit_refused;
    settings = {station.state_directory + "/outbox", station.publish.destination,
                station.publish.retry};
    return exit_done;
}

sigset_t block_stop_signals() {
    sigset_t stop;
    ::sigemptyset(&stop);
    ::sigaddset(&stop, SIGTERM);
    ::sigaddset(&stop, SIGINT);
    ::pthread_sigmask(SIG_BLOCK, &stop, nullptr);
    return stop;
}

/// true: asked to stop. Never waits longer than the outbox may stay unlooked at.
bool stopped_within_a_look(const sigset_t& stop) {
    const timespec wait{0, std::chrono::nanoseconds{look_every}.count()};
    return ::sigtimedwait(&stop, nullptr, &wait) > 0;
}

void report_status(std::size_t waiting, std::size_t& last) {
    ::sd_notify(0, "WATCHDOG=1");
    if (waiting == last) return;
    last = waiting;
    ::sd_notifyf(0, "STATUS=%zu results wait in the outbox", waiting);
}

int serve(const PublisherSettings& settings, const Options& options) {
    const sigset_t stop = block_stop_signals();
    Speaker speaker{options.json};
    Publisher publisher{settings, speaker};
    spdlog::info("publishing {} to {}", settings.outbox, settings.destination);
    ::sd_notify(0, "READY=1");
    std::size_t waiting = 0, last = std::string::npos;
    do {
        waiting =
            publisher.pass(monotonic_from_ns(clock_ns(CLOCK_MONOTONIC)), clock_ns(CLOCK_REALTIME));
        report_status(waiting, last);
    } while (!options.once && !stopped_within_a_look(stop));
    ::sd_notify(0, "STOPPING=1");
    return options.once && waiting > 0 ? exit_still_waiting : exit_done;
}

/// Without a destination results stay in the outbox; the service stays up and says so once.
int serve_nowhere(const Options& options) {
    const sigset_t stop = block_stop_signals();
    spdlog::info("no destination: results stay in the outbox; set [publish] destination");
    ::sd_notify(0, "READY=1\nSTATUS=no destination: results stay in the outbox");
    while (!options.once && !stopped_within_a_look(stop))
        ::sd_notify(0, "WATCHDOG=1");
    return exit_done;
}

void describe_options(CLI::App& app, Options& options) {
    app.footer("Every file is copied under a temporary name, synced, read back, compared by "
               "SHA-256 and renamed;\nnothing is overwritten, and nothing leaves the outbox "
               "before its receipt.\n"
               "Exit: 0 done or stopped; 1 with --once: results still wait; 2 usage; 3 station "
               "file refused.");
    auto* config = app.add_option("--config", options.config,
                                  "station file; reads state_directory and [publish]");
    auto* outbox = app.add_option("--outbox", options.outbox, "folder of finished results");
    auto* to = app.add_option("--to", options.destination, "destination folder; must exist");
    auto* retry = app.add_option("--retry", options.retry_s,
                                 "seconds to the first new attempt; doubles up to 16 times that");
    retry->check(CLI::Range(0.01, 3600.0))->needs(outbox);
    outbox->needs(to)->excludes(config);
    to->needs(outbox);
    app.add_flag("--once", options.once, "one attempt at everything, then exit");
    app.add_flag("--json", options.json, "one JSON object a line on stdout for every change");
}

int run(int count, char** words) {
    CLI::App app{"Copies finished results from the outbox to a share.", "axiscal-publish"};
    Options options;
    describe_options(app, options);
    app.set_version_flag("--version", AXISCAL_VERSION);
    try {
        app.parse(count, words);
        if (options.config.empty() && options.outbox.empty())
            throw CLI::RequiredError("--config FILE, or --outbox DIR --to DIR");
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? exit_done : exit_usage;
    }
    PublisherSettings settings{options.outbox, options.destination, from_seconds(options.retry_s)};
    if (!options.config.empty())
        if (const int code = read_config(options, settings); code != exit_done) return code;
    return settings.destination.empty() ? serve_nowhere(options) : serve(settings, options);
}

} // namespace
} // namespace axiscal

int main(int count, char** words) {
    // No time stamps: the service manager's journal has its own. stdout belongs to --json.
    spdlog::set_default_logger(spdlog::stderr_logger_st("axiscal-publish"));
    spdlog::set_pattern("%^%l%$: %v");
    try {
        return axiscal::run(count, words);
    } catch (const std::exception& error) {
        spdlog::critical("{}", error.what());
        return 70; // EX_SOFTWARE
    }
}
