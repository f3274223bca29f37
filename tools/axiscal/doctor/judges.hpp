#pragma once
// What the figures that the doctor reads mean. Pure.

#include <cstdint>
#include <string>
#include <vector>

namespace axiscal {

enum class Health : std::uint8_t {
    good,
    note,  ///< works; a person should know
    broken ///< a measurement fails, or is lost, until it is mended
};

struct Finding {
    Health health = Health::good;
    std::string area; ///< "clock", "disk", "wire", ...
    std::string what; ///< one sentence
    std::string mend; ///< one line: what to do; empty when there is nothing to do
};

struct ClockReading {
    bool synchronised = false;  ///< as adjtimex(2) says
    double largest_error_s = 0; ///< its maxerror
    std::string source;         ///< the kernel's clock source: "tsc"
    bool ran_back = false;      ///< the monotonic clock, between two readings
    int year = 0;               ///< of the wall clock, UTC
};
std::vector<Finding> judge_clock(const ClockReading& clock);

struct DiskReading {
    std::string folder;
    long kind = 0; ///< f_type of statfs(2)
    double free_bytes = 0;
    bool names_left = true; ///< inodes
};
std::vector<Finding> judge_disk(const DiskReading& disk);

/// What became of a trial to listen there.
enum class PortTrial : std::uint8_t { free, taken, no_right, no_address, failed };
struct PortReading {
    std::string purpose; ///< "the CNC's Modbus port"
    std::string host;
    int port = 0;
    PortTrial trial = PortTrial::free;
    bool daemon_answers = false;
    /// The trial was made by root, who may listen below 1024 as the service may not.
    bool tried_by_root = false;
};
Finding judge_port_trial(const PortReading& port);

enum class ModuleState : std::uint8_t { loaded, available, missing, unknown };
/// @param needed_by the instrument of the station that cannot do without; empty: none. A state that
/// is not known counts as missing.
Finding judge_module(const std::string& name,
                     const std::string& serves,
                     ModuleState state,
                     const std::string& needed_by);

} // namespace axiscal
