// The daemon: configuration refused before any device opens; loop, doors, watchdog, orderly end.
#include "acquisition/console/api_token.hpp"
#include "acquisition/console/http_server.hpp"
#include "acquisition/console/page_files.hpp"
#include "acquisition/daemon_log.hpp"
#include "acquisition/measurement/certificate_writer.hpp"
#include "acquisition/runfile/digest.hpp"
#include "acquisition/runfile/folder_owner.hpp"
#include "acquisition/runfile/signing_key.hpp"
#include "acquisition/station/station.hpp"
#include "acquisition/station/station_loader.hpp"
#include "acquisition/tls/tls_judgement.hpp"
#include "config/standard_streams.hpp"
#include "config/version.hpp"
#include "drivers/boot_id.hpp"
#include "drivers/loop/asio_scheduler.hpp"
#include "drivers/loop/service_manager.hpp"
#include "drivers/loop/spawn.hpp"
#include "drivers/trigger/trigger_ports.hpp"
#include "drivers/wire/link_opener.hpp"
#include "tools/describe/describe.hpp"

#include <CLI/CLI.hpp>
#include <boost/asio/as_tuple.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <spdlog/spdlog.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <memory>
#include <optional>
#include <sys/file.h>
#include <unistd.h>
#include <vector>

namespace axiscal {
namespace {

enum ExitCode : int { exit_ok = 0, exit_failed = 1, exit_usage = 2, exit_refused = 3 };

/// Only one daemon may own a state directory. The lock goes with the process, however it ends.
Result<int> lock_state(const std::string& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    AXISCAL_CHECK(refuse_root_on_foreign(folder, "axiscald"));
    const std::string path = folder + "/lock";
    const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0640);
    if (file < 0)
        return fail(Fault::io,
                    "cannot open " + path +
                        "; does station.state_directory exist and belong to this user?",
                    {errno, std::generic_category()});
    if (::flock(file, LOCK_EX | LOCK_NB) == 0) return file;
    ::close(file);
    return fail(Fault::busy,
                "another axiscald holds " + path + "; stop it first (systemctl stop axiscald)");
}

/// systemd's watchdog is fed by the loop itself: a loop that hangs is restarted. An idle station
/// wakes for nothing else, so three fifths of its time go by in between: of 10 s, 4 are to spare.
Task<void> feed_watchdog(Scheduler& scheduler) {
    const std::optional<Duration> limit = watchdog_limit();
    if (!limit) co_return;
    for (;;) {
        tell_service_manager("WATCHDOG=1");
        co_await scheduler.sleep_for(*limit / 5 * 3);
    }
}

struct Daemon {
    Daemon(LoadedStation loaded,
           std::unique_ptr<TriggerPort> port,
           std::string token,
           StationKey key)
        : station{scheduler, links, parts_of(std::move(loaded), std::move(port), std::move(key))}
        , console{scheduler, station, console_config, std::move(token), paired_file} {}

    StationParts parts_of(LoadedStation loaded, std::unique_ptr<TriggerPort> port, StationKey key) {
        StationParts parts;
        console_config = loaded.config.console;
        state_directory = loaded.config.state_directory;
        paired_file = state_directory + "/paired-browsers";
        parts.config_hash = sha256_hex(loaded.config.text);
        parts.config = std::move(loaded.config);
        parts.roles = std::move(loaded.roles);
        parts.instruments = std::move(loaded.instruments);
        parts.tapes = std::move(loaded.tapes);
        parts.port = std::move(port);
        parts.boot_id = read_boot_id();
        parts.key = std::move(key);
        parts.inhibit_program = "systemd-inhibit";
        parts.report_program = sibling_program("axiscal-report");
        return parts;
    }

    /// The socket is taken before any instrument: of two daemons the second touches nothing.
    Task<void> run() {
        Result<void> up = console.bind();
        const bool alone = up.has_value();
        if (up) up = co_await station.start();
        if (up) up = console.start();
        if (!up) {
            spdlog::critical("{}", describe(up.error()));
            code = exit_failed;
            if (alone) co_await station.stop(); // it may have taken an open run over
            loop.stop();
            co_return;
        }
        spdlog::info("ready");
        tell_service_manager("READY=1");
    }

