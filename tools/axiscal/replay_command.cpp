// `axiscal replay`: a tape on a wire for another program, or through its driver in virtual time.
#include "acquisition/runfile/durable_file.hpp"
#include "config/json_text.hpp"
#include "drivers/loop/asio_scheduler.hpp"
#include "drivers/loop/spawn.hpp"
#include "drivers/loop/virtual_scheduler.hpp"
#include "drivers/recording/tape_wire.hpp"
#include "tools/axiscal/exit_code.hpp"
#include "tools/axiscal/tape/sample_lines.hpp"
#include "tools/axiscal/tape/tape_header.hpp"
#include "tools/axiscal/tape_commands.hpp"

#include <nlohmann/json.hpp>

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/use_awaitable.hpp>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

constexpr Duration after_the_end = std::chrono::minutes{1}; // of virtual time: what is still due

int refused(const Error& error, int code) {
    std::cerr << describe(error) << "\n";
    return code;
}

Result<std::string> text_of(const std::string& path) {
    std::ifstream file{path, std::ios::binary};
    std::string text{std::istreambuf_iterator<char>{file}, {}};
    if (!file) return fail(Fault::io, "cannot read " + path);
    return text;
}

Result<Tape> read_tape(const std::string& path) {
    AXISCAL_TRY(const std::string text, text_of(path));
    return parse_tape(text);
}

/// What a supervisor does without its patience: opens again at once until the tape is at its end.
Task<void> run_to_the_end(Instrument& instrument,
                          InstrumentContext context,
                          const TapePlayer& player,
                          SampleLines& lines) {
    while (!player.at_end()) {
        const auto ended = co_await instrument.run(context);
        lines.ended(ended.error().fault);
        if (ended.error().fault == Fault::internal) co_return; // it would write the same again
    }
}

/// Its line is shared with other instruments: no tape is put under it.
bool is_modbus(const Tape& tape) {
    const auto driver = tape.header.find("driver");
    return driver != tape.header.end() && driver->second == "modbus";
}

Result<std::string> driver_says(const Tape& tape) {
    if (is_modbus(tape))
        return fail(Fault::bad_request,
                    "a Modbus sensor is read on a wire only: play its tape to the daemon, with "
                    "axiscal replay --link PATH (RTU) or --port N (TCP)");
    AXISCAL_TRY(const auto instrument, instrument_of(tape));
    VirtualScheduler scheduler;
    TapePlayer player{scheduler, tape};
    SampleLines lines{scheduler.now(), instrument->channels()};
    const InstrumentContext context{&scheduler, &player, &lines};
    spawn(scheduler, run_to_the_end(*instrument, context, player, lines));
    const Duration length = tape.entries.empty() ? Duration{} : tape.entries.back().offset;
    scheduler.run_for(length + after_the_end);
    lines.count(instrument->counters());
    return lines.text();
}

/// The first line in which they differ.
int compare(const std::string& said, const std::string& expected, const std::string& name) {
    if (said == expected) return exit_ok;
    std::istringstream ours{said}, theirs{expected};
    std::string is, should;
    for (int line = 1;; ++line) {
        const bool more = static_cast<bool>(std::getline(ours, is));
        const bool wanted = static_cast<bool>(std::getline(theirs, should));
        if (more && wanted && is == should) continue;
        std::cerr << name << ":" << line << ": expected \"" << (wanted ? should : "(the end)")
                  << "\", the driver says \"" << (more ? is : "(the end)") << "\"\n";
        return exit_disagrees;
    }
}

int through_the_driver(const ReplayRequest& request, const Tape& tape) {
    const auto said = driver_says(tape);
    if (!said) return refused(said.error(), exit_refused);
    if (request.print) std::cout << *said;
    if (!request.rebuild.empty()) {
        if (const auto written = replace_synced(request.rebuild, *said); !written)
            return refused(written.error(), exit_failed);
        std::cout << request.rebuild << " is written anew. Read the difference before you keep it: "
                  << "git diff " << request.rebuild << "\n";
    }
    if (request.expected.empty()) return exit_ok;
    const auto expected = text_of(request.expected);
    if (!expected) return refused(expected.error(), exit_failed);
    return compare(*said, *expected, request.expected);
}

std::string wire_of(const ReplayRequest& request, const Tape& tape) {
    if (!request.wire.empty()) return request.wire;
    const auto said = tape.header.find("wire");
    if (said == tape.header.end() || said->second == "serial") return "pty";
    return said->second;
}

struct Played {
    Result<void> result;
    bool ended = false; ///< not by a signal
};

Task<void> play(Scheduler& scheduler,
                boost::asio::io_context& loop,
                NearWire& wire,
                const Tape& tape,
                const ReplayRequest& request,
                Played& played) {
    const TapePace pace{request.fast};
    played.result = co_await play_on_wire(scheduler, wire, tape, pace);
    played.ended = true;
    if (!played.result || !request.hold) loop.stop();
    if (played.result) std::cerr << "the tape is at its end\n";
}

Task<void> end_on_signal(boost::asio::io_context& loop) {
    boost::asio::signal_set signals{loop, SIGTERM, SIGINT};
    co_await signals.async_wait(boost::asio::as_tuple(boost::asio::use_awaitable));
    loop.stop();
}

std::string link_text(const LinkSettings& settings) {
    return settings.kind == LinkSettings::Kind::tcp
               ? "tcp:" + settings.host + ":" + std::to_string(settings.port)
               : "serial:" + settings.path;
}

int on_a_wire(const ReplayRequest& request, const Tape& tape, bool json) {
    const std::string kind = wire_of(request, tape);
    if (kind != "pty" && kind != "tcp")
        return std::cerr << "a device on " << kind
                         << " cannot be stood for by a terminal or a port: axiscal replay --block "
                            "NAME prints the lines of a station file with which axiscald plays it "
                            "itself, axiscal replay --print plays it through its driver here\n",
               exit_refused;
    boost::asio::io_context loop{1};
    AsioScheduler scheduler{loop};
    auto wire = kind == "tcp" ? make_tcp_wire(scheduler, request.port)
                              : make_pty_wire(scheduler, request.link);
    if (!wire) return refused(wire.error(), exit_failed);
    const std::string link = link_text((*wire)->settings());
    if (json)
        std::cout << json_text(Json{{"ready", true}, {"link", link}}) << "\n" << std::flush;
    else
        std::cout << "link = \"" << link << "\""
                  << "\n"
                  << std::flush;
    Played played;
    spawn(scheduler, play(scheduler, loop, **wire, tape, request, played));
    spawn(scheduler, end_on_signal(loop));
    loop.run();
    return played.result ? exit_ok : refused(played.result.error(), exit_disagrees);
}

int tell_block(const ReplayRequest& request, const Tape& tape) {
    std::error_code error;
    const auto path = std::filesystem::absolute(request.tape, error);
    const auto block = block_text(tape, request.block, path.lexically_normal().string());
    if (!block) return refused(block.error(), exit_refused);
    std::cout << *block;
    return exit_ok;
}

} // namespace

int command_replay(const ReplayRequest& request, bool json) {
    const auto tape = read_tape(request.tape);
    if (!tape)
        return refused(tape.error(), tape.error().fault == Fault::io ? exit_failed : exit_refused);
    if (!request.block.empty()) return tell_block(request, *tape);
    const bool inside = request.print || !request.expected.empty() || !request.rebuild.empty();
    return inside ? through_the_driver(request, *tape) : on_a_wire(request, *tape, json);
}

} // namespace axiscal
