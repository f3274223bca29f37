// axiscal-publish: a process of its own, because a dead network share can hold one for ever, and a
// work of its own: with libsmbclient the program as a whole is under the GPL (LICENSES/).

#include "acquisition/runfile/folder_owner.hpp"
#include "acquisition/publish/folder_destination.hpp"
#include "acquisition/publish/publisher.hpp"
#include "acquisition/publish/publisher_report.hpp"
#include "acquisition/publish/upload_worker.hpp"
#include "acquisition/publish/smb/smb_destination.hpp"
#include "config/json_text.hpp"
#include "config/station_config.hpp"
#include "config/standard_streams.hpp"
#include "config/version.hpp"
#include "tools/describe/describe.hpp"

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
#include <memory>
#include <unistd.h>

namespace axiscal {
namespace {

enum ExitCode : int { exit_done = 0, exit_still_waiting = 1, exit_usage = 2, exit_refused = 3 };

constexpr std::chrono::milliseconds look_every{500}; // into the outbox

struct Options {
    std::string config, outbox;
    PublishConfig publish;
    double retry_s = 5, timeout_s = 10;
    bool once = false, json = false;
    std::FILE* json_lines = nullptr;
};

std::int64_t clock_ns(clockid_t clock) {
    timespec now{};
    ::clock_gettime(clock, &now);
    return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

sigset_t stop_signals() {
    sigset_t stop;
    ::sigemptyset(&stop);
    ::sigaddset(&stop, SIGTERM);
    ::sigaddset(&stop, SIGINT);
    return stop;
}

/// true: asked to stop within that time.
bool stopped_within(std::chrono::nanoseconds patience) {
    const sigset_t stop = stop_signals();
    const timespec wait{0, static_cast<long>(patience.count())};
    return ::sigtimedwait(&stop, nullptr, &wait) > 0;
}

/// Speaks to the log, to --json, and by the report beside the outbox.
class Speaker final : public PublisherListener {
public:
    Speaker(std::FILE* json, std::string outbox, std::string destination)
        : json_{json}
        , outbox_{std::move(outbox)} {
        report_.destination = std::move(destination);
    }
    void published(const PublishReceipt& receipt) override {
        spdlog::info("{}: published, {} files in {}, read back and equal", receipt.run_id,
                     receipt.files.size(), receipt.folder);
        auto line = nlohmann::json::parse(receipt_json(receipt));
        line["event"] = "published";
        print(line);
        be("publishing", "");
    }
    void waiting(const std::string& run_id, const Error& why) override {
        const std::string words = publishing_text(why);
        spdlog::warn("{}{}; tried again until it works", run_id.empty() ? "" : run_id + ": ",
                     words);
        print({{"event", "waiting"}, {"run_id", run_id}, {"reason", words}});
        be("waiting", run_id.empty() ? words : run_id + ": " + words);
    }
    void destination_back() override {
        spdlog::info("the destination takes results again");
        print({{"event", "destination_back"}});
    }
    void progress() override { ::sd_notify(0, "WATCHDOG=1"); }
    bool go_on() override {
        progress();
        stopped_ = stopped_ || stopped_within({});
        return !stopped_;
    }
    [[nodiscard]] bool stopped() const { return stopped_; }

    void be(const std::string& state, const std::string& reason) {
        if (state == report_.state && reason == report_.reason) return;
        report_.state = state;
        report_.reason = reason;
        report_.since_utc = iso8601_utc(clock_ns(CLOCK_REALTIME));
        if (const auto written = write_report(outbox_, report_); !written)
            spdlog::warn("{}", describe(written.error()));
    }

private:
    void print(const nlohmann::json& line) const {
        if (!json_) return;
        std::fputs((json_text(line) + "\n").c_str(), json_);
        std::fflush(json_);
    }
    std::FILE* json_; ///< null: not asked for
    bool stopped_ = false;
    std::string outbox_;
    PublisherReport report_;
};

/// The drivers' own keys stay unread here and are axiscald's to judge.
bool concerns_publishing(const Refusal& refusal) {
    return !refusal.key.starts_with("instrument");
}

int read_config(Options& options) {
    auto document = SettingsDocument::load(options.config);
    if (!document) {
        std::cerr << describe(document.error()) << '\n';
        return exit_refused;
    }
    StationConfig station = read_station(*document);
    for (KindSection& section : station.kind_sections)
        section.table.accept_rest(); // as the drivers' keys axiscald's to judge
    bool refused = false;
    for (const auto& refusal : document->finish()) {
        if (!concerns_publishing(refusal)) continue;
        std::cerr << refusal.describe() << '\n';
        refused = true;
    }
    options.outbox = station.state_directory + "/outbox";
    options.publish = station.publish;
    return refused ? exit_refused : exit_done;
}

Result<std::unique_ptr<Destination>> make_destination(const PublishConfig& config) {
    if (!is_share_address(config.destination))
        return std::make_unique<FolderDestination>(config.destination);
    AXISCAL_TRY(auto address, parse_share_address(config.destination));
    return std::make_unique<SmbDestination>(SmbSettings{std::move(address), config.credentials,
                                                        config.require_encryption, config.timeout});
}

void report_status(std::size_t waiting, std::size_t& last) {
    ::sd_notify(0, "WATCHDOG=1");
    if (waiting == last) return;
    last = waiting;
    ::sd_notifyf(0, "STATUS=%zu results wait in the outbox", waiting);
}

/// @returns how many still wait.
std::size_t watch_outbox(Publisher& publisher, Speaker& speaker, bool once) {
    std::size_t waiting = 0, last = std::string::npos;
    do {
        waiting = publisher.pass();
        if (waiting == 0) speaker.be("idle", "");
        report_status(waiting, last);
    } while (!once && !speaker.stopped() && !stopped_within(look_every));
    return waiting;
}

int serve(const Options& options) {
    auto destination = make_destination(options.publish);
    if (!destination) {
        std::cerr << describe(destination.error()) << '\n';
        return exit_usage;
    }
    const PublisherClock clock{[] { return monotonic_from_ns(clock_ns(CLOCK_MONOTONIC)); },
                               [] { return clock_ns(CLOCK_REALTIME); }};
    Speaker speaker{options.json_lines, options.outbox, (*destination)->place()};
    UploadWorker second{options.outbox, clock.utc_ns, **destination,
                      [&] { return make_destination(options.publish); }, speaker};
    const auto begin_second = [&](const std::vector<std::string>& run_ids) {
        speaker.be("publishing", ""); // before the fork: the report has one writer
        return second.begin(run_ids);
    };
    Publisher publisher{
        {options.outbox, options.publish.retry, begin_second}, clock, **destination, speaker};
    spdlog::info("publishing {} to {}", options.outbox, (*destination)->place());
    ::sd_notify(0, "READY=1");
    const std::size_t waiting = watch_outbox(publisher, speaker, options.once);
    ::sd_notify(0, "STOPPING=1");
    // Session and memory end with the process: taking them apart costs as much as two results.
    // A leak checker finds them here.
    [[maybe_unused]] static Destination* volatile left_to_the_system = nullptr;
    left_to_the_system = destination->release();
    return options.once && waiting > 0 ? exit_still_waiting : exit_done;
}

/// Without a destination results stay in the outbox; the service stays up and says so once.
int serve_nowhere(const Options& options) {
    spdlog::info("no destination: results stay in the outbox; set [publish] destination");
    Speaker{options.json_lines, options.outbox, ""}.be("nowhere", "");
    ::sd_notify(0, "READY=1\nSTATUS=no destination: results stay in the outbox");
    while (!options.once && !stopped_within(look_every))
        ::sd_notify(0, "WATCHDOG=1");
    return exit_done;
}

void describe_options(CLI::App& app, Options& options) {
    app.footer("Every file is copied under a temporary name, synced, read back, compared by "
               "SHA-256 and renamed;\nnothing is overwritten, and nothing leaves the outbox "
               "before its receipt.\n"
               "Exit: 0 done or stopped; 1 with --once: results still wait; 2 usage; 3 station "
               "file refused, or another publisher works on this outbox.");
    auto* config = app.add_option("--config", options.config,
                                  "station file; reads state_directory and [publish]");
    auto* outbox = app.add_option("--outbox", options.outbox, "folder of finished results");
    auto* to = app.add_option("--to", options.publish.destination,
                              "destination, which must exist: a folder or smb://server/share/path");
    auto* account =
        app.add_option("--credentials", options.publish.credentials,
                       "account of an smb:// share: file of mode 0600 with username=, password=");
    auto* retry = app.add_option("--retry", options.retry_s,
                                 "seconds to the first new attempt; doubles up to 16 times that");
    auto* timeout = app.add_option("--timeout", options.timeout_s,
                                   "seconds that an SMB server may take for one answer");
    retry->check(CLI::Range(0.01, 3600.0))->needs(outbox);
    timeout->check(CLI::Range(1.0, 60.0))->needs(outbox);
    account->needs(outbox);
    outbox->needs(to)->excludes(config);
    to->needs(outbox);
    app.add_flag("--once", options.once, "one attempt at everything, then exit");
    app.add_flag("--json", options.json, "one JSON object a line on stdout for every change");
}

/// stdout for --json alone: what libsmbclient prints there goes to the log.
std::FILE* own_stdout() {
    const int own = ::dup(STDOUT_FILENO);
    ::dup2(STDERR_FILENO, STDOUT_FILENO);
    return own < 0 ? nullptr : ::fdopen(own, "w");
}

std::string version_text() {
    return std::string{"axiscal-publish "} + software_version() + "\nWith " + smb_library_name() +
           " of the Samba project, and therefore as a whole under the GNU General Public License,\n"
           "version 3 or later: LICENSES/GPL-3.0-or-later.txt. Its own sources, as all others of "
           "axiscal, are under Apache-2.0: LICENSE.";
}

int run(int count, char** words) {
    CLI::App app{"Copies finished results from the outbox to a share.", "axiscal-publish"};
    Options options;
    describe_options(app, options);
    app.set_version_flag("--version", version_text());
    describe_on_request(app);
    try {
        app.parse(count, words);
        if (options.config.empty() && options.outbox.empty())
            throw CLI::RequiredError("--config FILE, or --outbox DIR --to DIR");
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? exit_done : exit_usage;
    }
    options.publish.retry = from_seconds(options.retry_s);
    options.publish.timeout = from_seconds(options.timeout_s);
    if (!options.config.empty())
        if (const int code = read_config(options); code != exit_done) return code;
    const sigset_t stop = stop_signals();
    ::pthread_sigmask(SIG_BLOCK, &stop, nullptr);
    if (options.json) options.json_lines = own_stdout();
    const auto owned = refuse_root_on_foreign(options.outbox, "axiscal-publish");
    const auto lock = owned ? lock_outbox(options.outbox) : tl::unexpected<Error>(owned.error());
    if (!lock) {
        std::cerr << describe(lock.error()) << '\n';
        return exit_refused;
    }
    return options.publish.destination.empty() ? serve_nowhere(options) : serve(options);
}

} // namespace
} // namespace axiscal

int main(int count, char** words) {
    axiscal::open_standard_streams();
    std::signal(SIGHUP, SIG_IGN); // a terminal that is shut ends no copy; nothing is read anew
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
