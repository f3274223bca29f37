// Commands that keep what passes over a wire, and play it again.
#include "tools/axiscal/arguments/options.hpp"

namespace axiscal {
namespace {

constexpr const char* record_footer = R"(Example, with the daemon stopped (it holds the wire):
  sudo systemctl stop axiscald
  axiscal record --instrument air --out air.tape --for 60 --who "Shift 2" --what "warm-up, then still"
  axiscal replay --print air.tape
A good tape holds the start, a while of usual readings, and what goes wrong in practice: beam cut, probe
pulled, cable out and in again. The header keeps maker, model, serial number, firmware, who, when, and the
driver's keys of the station file; no other instrument is touched. docs/add-an-instrument.md tells what
becomes of it.
An instrument that no driver knows yet: axiscal record --raw serial:/dev/ttyUSB0 --baud 9600 --out strange.tape;
it only listens, then axiscal tape check strange.tape says what came.
Every instrument can be recorded: serial, TCP, Modbus, USB, HID, CAN, and those that the kernel reads for us (the
texts of 1-Wire sensors, the records of a counter).)";

constexpr const char* replay_footer =
    R"(Examples, on a wire for the unmodified daemon (serial and TCP instruments):
  axiscal replay air.tape --link /tmp/air        then: link = "serial:/tmp/air" in a station file
  axiscal replay ids.tape --port 9090            then: link = "tcp:127.0.0.1:9090"
It waits for what the daemon must write, and answers as late as on the tape (--fast: at once). Exit 7 when
the daemon writes something else.
By the unmodified daemon itself, without a wire (USB, HID, CAN, 1-Wire, counter; all but Modbus):
  axiscal replay stick.tape --block stick >> bench.toml   then: axiscald --config bench.toml
The daemon plays it once, from its start, with the tape's times; the instrument's state is then "tape", and no run
is armed on such a station.
Through the driver, in this process and in virtual time:
  axiscal replay --print air.tape                what the driver makes of it
  axiscal replay air.tape --expect air.expected  exit 7 with the first line that differs
  axiscal replay air.tape --rebuild air.expected writes it anew; read the difference before you keep it)";

constexpr const char* tape_footer = R"(Examples:
  axiscal tape check air.tape                    what it holds, and what of it is private
  axiscal tape keep air.tape --name air-stick    as a test, in a clone of the sources
See docs/share-a-recording.md.)";

void add_tape_command(CLI::App& app, Options& options, Command& chosen) {
    auto* tape = app.add_subcommand("tape", "What a tape holds; or keep it as a test");
    tape->add_option("ACTION", options.tape.action, "check or keep")
        ->required()
        ->check(CLI::IsMember({"check", "keep"}));
    tape->add_option("TAPE", options.tape.tape, "what axiscal record wrote")->required();
    tape->add_option("--name", options.tape.name, "keep: what the test is called")
        ->default_val("a-recording");
    tape->add_option("--folder", options.tape.folder, "keep: where the tests' tapes lie")
        ->capture_default_str();
    teach(*tape, tape_footer, {exit_ok, exit_failed, exit_usage, exit_refused});
    tape->callback([&] { chosen = [&] { return command_tape(options.tape, options.json); }; });
}

} // namespace

void add_tape_commands(CLI::App& app, Options& options, Command& chosen) {
    RecordRequest& record = options.record;
    auto* keep = app.add_subcommand(
        "record",
        "Write what passes over an instrument's wire to a tape; axiscald must be stopped");
    keep->add_option("--config", record.station_file, "station file")->capture_default_str();
    auto* named =
        keep->add_option("--instrument", record.instrument, "its name in the station file");
    auto* raw =
        keep->add_option("--raw", record.raw,
                         "serial:/dev/... or tcp:host:port: listen there, without a station "
                         "file, to an instrument that no driver knows")
            ->excludes(named);
    keep->add_option("--baud", record.baud, "speed of that serial line")
        ->needs(raw)
        ->check(CLI::Range(50, 4'000'000))
        ->capture_default_str();
    keep->add_option("--frame", record.frame, "its data bits, parity and stop bits")
        ->needs(raw)
        ->capture_default_str();
    keep->add_option("--out", record.tape, "tape to write; never one that is there")->required();
    keep->add_option("--for,--seconds", record.seconds, "seconds; Ctrl-C ends it earlier")
        ->check(CLI::Range(0.1, 86400.0))
        ->capture_default_str();
    keep->add_option("--who", record.who, "who records");
    keep->add_option("--what", record.what, "what is done meanwhile");
    keep->add_option("--origin", record.origin, "device, or simulator for one that is none")
        ->check(CLI::IsMember({"device", "simulator"}))
        ->capture_default_str();
    teach(*keep, record_footer, {exit_ok, exit_failed, exit_usage, exit_refused});
    keep->callback([&] {
        if (options.record.raw.empty() && options.record.instrument.empty())
            throw CLI::RequiredError("--instrument, or --raw of one that no driver knows,");
        chosen = [&] {
            return options.record.raw.empty() ? command_record(options.record, options.json)
                                              : command_record_raw(options.record, options.json);
        };
    });

    ReplayRequest& replay = options.replay;
    auto* play = app.add_subcommand(
        "replay", "Play a tape on a wire for the daemon, or through its driver at once");
    play->add_option("TAPE", replay.tape, "what axiscal record wrote")->required();
    play->add_option("--wire", replay.wire, "pty or tcp; default: as it was recorded")
        ->check(CLI::IsMember({"pty", "tcp"}));
    play->add_option("--link", replay.link, "pty: name for it, a symbolic link");
    play->add_option("--port", replay.port, "tcp: port on 127.0.0.1; default: a free one")
        ->check(CLI::Range(0, 65535));
    play->add_flag("--fast", replay.fast, "without the times of the tape");
    play->add_flag("--hold", replay.hold, "keep the wire open after the end, until Ctrl-C");
    play->add_flag("--print", replay.print, "print what the driver makes of it; no wire");
    play->add_option("--expect", replay.expected, "compare that with a file; no wire");
    play->add_option("--rebuild", replay.rebuild, "write that to a file; no wire");
    play->add_option("--block", replay.block,
                     "print the [[instrument]] block of this name with which axiscald plays it");
    teach(*play, replay_footer, {exit_ok, exit_failed, exit_usage, exit_refused, exit_disagrees});
    play->callback([&] { chosen = [&] { return command_replay(options.replay, options.json); }; });
    add_tape_command(app, options, chosen);
}

} // namespace axiscal
