// Commands that make a station file.
#include "tools/axiscal/arguments/options.hpp"

namespace axiscal {
namespace {

constexpr const char* new_station_footer = R"words(Example, the CNC at 192.168.10.20:
  axiscal station new --axis X --travel-low "0 mm" --travel-high "1000 mm" --sign 1 --dead-path "120 mm" \
    --expansion "11.5 um/(m*K)" --expansion-uncertainty "0.5 um/(m*K)" --overrun "2 mm" --feed "1000 mm/min" \
    --shape sequence-block --transport tcp --client 192.168.10.20 \
    --instrument /dev/ttyUSB0=modbus --set material.profile=tm-th8

On a terminal it asks for what is missing; else it tells all that is missing at once and writes nothing.
What could harm the machine or the result is never guessed. Instruments are those that are plugged in; a
device that could be several is named with --instrument, an instrument on a network, too:
--instrument tcp:192.168.0.20:502=modbus. Everything else has a default: station.example.toml tells which.
A file that is there is kept; --force puts it aside.
See also: axiscal devices, check-config, doctor.)words";

} // namespace

void add_station_commands(CLI::App& app, Options& options, Command& chosen) {
    auto* made = app.add_subcommand(
        "station", "A first station file: asks what only you know, adds what is plugged in");
    NewStationRequest& request = options.new_station;
    made->add_option("ACTION", request.action, "new")->required()->check(CLI::IsMember({"new"}));
    for (const StationQuestion& question : station_questions())
        made->add_option_function<std::string>(
                "--" + std::string{question.option},
                [&request, &question](const std::string& answer) {
                    request.answers[question.name()] = answer;
                },
                std::string{question.words})
            ->type_name("\"" + std::string{question.example} + "\"");
    made->add_option(
        "--instrument", request.instruments,
        "PLACE=DRIVER: what is plugged in there, or tcp:HOST:PORT=DRIVER; may be given "
        "more than once");
    made->add_option("--set", request.settings,
                     "NAME.KEY=VALUE of an instrument, as material.profile=xy-md02; may be given "
                     "more than once");
    made->add_option("--out", request.out, "station file to write")->capture_default_str();
    made->add_flag("--force", request.force, "put a file that is there aside, as FILE.before");
    made->add_option("--sysfs", request.places.sysfs, "look there instead of /sys")->group("");
    made->add_option("--dev", request.places.dev, "look there instead of /dev")->group("");
    teach(*made, new_station_footer, {exit_ok, exit_failed, exit_usage, exit_refused});
    made->callback(
        [&] { chosen = [&] { return command_new_station(options.new_station, options.json); }; });
}

} // namespace axiscal