    /// A terminal that is shut, or somebody who wants the file read anew, must not end a run; to
    /// systemd an end by SIGHUP would be in order, and nothing would start the daemon again.
    Task<void> pass_over_hang_ups() {
        boost::asio::signal_set signals{loop, SIGHUP};
        for (;;) {
            co_await signals.async_wait(boost::asio::as_tuple(boost::asio::use_awaitable));
            spdlog::info("SIGHUP is passed over: the station file is read at the start alone "
                         "(systemctl restart axiscald)");
        }
    }

    Task<void> end_on_signal() {
        boost::asio::signal_set signals{loop, SIGTERM, SIGINT};
        co_await signals.async_wait(boost::asio::as_tuple(boost::asio::use_awaitable));
        tell_service_manager("STOPPING=1");
        spdlog::info("stopping; an open run stays open and is continued at the next start");
        console.end_events(); // what is made durable now may take its time
        co_await station.stop();
        loop.stop();
    }

    int serve() {
        spawn(scheduler, end_on_signal());
        spawn(scheduler, pass_over_hang_ups());
        spawn(scheduler, run());
        spawn(scheduler, feed_watchdog(scheduler));
        try {
            loop.run();
        } catch (const std::exception& bug) { // told like all else: stderr may block
            spdlog::critical("{}", bug.what());
            code = exit_failed;
        }
        return code;
    }

    boost::asio::io_context loop{1};
    AsioScheduler scheduler{loop};
    RealLinkOpener links{scheduler};
    ConsoleConfig console_config;
    std::string paired_file, state_directory;
    Station station;
    HttpServer console;
    int code = exit_ok;
};

int tell_refusals(const std::vector<Refusal>& refusals) {
    for (const Refusal& refusal : refusals)
        std::fprintf(stderr, "%s\n", refusal.describe().c_str());
    return exit_refused;
}

std::int64_t now_utc_ns() {
    return std::chrono::nanoseconds{std::chrono::system_clock::now().time_since_epoch()}.count();
}

int run(int argc, char** argv) {
    CLI::App app{"axiscald: the axiscal calibration station. It reads the instruments, serves the "
                 "CNC's triggers and keeps every point on disk.",
                 "axiscald"};
    std::string config = "/etc/axiscal/station.toml";
    app.add_option("--config", config, "station file; 'axiscal check-config' reads it the same way")
        ->capture_default_str();
    app.set_version_flag("--version", software_version());
    describe_on_request(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? exit_ok : exit_usage;
    }
    const DaemonLog log; // to the very end: the last words of all else are written, too
    auto loaded = load_station(config);
    if (!loaded) return tell_refusals(loaded.error());
    const TlsJudgement tls = judge_tls(loaded->config, now_utc_ns());
    if (!tls.refusals.empty()) return tell_refusals(tls.refusals);
    for (const auto& warnings : {loaded->config.warnings, tls.notes})
        for (const Refusal& warning : warnings)
            spdlog::warn("{}", warning.describe());
    const Result<int> lock = lock_state(loaded->config.state_directory);
    auto token = lock ? load_or_make_token(loaded->config.state_directory + "/token")
                      : tl::unexpected<Error>(lock.error());
    auto key = token ? open_station_key(loaded->config.state_directory, read_machine_id())
                     : tl::unexpected<Error>(token.error());
    if (!key) {
        spdlog::critical("{}", describe(key.error()));
        return exit_failed;
    }
    auto port = make_trigger_port(loaded->config.trigger);
    Daemon daemon{*std::move(loaded), std::move(port), *std::move(token), *std::move(key)};
    if (auto page = PageFiles::read(page_folder()); page)
        daemon.console.show_page(*std::move(page));
    else
        spdlog::info("No page at the machine: {}.", describe(page.error()));
    daemon.console.show_runs(daemon.state_directory);
    return daemon.serve();
}

} // namespace
} // namespace axiscal

int main(int argc, char** argv) {
    axiscal::open_standard_streams();
    std::signal(SIGPIPE, SIG_IGN); // a client that left is an error code, not a death
    try {
        return axiscal::run(argc, argv);
    } catch (const std::exception& bug) {
        std::fprintf(stderr, "axiscald: %s\n", bug.what());
        return 1;
    }
}
