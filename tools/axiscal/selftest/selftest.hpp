#pragma once
// `axiscal selftest`: what this computer adds to a measurement by its disk, its clock and its
// serial lines, measured here and now and said in words. Blocking.

#include "analysis/quantity/result.hpp"

#include <optional>
#include <string>
#include <vector>

namespace axiscal {

/// Of one kind of delay, in microseconds.
struct Delays {
    int count = 0;
    double median_us = 0, p99_us = 0, worst_us = 0;
};
/// @param samples_us any order; empty gives zeros. p99 is the value that 99 of 100 do not exceed.
Delays delays_of(std::vector<double> samples_us);

/// What it means, by a limit that was not kept; `ok` false: somebody should act.
struct SelftestVerdict {
    bool ok = true;
    std::string sentence;
};

struct SerialPort {
    std::string path;
    std::optional<int> latency_timer_ms; ///< of an FTDI adapter
    std::string refused;                 ///< why the port cannot be used
};

struct SelfTest {
    std::string folder;
    Delays commit; ///< one event made durable in a run file in `folder`
    Delays timer;  ///< lateness of a wake-up due each millisecond
    Delays serial; ///< a byte through a pseudo terminal, from its write to the end of its read
    std::vector<SerialPort> ports;
};

/// A commit below this was hardly on a disk: fdatasync of the fastest measured disk took 70 us.
inline constexpr double least_commit_us = 30;
/// Above this the CNC's cycle waits visibly; a spinning disk gives 8 to 15 ms.
inline constexpr double slow_commit_us = 20'000;
/// Travel in micrometres that one microsecond makes up at 1000 mm/min.
inline constexpr double um_per_us_at_1000_mm_per_min = 1.0 / 60.0;

SelftestVerdict judge_commit(const Delays& commit);
SelftestVerdict judge_timer(const Delays& timer);
SelftestVerdict judge_serial(const Delays& serial);
SelftestVerdict judge_port(const SerialPort& port);

/// Median and worst of `count` commits into a run file of its own, removed afterwards.
/// @errors Fault::io, Fault::not_durable naming the folder.
Result<Delays> measure_commit(const std::string& folder, int count);
/// @errors Fault::io.
Result<Delays> measure_timer(int count);
Result<Delays> measure_serial(int count);
SerialPort look_at_port(const std::string& path);

} // namespace axiscal
