// Commands that drive a run.
#include "tools/axiscal/arguments/options.hpp"

#include <iostream>

namespace axiscal {
namespace {

/// Of a command that asks the daemon one thing.
const std::vector<ExitCode> asking_codes{exit_ok, exit_usage, exit_forbidden, exit_no_contact};

constexpr const char* retake_footer = R"(Examples:
  axiscal retake --target 3 --direction up --reason "a door was slammed"
  axiscal program --retake RUN.axiscal            the part program of these points
What was read before stays in the run file and is drawn; the new readings count. See docs/retake.md.)";

constexpr const char* exclude_footer = R"(Example:
  axiscal exclude --target 3 --cycle 2 --reason "coolant in the beam"
Nothing is deleted: the certificate tells which readings are left out, and why. See docs/retake.md.)";

constexpr const char* answer_footer = R"(Example:
  axiscal answer moved_optic "the bracket was tight; the table had been bumped in cycle 3"
The findings stand in axiscal result and on the certificate. See docs/setup-findings.md.)";

constexpr const char* arm_footer = R"(Examples, while the axis stands at its datum and waits:
  axiscal arm --program X-whole.ngc --state-that operator="Shift 2"
  axiscal arm --program X-whole.ngc --override soak="the customer waits"
The CNC goes on by itself; axiscal watch shows it. A pre-flight check that fails refuses: see docs/preflight.md.)";

constexpr const char* preflight_footer = R"(Example:
  axiscal preflight --state-that operator="Shift 2"
Each check that fails says how to mend it; one that fails and is not overridden is a refusal.)";

constexpr const char* status_footer = R"(Examples:
  axiscal status                      for a person; --json for programs
  axiscal status --host 10.1.2.3:8470
From another PC everybody may read; [console] of the station file says where it listens.)";

constexpr const char* watch_footer = R"(Example:
  axiscal watch --until-published
Ctrl-C ends the watching, never the run. Into a file it writes a line for each point.)";

constexpr const char* trigger_footer = R"(Example, with the axis at rest on the next target:
  axiscal trigger
Held against target, direction and stillness as a trigger of the CNC is; axiscal watch shows what came of it.)";

constexpr const char* reading_footer = R"(Example:
  axiscal reading --arcsec -1.25
One reading a face, in the order of the plan; axiscal status shows the next one. See docs/rotary.md.)";

constexpr const char* abort_footer = R"(Example:
  axiscal abort --reason "the beam is cut by a chip"
A test of drift is ended the same way. What was measured stays in the run file: axiscal result and
axiscal analyze give its partial result, without certificate number and verdict.)";

void arming_options(CLI::App& command, Options& options) {
    command.add_option(
        "--state-that", options.statements,
        "KEY=TEXT for the certificate: operator, state (as found, raw, as left), customer, ...");
    command.add_option("--override", options.overrides,
                       "NAME=REASON: arm although this pre-flight check fails; the certificate "
                       "prints the reason");
    command
        .add_option("--pass", options.arm.pass,
                    "whole, stretch on an axis over 2000 mm, circular, straightness, or "
                    "squareness")
        ->capture_default_str();
    command.add_option("--option", options.kind_options,
                       "NAME=VALUE that one kind of test alone is told: mirror=reversed and "
                       "reversal_of=RUN of straightness and squareness; square=turned and "
                       "first=RUN of squareness");
}

/// Of every order that decides about a run.
void orderer_option(CLI::App& command, std::string& name) {
    command.add_option("--by", name,
                       "who orders it, as kept with the run; beside it stands the user of this "
                       "computer");
}

void revision_options(CLI::App& command, Options& options) {
    orderer_option(command, options.revision.by);
    command.add_option("--target", options.revision.target, "target, from 1; left out: every one")
        ->check(CLI::PositiveNumber);
    command.add_option("--direction", options.revision.direction, "up or down; left out: both")
        ->check(CLI::IsMember({"up", "down"}));
    command.add_option("--cycle", options.revision.cycle, "approach, from 1; left out: every one")
        ->check(CLI::PositiveNumber);
    command.add_option("--reason", options.revision.reason, "stands on the certificate")
        ->required();
}

void add_revision_commands(CLI::App& app, Options& options, Command& chosen) {
    auto* retake = app.add_subcommand(
        "retake", "Take points again: a target, a direction, a cycle, or several of them together; "
                  "in the open run, or in the last one while its set-up stands");
    revision_options(*retake, options);
    retake->add_flag("--exclude", options.exclude_instead, "leave them out instead, as 'exclude'");
    teach(*retake, retake_footer, asking_codes);
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
    teach(*exclude, exclude_footer, asking_codes);
    exclude->callback([&] {
        chosen = [&] {
            return command_exclude(client_of(options), options.revision, options.json);
        };
    });
}

