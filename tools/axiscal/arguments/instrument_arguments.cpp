// Commands that look at instruments and at this PC.
#include "tools/axiscal/arguments/options.hpp"

namespace axiscal {
namespace {

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
    teach(*devices, devices_footer, {exit_ok, exit_usage, exit_no_contact});
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

constexpr const char* selftest_footer = R"(Example, while the PC works as it will during a run:
  axiscal selftest --state-directory /var/lib/axiscal --port /dev/ttyUSB0
Each figure stands with what it means for a measurement. Works without axiscald.)";

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
    teach(*command, selftest_footer, {exit_ok, exit_failed, exit_usage});
    command->callback(
        [&] { chosen = [&] { return command_selftest(options.selftest, options.json); }; });
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
Examples:
  axiscal doctor                      the installed station file; sudo, so that the disk is tried, too
  axiscal doctor my-station.toml      another one, before it is installed
See also: axiscal devices, selftest, check-config.)";

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
    teach(*doctor, doctor_footer, {exit_ok, exit_usage, exit_unwell});
    doctor->callback([&] {
        chosen = [&] {
            if (options.door.socket_path != Options{}.door.socket_path)
                options.doctor.socket = options.door.socket_path;
            return command_doctor(options.doctor, options.json);
        };
    });
}

} // namespace

void add_instrument_commands(CLI::App& app, Options& options, Command& chosen) {
    add_devices_command(app, options, chosen);
    add_selftest_command(app, options, chosen);
    add_doctor_command(app, options, chosen);
}

} // namespace axiscal
