// The command line. Each command is documented where it is parsed: `axiscal COMMAND --help`.
#include "config/measure.hpp"
#include "tools/axiscal/align_command.hpp"
#include "tools/axiscal/conformance.hpp"
#include "tools/axiscal/daemon_commands.hpp"
#include "tools/axiscal/devices_command.hpp"
#include "tools/axiscal/doctor_command.hpp"
#include "tools/axiscal/drift_command.hpp"
#include "tools/axiscal/exit_code.hpp"
#include "tools/axiscal/offline_commands.hpp"
#include "tools/axiscal/tape_commands.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>

namespace axiscal {
namespace {

constexpr const char* footer = R"(A run, from start to certificate:
  axiscal check-config /etc/axiscal/station.toml     is the station file right?
  axiscal doctor                                     is this PC right? how is it mended?
  axiscal devices                                    what is plugged in? are laser and sensors there?
  axiscal align                                      align the beam; kept for the certificate
  axiscal program --config station.toml --out .      part program for the CNC; load and start it:
                                                     the axis goes to its datum and waits
  axiscal preflight                                  is all as it must be? axiscal arm asks the same
  axiscal arm --program X-whole.ngc                  tie the reading there; the CNC goes on by itself
  axiscal watch                                      next target, reading, temperatures, time left

Exit codes: 0 done; 1 a file or the disk failed; 2 wrong usage; 3 input refused (case, run file,
station file); 4 the station refuses (rights, busy, not armed); 5 axiscald does not answer;
6 the run ended incomplete; 7 a figure of the conformance kit, or a tape, disagrees; 8 a run file or its
certificate is not what was written; 9 the doctor found something broken.)";

struct Options {
    bool json = false;
    DoorAddress door{"/run/axiscal/axiscald.sock", "", ""};
    std::string token_file;
    std::string config = "/etc/axiscal/station.toml";
    std::string file, out = ".", reason, certificate;
    bool until_published = false, drivers = false;
    ArmOrder arm;
    AlignOrder align;
    DriftOrder drift;
    std::vector<std::string> statements, overrides;
    RevisionOrder revision;
    bool exclude_instead = false;
    ProgramRequest program;
    ConformanceOrder conformance;
    DevicesRequest devices;
    DoctorRequest doctor;
    RecordRequest record;
    ReplayRequest replay;
    SelfTestRequest selftest{"/var/lib/axiscal", {}, 200};
};

StationClient client_of(Options& options) {
    // NOLINTNEXTLINE(concurrency-mt-unsafe): there is one thread
    if (const char* socket = std::getenv("AXISCAL_SOCKET");
        socket != nullptr &&
        options.door.socket_path == DoorAddress{"/run/axiscal/axiscald.sock", "", ""}.socket_path)
        options.door.socket_path = socket;
    if (std::ifstream file{options.token_file}; !options.token_file.empty())
        std::getline(file, options.door.token);
    return StationClient{options.door};
}

void daemon_options(CLI::App& command, Options& options) {
    command
        .add_option("--socket", options.door.socket_path,
                    "Unix socket of axiscald (default also from AXISCAL_SOCKET)")
        ->capture_default_str();
    command.add_option("--host", options.door.host,
                       "talk TCP to ADDRESS:PORT instead; reads only, unless a token is given");
    command.add_option("--token-file", options.token_file,
                       "file with the bearer token (in the state directory)");
}

bool split_at_equals(const std::vector<std::string>& given,
                     std::map<std::string, std::string>& into) {
    for (const std::string& word : given) {
        const auto equals = word.find('=');
        if (equals == std::string::npos) return false;
        into[word.substr(0, equals)] = word.substr(equals + 1);
    }
    return true;
}

int split_statements(Options& options) {
    if (!split_at_equals(options.statements, options.arm.statements)) {
        std::cerr << "--state-that needs KEY=TEXT, as in operator=\"Shift 2\"\n";
        return exit_usage;
    }
    if (split_at_equals(options.overrides, options.arm.overrides)) return exit_ok;
    std::cerr << "--override needs NAME=REASON, as in soak=\"the customer waits\"\n";
    return exit_usage;
}

void arming_options(CLI::App& command, Options& options) {
    command.add_option(
        "--state-that", options.statements,
        "KEY=TEXT for the certificate: operator, state (as found, raw, as left), customer, ...");
    command.add_option("--override", options.overrides,
                       "NAME=REASON: arm although this pre-flight check fails; the certificate "
                       "prints the reason");
}

void revision_options(CLI::App& command, Options& options) {
    command.add_option("--target", options.revision.target, "target, from 1; left out: every one")
        ->check(CLI::PositiveNumber);
    command.add_option("--direction", options.revision.direction, "up or down; left out: both")
        ->check(CLI::IsMember({"up", "down"}));
    command.add_option("--cycle", options.revision.cycle, "approach, from 1; left out: every one")
        ->check(CLI::PositiveNumber);
    command.add_option("--reason", options.revision.reason, "stands on the certificate")
        ->required();
}

using Command = std::function<int()>;

void add_revision_commands(CLI::App& app, Options& options, Command& chosen) {
    auto* retake = app.add_subcommand(
        "retake", "Take points again: a target, a direction, a cycle, or several of them together; "
                  "in the open run, or in the last one while its set-up stands");
    revision_options(*retake, options);
    retake->add_flag("--exclude", options.exclude_instead, "leave them out instead, as 'exclude'");
    retake->callback([&] {
        chosen = [&] {
            return options.exclude_instead
                       ? command_exclude(client_of(options), options.revision, options.json)
                       : command_retake(client_of(options), options.revision, options.json);
        };
    });
    auto* exclude = app.add_subcommand(
        "exclude",
        "Leave readings out of every figure, with a reason; they stay in the run file and "
        "are drawn and counted on the certificate");
    revision_options(*exclude, options);
    exclude->callback([&] {
        chosen = [&] {
            return command_exclude(client_of(options), options.revision, options.json);
        };
    });
}

constexpr const char* align_footer =
    R"(With nothing more: watches the beam until a line is typed. Begin with the axis at its near end, drive to
the far end, let it stand there and steer the beam through its highest reading and back, with each tilt.
Then Enter keeps what was seen: it stands in every run file and certificate from then on. q and Enter drops it.)";

