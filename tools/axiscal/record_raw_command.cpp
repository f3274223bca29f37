// `axiscal record --raw`: listens to a wire whose instrument nobody knows yet.
#include "acquisition/runfile/durable_file.hpp"
#include "analysis/quantity/counted.hpp"
#include "config/json_text.hpp"
#include "drivers/loop/asio_scheduler.hpp"
#include "drivers/loop/spawn.hpp"
#include "drivers/recording/tape_recording.hpp"
#include "drivers/wire/link_opener.hpp"
#include "drivers/wire/link_settings.hpp"
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
#include <optional>
#include <sstream>
#include <unistd.h>

namespace axiscal {
namespace raw_recording {
namespace {

using Json = nlohmann::ordered_json;
using namespace std::chrono_literals;

class ListenedWire {
public:
    explicit ListenedWire(LinkSettings settings)
        : settings_{std::move(settings)} {}

    void listen(Duration span) {
        spawn(scheduler_, keep_listening());
        spawn(scheduler_, end_after(span));
        spawn(scheduler_, end_on_signal());
        loop_.run();
        if (!tape_.view().empty()) opener_.end();
    }
    [[nodiscard]] std::string transfers() const { return tape_.str(); }
    [[nodiscard]] std::string_view kind() const { return opener_.wire(); }
    /// Why no wire of these settings can ever be opened.
    [[nodiscard]] const std::optional<Error>& no_link() const { return no_link_; }

private:
    Task<void> keep_listening() {
        for (;;) {
            auto link = co_await opener_.open(settings_, scheduler_.now() + 2s);
            if (link) co_await read_to_the_end(**link);
            if (!link && link.error().fault == Fault::bad_configuration) {
                no_link_ = link.error();
                loop_.stop();
                co_return;
            }
            if (!link) tell(describe(link.error()));
            co_await scheduler_.sleep_for(1s);
        }
    }
    Task<void> read_to_the_end(ByteLink& link) {
        for (;;) {
            const auto bytes = co_await link.read_some(scheduler_.now() + 1s);
            if (!bytes && bytes.error().fault != Fault::link_timeout) co_return;
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
    void tell(std::string sentence) {
        if (sentence != told_) std::cerr << sentence << "\n";
        told_ = std::move(sentence);
    }

    LinkSettings settings_;
    std::ostringstream tape_;
    std::string told_;
    std::optional<Error> no_link_;
    boost::asio::io_context loop_{1};
    AsioScheduler scheduler_{loop_};
    RealLinkOpener links_{scheduler_};
    RecordingOpener opener_{scheduler_, links_, tape_};
};

/// "8N1", "7E2".
bool take_frame(const std::string& frame, LinkSettings& settings) {
    const bool right = frame.size() == 3 && frame[0] >= '5' && frame[0] <= '8' &&
                       std::string_view{"NEO"}.find(frame[1]) != std::string_view::npos &&
                       (frame[2] == '1' || frame[2] == '2');
    if (!right) return false;
    settings.data_bits = frame[0] - '0';
    settings.parity = frame[1];
    settings.stop_bits = frame[2] - '0';
    return true;
}

int raw_refused(const std::string& sentence, int code) {
    std::cerr << sentence << "\n";
    return code;
}

HeaderLines header_of(const RecordRequest& request, const ListenedWire& wire) {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    HeaderLines lines{{"who", request.who},
                      {"when", iso8601_utc(std::chrono::nanoseconds{now}.count())},
                      {"what", request.what},
                      {"origin", request.origin},
                      {"wire", std::string{wire.kind()}}};
    if (wire.kind() == "serial")
        lines.emplace_back("line", std::to_string(request.baud) + " " + request.frame);
    return lines;
}

int keep(const RecordRequest& request, const ListenedWire& wire, bool json) {
    const std::string transfers = wire.transfers();
    const auto count = std::ranges::count(transfers, '<');
    if (count == 0)
        return raw_refused(
            "nothing came from " + request.raw +
                ": is it the right line and speed (--baud), and is no other program on it? "
                "An instrument that answers only when it is asked says nothing here",
            exit_failed);
    const std::string text = header_text(header_of(request, wire)) + "\n" + transfers;
    if (const auto written = replace_synced(request.tape, text); !written)
        return raw_refused(describe(written.error()), exit_failed);
    if (json)
        std::cout << json_text(Json{{"tape", request.tape}, {"transfers", count}}) << "\n";
    else
        std::cout << request.tape << ": " << counted(count, "transfer")
                  << ". What it holds: axiscal tape check " << request.tape << "\n";
    return exit_ok;
}

} // namespace
} // namespace raw_recording

int command_record_raw(const RecordRequest& request, bool json) {
    using namespace raw_recording;
    if (std::filesystem::exists(request.tape))
        return raw_refused(request.tape + " is there already; a tape is never overwritten",
                           exit_usage);
    const std::filesystem::path folder = std::filesystem::absolute(request.tape).parent_path();
    if (::access(folder.c_str(), W_OK) != 0)
        return raw_refused("no file can be written into " + folder.string() +
                               ": it is not there, or yours to write",
                           exit_failed);
    LinkSettings defaults;
    defaults.baud = request.baud;
    if (!take_frame(request.frame, defaults))
        return raw_refused("--frame " + request.frame +
                               ": data bits, parity N, E or O, stop bits, as 8N1",
                           exit_usage);
    const auto settings = parse_link(request.raw, defaults);
    if (!settings) return raw_refused("--raw: " + describe(settings.error()), exit_usage);
    ListenedWire wire{*settings};
    wire.listen(
        std::chrono::duration_cast<Duration>(std::chrono::duration<double>{request.seconds}));
    if (wire.no_link()) return raw_refused("--raw: " + describe(*wire.no_link()), exit_usage);
    return keep(request, wire, json);
}

} // namespace axiscal
