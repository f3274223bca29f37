// Commands over files; none needs the daemon.
#include "tools/axiscal/arguments/options.hpp"

namespace axiscal {
namespace {

constexpr const char* analyze_footer = R"(Examples:
  axiscal analyze /var/lib/axiscal/runs/RUN.axiscal
  axiscal analyze readings.csv           a table; axiscal case new positioning --csv readings.csv writes one
  axiscal analyze - <case.json
Prints JSON. An array of cases gives an array of results; one that is refused names field and reason.)";

constexpr const char* case_footer = R"(Example:
  axiscal case new positioning --csv readings.csv
  axiscal analyze readings.csv
The file holds an example with remarks; comma, semicolon or tab, decimal point or comma, UTF-8 or UTF-16.)";

constexpr const char* import_footer = R"(Examples:
  axiscal import X-axis.rtl --certificate papers
  axiscal import X-axis.rtl --out x.json
  axiscal import log.txt --map rig.toml --out x.json
  axiscal analyze x.json
Laser10 text (.rtl, .rta), API .pos; by a map raw streams, logs of the uMD, tables as text or .xlsx. See
docs/import.md.)";

constexpr const char* judge_footer = R"(Example:
  axiscal judge x.json report.json
The report: {"parameters":{"E":6.86,"R":4.04},"unit":"um"}, perhaps with its readings. Prints JSON: what
differs, and the known mistake that gives it. See docs/import.md.)";

constexpr const char* result_footer = R"(Examples:
  axiscal result                                  of the newest run of this station
  axiscal result 20261121T093005Z-X --json        of one run, by its id or its file
  axiscal result --tolerances limits.json         with a verdict on each limit (ISO 14253-1)
A run that was aborted or interrupted gives a partial result: it says which planned readings are missing.)";

constexpr const char* budget_footer = R"(Examples:
  axiscal budget                                  of the newest run of this station
  axiscal budget RUN.axiscal --json               of a run file, for programs
Says of each input whether it was typed, comes from certificates, a drift test or the readings of the run,
and where the readings show more than was typed.)";

constexpr const char* program_footer = R"(Examples:
  axiscal program --config station.toml --out .             X-whole.ngc for LinuxCNC
  axiscal program --config station.toml --dialect marlin    for a 3D printer
  axiscal program --config station.toml --datum-by-cnc      the CNC ties the datum: axiscal arm --datum-by-cnc
Load and start it; when the axis waits at its datum: axiscal arm --program X-whole.ngc)";

constexpr const char* export_footer = R"(Examples:
  axiscal export RUN.axiscal --out papers
  axiscal export RUN.axiscal --format rtl      the readings alone, for other programs
Writes what the station wrote after the run, with the same figures.)";

constexpr const char* check_config_footer = R"(Example:
  axiscal check-config station.toml
Every mistake at once, each with its line and the key that is near; then the passes that are planned.)";

constexpr const char* verify_footer = R"(Example:
  axiscal verify RUN.axiscal --certificate certificate.json
  axiscal verify RUN.axiscal --public-key public-keys.pem --receipt receipt.json
Computes the figures anew; each row that is not as it was written is named with its table and number, and
the certificate must say the same. A run that is still open can be verified as well. See docs/run-file.md
for what chain, signature and receipt can show.)";

void add_import(CLI::App& app, Options& options, Command& chosen) {
    auto* take = app.add_subcommand(
        "import", "Files of other lasers and programs, as cases or as certificates");
    take->add_option("FILE", options.foreign.files, "what the other program wrote")->required();
    take->add_option("--map", options.foreign.map,
                     "TOML file: which column, signal and unit is which");
    auto* out = take->add_option("--out", options.foreign.out,
                                 "file to be written; must not be there; default: standard output");
    take->add_option("--certificate", options.foreign.certificate,
                     "folder: write a run file of the readings, and its certificate")
        ->excludes(out);
    teach(*take, import_footer, {exit_ok, exit_failed, exit_usage, exit_refused});
    take->callback([&] { chosen = [&] { return command_import(options.foreign, options.json); }; });

    auto* judge = app.add_subcommand(
        "judge", "Does a report that somebody published follow from its own readings?");
    judge->add_option("CASE", options.judge.document, "the readings, as a case")->required();
    judge->add_option("REPORT", options.judge.report, "its figures, as JSON")->required();
    teach(*judge, judge_footer, {exit_ok, exit_failed, exit_usage, exit_refused, exit_changed});
    judge->callback([&] { chosen = [&] { return command_judge(options.judge); }; });
}

void add_result(CLI::App& app, Options& options, Command& chosen) {
    auto* result = app.add_subcommand("result", "E, A, R, B, M of a run, each with its U");
    result->add_option("RUN", options.result.run, "run id or run file; default: the newest run");
    result->add_option("--config", options.config, "station file: where the runs lie")
        ->capture_default_str();
    auto* limits =
        result->add_option("--tolerances", options.result.tolerances,
                           "limits as JSON, as in a case (docs/analysis/positioning.md)");
    result
        ->add_option(
            "--travel", options.result.travel,
            "of the axis, mm or degrees, for the limits' bands; default: the targets' span")
        ->needs(limits);
    teach(*result, result_footer, {exit_ok, exit_usage, exit_refused});
    result->callback([&] {
        chosen = [&] {
            options.result.station_file = options.config;
            return command_result(options.result, options.json);
        };
    });
}