void add_align_command(CLI::App& app, Options& options, Command& chosen) {
    auto* align = app.add_subcommand(
        "align", "Align the beam: strength and reading along the travel, live; cosine error");
    align
        ->add_option("ACTION", options.align.action,
                     "live, or for scripts one of begin, show, keep, drop")
        ->check(CLI::IsMember({"live", "begin", "show", "keep", "drop"}))
        ->capture_default_str();
    align
        ->add_option("--spot-offset", options.align.spot_offset_mm,
                     "walk of the return spot over the travel, in mm, as seen")
        ->check(CLI::Range(-100.0, 100.0));
    align->footer(align_footer);
    align->callback([&] {
        chosen = [&] { return command_align(client_of(options), options.align, options.json); };
    });
    daemon_options(*align, options);
}

constexpr const char* drift_footer =
    R"(Let the axis stand where it will be measured longest from the interferometer, servo on, as for the run, and
leave it alone. No CNC takes part. The range of what is read, at 20 degC, is E_VE: point [uncertainty] eve_run of
the station file to the test, and later runs carry it in their budget. 'axiscal abort' ends the test early.)";

void add_drift_command(CLI::App& app, Options& options, Command& chosen) {
    auto* drift = app.add_subcommand(
        "drift", "Record every channel while the axis rests: E_VE, ETVE, temperatures");
    drift->add_option("--duration", options.drift.duration, "as long as a run takes, or hours")
        ->capture_default_str();
    drift->add_option("--interval", options.drift.interval, "between two readings")
        ->capture_default_str();
    drift->add_option("--at", options.drift.place_mm,
                      "coordinate in mm at which the axis stands; default: the end of the travel "
                      "far from the interferometer");
    drift->add_flag("--wait", options.drift.wait, "wait for the end and the certificate");
    drift->add_option("--state-that", options.statements, "KEY=TEXT for the certificate");
    drift->footer(drift_footer);
    drift->callback([&] {
        chosen = [&] {
            if (split_at_equals(options.statements, options.drift.statements))
                return command_drift(client_of(options), options.drift, options.json);
            std::cerr << "--state-that needs KEY=TEXT, as in operator=\"Shift 2\"\n";
            return static_cast<int>(exit_usage);
        };
    });
    daemon_options(*drift, options);
}

