// Commands for an axis that is aligned or left at rest.
#include "tools/axiscal/arguments/options.hpp"

#include <iostream>

namespace axiscal {
namespace {

constexpr const char* align_footer =
    R"(Example:
  axiscal align --spot-offset 0.5
With no action: watches the beam until a line is typed. Begin with the axis at its near end, drive to
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
    teach(*align, align_footer, {exit_ok, exit_usage, exit_forbidden, exit_no_contact});
    align->callback([&] {
        chosen = [&] { return command_align(client_of(options), options.align, options.json); };
    });
    daemon_options(*align, options);
}

constexpr const char* drift_footer =
    R"(Example:
  axiscal drift --duration "1 h" --wait
Let the axis stand where it will be measured longest from the interferometer, servo on, as for the run, and
leave it alone. Every channel of the station is recorded; no CNC takes part. The range of the axis, at 20 degC,
is E_VE: point [uncertainty] eve_run of the station file to the test, and later runs carry it in their budget.
Of a standing ballbar (--of ballbar, on a station without [axis] always) its readings are taken as they are, and
[circular.uncertainty] eve_run carries E_VE to later circular tests.
'axiscal abort' ends the test early.)";

void add_drift_command(CLI::App& app, Options& options, Command& chosen) {
    auto* drift = app.add_subcommand(
        "drift",
        "Record every channel while the axis or the ballbar rests: E_VE, ETVE, temperatures");
    drift
        ->add_option("--of", options.drift.of,
                     "what rests: axis, or ballbar (as the station file names it); default: the "
                     "axis where there is one")
        ->check(CLI::IsMember({"axis", "ballbar"}));
    drift->add_option("--duration", options.drift.duration, "as long as a run takes, or hours")
        ->capture_default_str();
    drift->add_option("--interval", options.drift.interval, "between two readings")
        ->capture_default_str();
    drift->add_option(
        "--at", options.drift.place_mm,
        "coordinate in mm (degrees) at which the axis stands; default: the end of the "
        "travel far from the interferometer, of a rotary axis its datum");
    drift->add_flag("--wait", options.drift.wait, "wait for the end and the certificate");
    drift->add_option("--state-that", options.statements, "KEY=TEXT for the certificate");
    drift->add_option("--by", options.drift.by, "who orders it, as kept with the test");
    teach(*drift, drift_footer,
          {exit_ok, exit_failed, exit_usage, exit_forbidden, exit_no_contact, exit_incomplete});
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

} // namespace

void add_rest_commands(CLI::App& app, Options& options, Command& chosen) {
    add_align_command(app, options, chosen);
    add_drift_command(app, options, chosen);
}

} // namespace axiscal
