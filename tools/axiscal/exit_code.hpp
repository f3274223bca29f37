#pragma once

namespace axiscal {

/// What the command line tells the shell; `axiscal --help` lists them.
enum ExitCode : int {
    exit_ok = 0,
    exit_failed = 1, ///< a file, the disk or the program itself
    exit_usage = 2,
    exit_refused = 3,    ///< input refused: case, run file, station file
    exit_forbidden = 4,  ///< the station's state or rights forbid it
    exit_no_contact = 5, ///< no daemon at that door
    exit_incomplete = 6, ///< the run ended without all its points
    exit_disagrees = 7,  ///< a figure of the conformance kit is not what it must be
    exit_changed = 8,    ///< a run file or its certificate is not what was written
    exit_unwell = 9,     ///< the doctor found something broken
};

} // namespace axiscal