constexpr const char* devices_footer = R"(Examples:
  axiscal devices                     instruments of the station, then all that is plugged in
  axiscal devices --as vaisala        one kind only, with the lines to add to the station file
  axiscal devices --drivers           every driver; --json for programs

Of each device: where it is plugged in, what it could be, what keeps axiscald from using it and the
line that mends that, and whether the station file knows it. Nothing is opened: no instrument is
disturbed. Instruments on a network cannot be seen; their pages in docs/instruments tell their link.
Works without axiscald.)";

void add_devices_command(CLI::App& app, Options& options, Command& chosen) {
    auto* devices = app.add_subcommand(
        "devices", "Instruments of the station, and what is plugged in: what it could be, what is "
                   "missing, the lines to add");
    DevicesRequest& request = options.devices;
    devices->add_flag("--drivers", options.drivers,
                      "list the drivers this program knows instead; needs no daemon");
    devices
        ->add_option("--config", request.station_file, "station file that devices are held against")
        ->capture_default_str();
    devices->add_option("--as", request.driver, "show only what could be of this driver");
    devices->add_option("--sysfs", request.places.sysfs, "look there instead of /sys")->group("");
    devices->add_option("--dev", request.places.dev, "look there instead of /dev")->group("");
    devices->footer(devices_footer);
    daemon_options(*devices, options);
    devices->callback([&] {
        chosen = [&] {
            if (options.drivers) return command_list_drivers(options.json);
            const StationClient client = client_of(options);
            return options.door.host.empty()
                       ? command_devices(client, options.devices, options.json)
                       : command_far_devices(client, options.json);
        };
    });
}

void add_daemon_commands(CLI::App& app, Options& options, Command& chosen) {
    auto* arm = app.add_subcommand(
        "arm", "Open a run: the axis stands at its datum, the reading is tied there");
    arm->add_option("--datum", options.arm.datum_mm,
                    "coordinate in mm (deg) where the axis stands now; default: the plan's datum");
    arm->add_option("--program", options.arm.program,
                    "the part program; its header names seed and pass")
        ->check(CLI::ExistingFile);
    arm->add_option("--seed", options.arm.seed,
                    "seed of the targets' random parts, as the part program says");
    arm->add_option("--pass", options.arm.pass,
                    "whole, stretch on an axis over 2000 mm, or circular")
        ->capture_default_str();
    arm->add_flag("--datum-by-cnc", options.arm.datum_by_cnc,
                  "wait for the CNC's prepare command instead of tying now");
    arming_options(*arm, options);
    arm->callback([&] {
        chosen = [&] {
            const int usage = split_statements(options);
            return usage != exit_ok ? usage
                                    : command_arm(client_of(options), options.arm, options.json);
        };
    });

    auto* preflight = app.add_subcommand(
        "preflight", "Every check before arming with its verdict, without arming; 4: one fails");
    arming_options(*preflight, options);
    preflight->callback([&] {
        chosen = [&] {
            const int usage = split_statements(options);
            return usage != exit_ok
                       ? usage
                       : command_preflight(client_of(options), options.arm, options.json);
        };
    });
    add_revision_commands(app, options, chosen);

    app.add_subcommand("status", "The station now: run, axis, channels, instruments")
        ->callback(
            [&] { chosen = [&] { return command_status(client_of(options), options.json); }; });
    auto* watch = app.add_subcommand(
        "watch",
        "Live: next target, reading, temperatures, strength, time left; ends with the run");
    watch->add_flag("--until-published", options.until_published, "wait for the certificate too");
    watch->callback([&] {
        chosen = [&] {
            return command_watch(client_of(options), options.json, options.until_published);
        };
    });
    app.add_subcommand("trigger",
                       "Capture the next point now; it is marked manual on the certificate")
        ->callback(
            [&] { chosen = [&] { return command_trigger(client_of(options), options.json); }; });
    auto* abort = app.add_subcommand("abort", "Close the run as incomplete; its file is kept");
    abort->add_option("--reason", options.reason, "stands in the run file");
    abort->callback([&] {
        chosen = [&] { return command_abort(client_of(options), options.reason, options.json); };
    });
    for (const char* name :
         {"arm", "preflight", "retake", "exclude", "status", "watch", "trigger", "abort"})
        daemon_options(*app.get_subcommand(name), options);
}