void add_arm_commands(CLI::App& app, Options& options, Command& chosen) {
    auto* arm = app.add_subcommand(
        "arm", "Open a run: the axis stands at its datum, the reading is tied there");
    arm->add_option("--datum", options.arm.datum_mm,
                    "coordinate in mm (deg) where the axis stands now; default: the plan's datum");
    arm->add_option("--program", options.arm.program,
                    "the part program; its header names seed and pass")
        ->check(CLI::ExistingFile);
    arm->add_option("--seed", options.arm.seed,
                    "seed of the targets' random parts, as the part program says");
    arm->add_flag("--datum-by-cnc", options.arm.datum_by_cnc,
                  "wait for the CNC's prepare command instead of tying now");
    orderer_option(*arm, options.arm.by);
    arming_options(*arm, options);
    teach(*arm, arm_footer, {exit_ok, exit_usage, exit_refused, exit_forbidden, exit_no_contact});
    arm->callback([&] {
        chosen = [&] {
            const int usage = split_statements(options);
            return usage != exit_ok ? usage
                                    : command_arm(client_of(options), options.arm, options.json);
        };
    });

    auto* preflight = app.add_subcommand(
        "preflight", "Every check before arming with its verdict, without arming");
    arming_options(*preflight, options);
    teach(*preflight, preflight_footer, asking_codes);
    preflight->callback([&] {
        chosen = [&] {
            const int usage = split_statements(options);
            return usage != exit_ok
                       ? usage
                       : command_preflight(client_of(options), options.arm, options.json);
        };
    });
}

void add_watch_commands(CLI::App& app, Options& options, Command& chosen) {
    auto* status =
        app.add_subcommand("status", "The station now: run, axis, channels, instruments");
    teach(*status, status_footer, asking_codes);
    status->callback(
        [&] { chosen = [&] { return command_status(client_of(options), options.json); }; });
    auto* watch = app.add_subcommand(
        "watch",
        "Live: next target, reading, temperatures, strength, time left; ends with the run");
    watch->add_flag("--until-published", options.until_published, "wait for the certificate too");
    teach(*watch, watch_footer,
          {exit_ok, exit_failed, exit_usage, exit_forbidden, exit_no_contact, exit_incomplete});
    watch->callback([&] {
        chosen = [&] {
            return command_watch(client_of(options), options.json, options.until_published);
        };
    });
    auto* trigger = app.add_subcommand(
        "trigger", "Capture the next point now; it is marked manual on the certificate");
    teach(*trigger, trigger_footer, asking_codes);
    trigger->callback(
        [&] { chosen = [&] { return command_trigger(client_of(options), options.json); }; });
    auto* reading = app.add_subcommand(
        "reading", "Type what the autocollimator shows at the next face of the polygon");
    reading->add_option("--arcsec", options.reading_arcsec, "the reading in seconds of arc")
        ->required();
    teach(*reading, reading_footer, asking_codes);
    reading->callback([&] {
        chosen = [&] {
            return command_reading(client_of(options), options.reading_arcsec, options.json);
        };
    });
    auto* abort = app.add_subcommand("abort", "Close the run as incomplete; its file is kept");
    abort->add_option("--reason", options.reason, "stands in the run file");
    orderer_option(*abort, options.by);
    teach(*abort, abort_footer, asking_codes);
    abort->callback([&] {
        chosen = [&] {
            return command_abort(client_of(options), options.reason, options.by, options.json);
        };
    });
}

void add_answer_command(CLI::App& app, Options& options, Command& chosen) {
    auto* answer = app.add_subcommand(
        "answer", "Answer a finding about the set-up of the last run; its next certificate prints "
                  "finding and answer");
    answer
        ->add_option("FINDING", options.finding_answer.finding, "its name, as axiscal result says")
        ->required();
    answer->add_option("TEXT", options.finding_answer.text, "what was looked at, and what it was")
        ->required();
    orderer_option(*answer, options.finding_answer.by);
    teach(*answer, answer_footer, asking_codes);
    answer->callback([&] {
        chosen = [&] {
            return command_answer(client_of(options), options.finding_answer, options.json);
        };
    });
}

} // namespace

void add_run_commands(CLI::App& app, Options& options, Command& chosen) {
    add_arm_commands(app, options, chosen);
    add_revision_commands(app, options, chosen);
    add_answer_command(app, options, chosen);
    add_watch_commands(app, options, chosen);
    for (const char* name : {"arm", "preflight", "retake", "exclude", "answer", "status", "watch",
                             "trigger", "reading", "abort"})
        daemon_options(*app.get_subcommand(name), options);
}

} // namespace axiscal