void add_budget(CLI::App& app, Options& options, Command& chosen) {
    auto* budget = app.add_subcommand("budget", "What U of a run is made of, input by input");
    budget->add_option("RUN", options.budget.run, "run id or run file; default: the newest run");
    budget->add_option("--config", options.config, "station file: where the runs lie")
        ->capture_default_str();
    teach(*budget, budget_footer, {exit_ok, exit_usage, exit_refused});
    budget->callback([&] {
        chosen = [&] {
            options.budget.station_file = options.config;
            return command_budget(options.budget, options.json);
        };
    });
}

void add_program(CLI::App& app, Options& options, Command& chosen) {
    auto* program = app.add_subcommand("program", "Write the part program of the planned cycle");
    program->add_option("--config", options.config, "station file")->capture_default_str();
    program->add_option("--dialect", options.program.dialect,
                        "linuxcnc or marlin; default linuxcnc");
    program->add_option("--out", options.program.out_directory, "folder for the files")
        ->default_val(".");
    program->add_option(
        "--seed", options.program.seed,
        "seed of the targets' random parts; default: the station file's, or a new one");
    auto* retake =
        program->add_option("--retake", options.program.run_file,
                            "run file: write the program of the points that are to be taken again");
    retake->check(CLI::ExistingFile);
    program
        ->add_flag("--datum-by-cnc", options.program.datum_by_cnc,
                   "begin with the prepare command, for 'axiscal arm --datum-by-cnc' (trigger "
                   "shape sequence-block)")
        ->excludes(retake);
    teach(*program, program_footer, {exit_ok, exit_failed, exit_usage, exit_refused});
    program->callback([&] {
        chosen = [&] {
            options.program.station_file = options.config;
            return command_program(options.program, options.json);
        };
    });
}

void add_offline_commands(CLI::App& app, Options& options, Command& chosen) {
    auto* analyze = app.add_subcommand(
        "analyze",
        "Figures of a run file, a JSON case or a table (docs/analysis.md); told apart by content");
    analyze
        ->add_option("FILE", options.file,
                     "RUN.axiscal, CASE.json or TABLE.csv; - reads a case from standard input")
        ->required();
    teach(*analyze, analyze_footer, {exit_ok, exit_failed, exit_usage, exit_refused});
    analyze->callback([&] { chosen = [&] { return command_analyze(options.file); }; });

    auto* new_case = app.add_subcommand("case", "A table to be filled in for axiscal analyze");
    new_case->add_option("ACTION", options.new_case.action, "new")
        ->required()
        ->check(CLI::IsMember({"new"}));
    new_case->add_option("KIND", options.new_case.kind, "positioning, circular or workpiece")
        ->required()
        ->check(CLI::IsMember({"positioning", "circular", "workpiece"}));
    new_case->add_option("--csv", options.new_case.path, "file to be written; must not be there")
        ->required();
    teach(*new_case, case_footer, {exit_ok, exit_failed, exit_usage, exit_refused});
    new_case->callback([&] { chosen = [&] { return command_case_new(options.new_case); }; });

    add_import(app, options, chosen);
    add_result(app, options, chosen);
    add_budget(app, options, chosen);
    add_program(app, options, chosen);

    auto* write = app.add_subcommand(
        "export", "certificate.json, .csv and .pdf of a closed run file, or of a circular case");
    write->add_option("RUN", options.file, "run file, or the JSON of a circular case")->required();
    write->add_option("--out", options.out, "folder to write into")->capture_default_str();
    write
        ->add_option(
            "--format", options.format,
            "certificate, or the readings alone for other programs: rtl (Laser10 text) or csv")
        ->check(CLI::IsMember({"certificate", "rtl", "csv"}))
        ->capture_default_str();
    teach(*write, export_footer, {exit_ok, exit_failed, exit_usage, exit_refused});
    write->callback([&] {
        chosen = [&] {
            if (options.format == "certificate")
                return command_export(options.file, options.out, options.json);
            return command_export_readings(options.file, options.out, options.format, options.json);
        };
    });

    auto* verify = app.add_subcommand(
        "verify", "Is a run file what was written? Names each changed, missing or added row");
    verify->add_option("RUN", options.file, "run file")->required();
    verify->add_option("--certificate", options.against.certificate,
                       "certificate.json to hold against it; default: the one beside it, if it is "
                       "of the same run");
    verify->add_option("--public-key", options.against.public_keys,
                       "public-keys.pem of the station, which came by another way than the run "
                       "file; default: no signature is called good");
    verify->add_option("--receipt", options.against.receipt,
                       "receipt.json of the publisher: what was published earlier of this run");
    teach(*verify, verify_footer, {exit_ok, exit_failed, exit_usage, exit_refused, exit_changed});
    verify->callback([&] {
        chosen = [&] { return command_verify(options.file, options.against, options.json); };
    });

    auto* check = app.add_subcommand("check-config",
                                     "Every refusal of a station file at once, with its line");
    check->add_option("FILE", options.config, "station file")->capture_default_str();
    teach(*check, check_config_footer, {exit_ok, exit_usage, exit_refused});
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
origin of their figures. See docs/conformance.md.)";

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
    teach(*command, conformance_footer,
          {exit_ok, exit_failed, exit_usage, exit_refused, exit_disagrees});
    command->callback(
        [&] { chosen = [&] { return command_conformance(options.conformance, options.json); }; });
}

} // namespace

void add_paper_commands(CLI::App& app, Options& options, Command& chosen) {
    add_offline_commands(app, options, chosen);
    add_conformance_command(app, options, chosen);
}

} // namespace axiscal