constexpr const char* verify_footer =
    R"(Exit codes: 0 every row is as it was written, the figures computed anew are those that were stored, and
the certificate says the same; 8 something is not, and each row is named with its table and number;
3 the file is no run file, or its pages are damaged; 1 it cannot be read.
A run that is still open can be verified as well. See docs/run-file.md for what the chain can show.)";

void add_selftest_command(CLI::App& app, Options& options, Command& chosen) {
    auto* command = app.add_subcommand(
        "selftest", "Measures this PC: durable commit, timer, serial lines, and what they mean");
    command
        ->add_option("--state-directory", options.selftest.folder,
                     "folder on the disk that keeps the runs")
        ->capture_default_str();
    command->add_option(
        "--port", options.selftest.ports,
        "serial port to be looked at, as /dev/ttyUSB0; may be given more than once");
    command->add_option("--count", options.selftest.count, "trials of each kind")
        ->check(CLI::Range(10, 100000))
        ->capture_default_str();
    command->callback(
        [&] { chosen = [&] { return command_selftest(options.selftest, options.json); }; });
}

void add_offline_commands(CLI::App& app, Options& options, Command& chosen) {
    auto* analyze = app.add_subcommand(
        "analyze",
        "Figures of a run file, or of a JSON case (docs/analysis.md); told apart by content");
    analyze
        ->add_option("FILE", options.file,
                     "RUN.axiscal or CASE.json; - reads a case from standard input")
        ->required();
    analyze->callback([&] { chosen = [&] { return command_analyze(options.file); }; });

    auto* program = app.add_subcommand("program", "Write the part program of the planned cycle");
    program->add_option("--config", options.config, "station file")->capture_default_str();
    program->add_option("--dialect", options.program.dialect,
                        "linuxcnc or marlin; default linuxcnc");
    program->add_option("--out", options.program.out_directory, "folder for the files")
        ->default_val(".");
    program->add_option(
        "--seed", options.program.seed,
        "seed of the targets' random parts; default: the station file's, or a new one");
    program
        ->add_option("--retake", options.program.run_file,
                     "run file: write the program of the points that are to be taken again")
        ->check(CLI::ExistingFile);
    program->callback([&] {
        chosen = [&] {
            options.program.station_file = options.config;
            return command_program(options.program, options.json);
        };
    });

    auto* write = app.add_subcommand(
        "export", "certificate.json, .csv and .pdf of a closed run file, or of a circular case");
    write->add_option("RUN", options.file, "run file, or the JSON of a circular case")->required();
    write->add_option("--out", options.out, "folder to write into")->capture_default_str();
    write->callback(
        [&] { chosen = [&] { return command_export(options.file, options.out, options.json); }; });

    auto* verify = app.add_subcommand(
        "verify", "Is a run file what was written? Names each changed, missing or added row");
    verify->add_option("RUN", options.file, "run file")->required();
    verify->add_option("--certificate", options.certificate,
                       "certificate.json to hold against it; default: the one beside it, if it is "
                       "of the same run");
    verify->footer(verify_footer);
    verify->callback([&] {
        chosen = [&] { return command_verify(options.file, options.certificate, options.json); };
    });

    auto* check = app.add_subcommand("check-config",
                                     "Every refusal of a station file at once, with its line");
    check->add_option("FILE", options.config, "station file")->capture_default_str();
    check->callback(
        [&] { chosen = [&] { return command_check_config(options.config, options.json); }; });
}

