#pragma once
// `axiscal record`, `replay` and `tape`: what passes over an instrument's wire, kept, played, looked
// into.

#include <string>

namespace axiscal {

struct RecordRequest {
    std::string station_file = "/etc/axiscal/station.toml";
    std::string instrument; ///< its name in the station file
    std::string raw; ///< "serial:/dev/ttyUSB0", "tcp:host:port": listen there, without a station file
    int baud = 115200;
    std::string frame = "8N1"; ///< data bits, parity, stop bits of that serial line
    std::string tape;       ///< file to be written; an existing one is refused
    double seconds = 30;
    std::string who, what; ///< for the header
    std::string origin = "device";
};
/// Runs the unmodified driver on the instrument's own wire, which axiscald must not hold. Exit 1
/// when nothing came, 3 when the station file is refused or has no such instrument.
int command_record(const RecordRequest& request, bool json);
/// Listens on `raw` and writes nothing to it. Exit 1 when nothing came, 2 for a link that is none.
int command_record_raw(const RecordRequest& request, bool json);

struct TapeRequest {
    std::string action, tape; ///< "check", "keep"
    std::string name, folder = "tests/traces";
};
/// check: what the tape holds, and what of it is private. keep: the tape and what its driver makes of
/// it as NAME.tape and NAME.expected in the folder; overwrites nothing. Exit 3 when it is no tape.
int command_tape(const TapeRequest& request, bool json);

struct ReplayRequest {
    std::string tape;
    std::string wire; ///< "pty", "tcp"; empty: as it was recorded
    std::string link; ///< pty: symbolic link to it
    int port = 0;     ///< tcp: 0 for a free one
    bool fast = false, hold = false;
    bool print = false;
    std::string expected, rebuild; ///< expectation to be compared with, or to be written
    std::string block; ///< name of an instrument: print its block of a station file and end
};
/// Plays on a wire, or, with `print`, `expected` or `rebuild`, through the driver in this process
/// and in virtual time. Exit 3 when the tape is none, 7 when an expectation is not met or the other
/// side writes what the tape does not have.
int command_replay(const ReplayRequest& request, bool json);

} // namespace axiscal
