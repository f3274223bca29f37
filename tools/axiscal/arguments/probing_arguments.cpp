// The command for a test of the touch probe.
#include "tools/axiscal/arguments/options.hpp"

namespace axiscal {
namespace {

constexpr const char* probing_footer =
    R"(Examples:
  axiscal probing program --program probing.ngc
  axiscal probing record --program probing.ngc --log probing.log
program: the part program for LinuxCNC. The block lies on the negative side of three faces that meet in its
corner; set a rough zero of G54 there first. One touch of each face sets the true zero; then each of -X, -Y, -Z is
touched from one distance (references) and from growing ones. The control writes the log.
record: the log as a run file with its figures. Any control can write such a log, or a person: a line a touch,
"-X touch 2.0016" or "-X reference 2.0000" and the latched X, Y, Z in mm. See docs/probing.md.)";

} // namespace

void add_probing_commands(CLI::App& app, Options& options, Command& chosen) {
    ProbingOrder& order = options.probing;
    auto* probing = app.add_subcommand(
        "probing", "Variation of a touch probe's delay (ISO 230-10, 6.9): program, then record");
    probing->add_option("ACTION", order.action, "program or record")
        ->required()
        ->check(CLI::IsMember({"program", "record"}));
    probing->add_option("--program", order.program, "the part program")->capture_default_str();
    probing->add_option("--log", order.log, "what the control writes, a line a touch")
        ->capture_default_str();
    probing->add_option("--feed", order.plan.feed_mm_per_min, "probing feed, mm/min")
        ->capture_default_str();
    probing->add_option("--first", order.plan.first_mm, "shortest approach distance, mm")
        ->capture_default_str();
    probing
        ->add_option("--step", order.plan.step_mm,
                     "growth of the distance, mm: 0.1 to 0.3 of feed x the control's cycle")
        ->capture_default_str();
    probing->add_option("--touches", order.plan.touches, "of each direction")
        ->capture_default_str();
    probing
        ->add_option("--references", order.plan.references,
                     "touches of each direction from the first distance")
        ->capture_default_str();
    probing->add_option("--config", order.config, "station file; states machine and place")
        ->default_val("/etc/axiscal/station.toml");
    probing->add_option("--out", order.out, "folder for the run file")->capture_default_str();
    probing->add_option("--probe", order.probe, "type of the probe and its stylus, for the record");
    probing->add_option("--signal", order.signal_path, "signal path: skip input, PLC, ...");
    probing->add_option("--operator", order.operator_name, "who made the test");
    teach(*probing, probing_footer, {exit_ok, exit_failed, exit_usage, exit_refused});
    probing->callback(
        [&] { chosen = [&] { return command_probing(options.probing, options.json); }; });
}

} // namespace axiscal