constexpr const char* conformance_footer = R"(Examples:
  axiscal conformance                                        this program, every case, every figure
  axiscal conformance --brief --against "python3 mine.py"    another program, only what disagrees
  axiscal conformance --only 'circle-*' positioning-hand-1   some cases

Another program reads one case as JSON from standard input, writes the result as JSON to standard output
and ends with 0. One that crashes, hangs or writes anything else fails that case; the next one is run.
Figures stand as: digits of agreement, place in the result, value. The last line counts cases by the
origin of their figures. Exit 7: a figure disagrees. Exit 3: a file is no case. See docs/conformance.md.)";

void add_conformance_command(CLI::App& app, Options& options, Command& chosen) {
    ConformanceOrder& order = options.conformance;
    auto* command = app.add_subcommand(
        "conformance", "Hold this program, or another, against cases with known figures");
    command->add_option("--against", order.command,
                        "another program, as a line for the shell; default: this one");
    command->add_option("--cases", order.folder,
                        "folder of cases; default: $AXISCAL_CONFORMANCE_PATH, else the installed");
    command->add_option("--only", order.only, "ids of cases, or patterns as 'circle-*'");
    command
        ->add_option("--timeout", order.seconds, "seconds that another program may take for a case")
        ->check(CLI::Range(0.001, 86400.0))
        ->capture_default_str();
    command->add_flag("--brief", order.brief, "print only what disagrees, and the last line");
    command->footer(conformance_footer);
    command->callback(
        [&] { chosen = [&] { return command_conformance(options.conformance, options.json); }; });
}

constexpr const char* doctor_footer = R"(What it looks at, and what it means:
  rights       user and group axiscal, this user's membership, the daemon's socket
  wire         each instrument of the station file: plugged in, its node open to the service, its kernel
               driver, the latency timer of an FTDI adapter (bytes held back are time lost), CAN up
  certificate  of the instruments: ended, or ending within 30 days
  clock        monotonic clock (times of samples), time server (dates on certificates)
  disk         the state directory: rights, space, kind of file system, one commit made durable
  share        where certificates go: there, writable or reached, the publisher at work
  port         the CNC's Modbus port and the console's: free, or held by axiscald; who may connect
  kernel       modules that instruments need
  papers       font and program of the certificates

Each finding is good, a NOTE (it works; you should know) or BROKEN (mend it: a measurement fails, or is
lost). The line below says how. Nothing is changed, no instrument is asked.
  axiscal doctor                      the installed station file; sudo, so that the disk is tried, too
  axiscal doctor my-station.toml      another one, before it is installed
Exit codes: 0 nothing is broken; 9 something is. See also: axiscal devices, selftest, check-config.)";

void add_doctor_command(CLI::App& app, Options& options, Command& chosen) {
    DoctorRequest& request = options.doctor;
    auto* doctor = app.add_subcommand(
        "doctor", "What could keep this PC from measuring, and how to mend each; needs no daemon");
    doctor->add_option("STATION", request.station_file, "station file")->capture_default_str();
    doctor->add_option("--socket", options.door.socket_path,
                       "Unix socket of axiscald; default: the station file's");
    doctor->add_option("--sysfs", request.places.kernel.sysfs, "look there instead of /sys")
        ->group("");
    doctor->add_option("--dev", request.places.kernel.dev, "look there instead of /dev")->group("");
    doctor->add_option("--modules", request.places.modules, "modules of another kernel")->group("");
    doctor->footer(doctor_footer);
    doctor->callback([&] {
        chosen = [&] {
            if (options.door.socket_path != Options{}.door.socket_path)
                options.doctor.socket = options.door.socket_path;
            return command_doctor(options.doctor, options.json);
        };
    });
}

constexpr const char* record_footer = R"(Example, with the daemon stopped (it holds the wire):
  sudo systemctl stop axiscald
  axiscal record --instrument air --out air.tape --for 60 --who "Shift 2" --what "warm-up, then still"
  axiscal replay --print air.tape
