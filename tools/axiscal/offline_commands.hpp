#pragma once
// The commands that need no daemon.

#include "acquisition/documents/run_verify.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace axiscal {

/// A run file or a JSON case, told apart by content; "-" reads a case from standard input.
/// Run: prints the certificate document. Case: the result document, exit 3 when refused.
int command_analyze(const std::string& path);

struct NewCaseOrder {
    std::string action, kind, path;
};
/// Writes a table to be filled in; overwrites nothing.
int command_case_new(const NewCaseOrder& order);

struct ImportOrder {
    std::vector<std::string> files;
    std::string map, out;    ///< empty: none; standard output
    std::string certificate; ///< folder for run file and certificate; empty: none
};
/// Files of other programs as cases, or as run files with their certificates (docs/import.md);
/// overwrites nothing.
int command_import(const ImportOrder& order, bool json);

struct JudgeOrder {
    std::string document, report;
};
/// Holds a published report against the case of its readings. Exit 8 when they differ.
int command_judge(const JudgeOrder& order);

struct ResultRequest {
    std::string run;              ///< path or id; empty: the newest run of the station
    std::string station_file;     ///< whose state directory holds the runs
    std::string tolerances;       ///< JSON of limits; empty: no verdicts
    std::optional<double> travel; ///< mm or degrees, for the band; absent: span of the targets
};
/// E, A, R, B, M with U; exit 3 wherever there is no result.
int command_result(const ResultRequest& request, bool json);

struct BudgetRequest {
    std::string run;          ///< path or id; empty: the newest run of the station
    std::string station_file; ///< whose state directory holds the runs
};
/// Inputs, terms and U of a run's uncertainty budget; exit 3 wherever there is none.
int command_budget(const BudgetRequest& request, bool json);

struct ProgramRequest {
    std::string station_file, dialect,
        out_directory; ///< dialect empty: linuxcnc, or marlin is named
    std::optional<std::uint64_t> seed;
    std::string run_file;      ///< not empty: the points of it that are to be taken again
    bool datum_by_cnc = false; ///< the program begins with prepare
};
/// Writes one file a pass and says how to arm it.
int command_program(const ProgramRequest& request, bool json);

/// certificate.json, .csv and .pdf of a closed run, or of a circular case, into
/// `out_directory`/<run-id>/, by axiscal-report; its line of JSON, or the same for people, names
/// the files.
int command_export(const std::string& file, const std::string& out_directory, bool json);

/// The readings of a positioning run for other programs, `format` "rtl" or "csv", into
/// `folder`/<run-id>.<format>.
int command_export_readings(const std::string& file,
                            const std::string& folder,
                            const std::string& format,
                            bool json);

/// Holds a run file against its hash chain, its certificate, the station's keys and a receipt. Exit
/// 8 when something is not what was written, signed or published; each is named.
int command_verify(const std::string& run_file, const VerifyAgainst& against, bool json);

struct SelfTestRequest {
    std::string folder;             ///< of the state: there the disk is measured
    std::vector<std::string> ports; ///< serial ports to be looked at
    int count = 200;                ///< trials of each kind
};
/// Measures this computer and says what it means. Exit 1 when it cannot be measured.
int command_selftest(const SelfTestRequest& request, bool json);

/// Every refusal of the station file at once, with file:line.
int command_check_config(const std::string& station_file, bool json);

} // namespace axiscal
