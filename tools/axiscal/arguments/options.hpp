#pragma once
// What a person wrote behind `axiscal`: one record for every command, and who fills it.

#include "tools/axiscal/align_command.hpp"
#include "tools/axiscal/conformance.hpp"
#include "tools/axiscal/daemon_commands.hpp"
#include "tools/axiscal/devices_command.hpp"
#include "tools/axiscal/doctor_command.hpp"
#include "tools/axiscal/drift_command.hpp"
#include "tools/axiscal/exit_code.hpp"
#include "tools/axiscal/offline_commands.hpp"
#include "tools/axiscal/pair_command.hpp"
#include "tools/axiscal/probing_command.hpp"
#include "tools/axiscal/station_command.hpp"
#include "tools/axiscal/tape_commands.hpp"

#include <CLI/CLI.hpp>

#include <functional>
#include <map>

namespace axiscal {

struct Options {
    bool json = false;
    DoorAddress door{"/run/axiscal/axiscald.sock", "", ""};
    std::string config = "/etc/axiscal/station.toml";
    std::string file, out = ".", format = "certificate", reason, by;
    VerifyAgainst against;
    double reading_arcsec = 0;
    bool until_published = false, drivers = false;
    ArmOrder arm;
    AlignOrder align;
    DriftOrder drift;
    PairOrder pair;
    ProbingOrder probing;
    std::vector<std::string> statements, overrides, kind_options;
    RevisionOrder revision;
    bool exclude_instead = false;
    FindingAnswer finding_answer;
    ProgramRequest program;
    NewCaseOrder new_case;
    ImportOrder foreign;
    JudgeOrder judge;
    ResultRequest result;
    BudgetRequest budget;
    ConformanceOrder conformance;
    DevicesRequest devices;
    DoctorRequest doctor;
    NewStationRequest new_station;
    RecordRequest record;
    TapeRequest tape;
    ReplayRequest replay;
    SelfTestRequest selftest{"/var/lib/axiscal", {}, 200};
};

/// What will be done once every word is read; its result is the exit code.
using Command = std::function<int()>;

/// Each adds the commands of one subject to `app`; the one that was called is put into `chosen`.
void add_run_commands(CLI::App& app, Options& options, Command& chosen);
void add_rest_commands(CLI::App& app, Options& options, Command& chosen);
void add_pair_command(CLI::App& app, Options& options, Command& chosen);
void add_probing_commands(CLI::App& app, Options& options, Command& chosen);
void add_instrument_commands(CLI::App& app, Options& options, Command& chosen);
void add_tape_commands(CLI::App& app, Options& options, Command& chosen);
void add_station_commands(CLI::App& app, Options& options, Command& chosen);
void add_paper_commands(CLI::App& app, Options& options, Command& chosen);

/// "Exit codes: 0 done; ...", each in the words that every command has for it, in lines of 100
/// columns.
std::string exit_codes_text(const std::vector<ExitCode>& codes);
/// The end of `command --help`: `text`, which begins with an example, then the codes that can
/// occur.
void teach(CLI::App& command, const std::string& text, const std::vector<ExitCode>& codes);

/// The daemon that `options` names.
StationClient client_of(Options& options);
/// --socket, --host, --token-file and --timeout. A token file that gives no token ends the reading
/// of the words with CLI::FileError.
void daemon_options(CLI::App& command, Options& options);
/// "KEY=TEXT" words into `into`. False when one has no '='.
bool split_at_equals(const std::vector<std::string>& given,
                     std::map<std::string, std::string>& into);
/// --state-that, --override and --option into the arm order; tells what is wrong.
/// @returns an exit code
int split_statements(Options& options);

} // namespace axiscal