A good tape holds the start, a while of usual readings, and what goes wrong in practice: beam cut, probe
pulled, cable out and in again. The header keeps maker, model, serial number, firmware, who, when, and the
driver's keys of the station file; no other instrument is touched. docs/add-an-instrument.md tells what
becomes of it.
Serial, TCP, Modbus, USB, HID and CAN instruments can be recorded; those that the kernel reads for us (1-Wire,
counter) have no wire of their own.)";

constexpr const char* replay_footer =
    R"(On a wire, for the unmodified daemon (serial and TCP instruments):
  axiscal replay air.tape --link /tmp/air        then: link = "serial:/tmp/air" in a station file
  axiscal replay ids.tape --port 9090            then: link = "tcp:127.0.0.1:9090"
It waits for what the daemon must write, and answers as late as on the tape (--fast: at once). Exit 7 when
the daemon writes something else.
Through the driver, in this process and in virtual time:
  axiscal replay --print air.tape                what the driver makes of it
  axiscal replay air.tape --expect air.expected  exit 7 with the first line that differs
  axiscal replay air.tape --rebuild air.expected writes it anew; read the difference before you keep it)";

void add_tape_commands(CLI::App& app, Options& options, Command& chosen) {
    RecordRequest& record = options.record;
    auto* keep = app.add_subcommand(
        "record",
        "Write what passes over an instrument's wire to a tape; axiscald must be stopped");
    keep->add_option("--config", record.station_file, "station file")->capture_default_str();
    keep->add_option("--instrument", record.instrument, "its name in the station file")->required();
    keep->add_option("--out", record.tape, "tape to write; never one that is there")->required();
    keep->add_option("--for", record.seconds, "seconds; Ctrl-C ends it earlier")
        ->check(CLI::Range(0.1, 86400.0))
        ->capture_default_str();
    keep->add_option("--who", record.who, "who records");
    keep->add_option("--what", record.what, "what is done meanwhile");
    keep->add_option("--origin", record.origin, "device, or simulator for one that is none")
        ->check(CLI::IsMember({"device", "simulator"}))
        ->capture_default_str();
    keep->footer(record_footer);
    keep->callback([&] { chosen = [&] { return command_record(options.record, options.json); }; });

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
    play->footer(replay_footer);
    play->callback([&] { chosen = [&] { return command_replay(options.replay, options.json); }; });
}

/// The first word is no command: says so, with the nearest one there is.
void hint_at_command(const CLI::App& app, const std::string& word) {
    std::vector<std::string> known;
    for (const CLI::App* command : app.get_subcommands({}))
        known.push_back(command->get_name());
    if (std::ranges::find(known, word) != known.end()) return;
    const std::string near = nearest_word(word, known);
    std::cerr << "'" << word << "' is no command"
              << (near.empty() ? "" : "; did you mean '" + near + "'?") << "\n";
}

int run(int argc, char** argv) {
    CLI::App app{"axiscal: calibrate a machine-tool axis, from the laser to the certificate",
                 "axiscal"};
    Options options;
    Command chosen;
    app.footer(footer);
    app.require_subcommand(1);
    app.set_version_flag("--version", AXISCAL_VERSION);
    add_devices_command(app, options, chosen);
    add_daemon_commands(app, options, chosen);
    add_align_command(app, options, chosen);
    add_drift_command(app, options, chosen);
    add_offline_commands(app, options, chosen);
    add_conformance_command(app, options, chosen);
    add_selftest_command(app, options, chosen);
    add_doctor_command(app, options, chosen);
    add_tape_commands(app, options, chosen);
    for (CLI::App* command : app.get_subcommands({}))
        command->add_flag("--json", options.json, "print JSON for programs");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (argc > 1 && argv[1][0] != '-') hint_at_command(app, argv[1]);
        return app.exit(error) == 0 ? exit_ok : exit_usage;
    }
    return chosen();
}

} // namespace
} // namespace axiscal

int main(int argc, char** argv) {
    try {
        return axiscal::run(argc, argv);
    } catch (const std::exception& bug) {
        std::cerr << "axiscal: " << bug.what() << "\n";
        return axiscal::exit_failed;
    }
}
