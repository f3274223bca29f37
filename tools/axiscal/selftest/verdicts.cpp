// What the figures of a self-test mean for a measurement.
#include "tools/axiscal/selftest/selftest.hpp"

#include <algorithm>
#include <cstdio>

namespace axiscal {
namespace {

/// "0.21 ms" or "35 us".
std::string in_ms_or_us(double us) {
    char text[32];
    if (us >= 100)
        std::snprintf(text, sizeof text, "%.3g ms", us / 1000);
    else
        std::snprintf(text, sizeof text, "%.3g us", us);
    return text;
}

std::string travel_of(double us) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g um", us * um_per_us_at_1000_mm_per_min);
    return text;
}

} // namespace

Delays delays_of(std::vector<double> samples_us) {
    Delays delays;
    delays.count = static_cast<int>(samples_us.size());
    if (samples_us.empty()) return delays;
    std::ranges::sort(samples_us);
    const std::size_t last = samples_us.size() - 1;
    delays.median_us = samples_us[last / 2];
    delays.p99_us = samples_us[last * 99 / 100];
    delays.worst_us = samples_us[last];
    return delays;
}

SelftestVerdict judge_commit(const Delays& commit) {
    if (commit.median_us < least_commit_us)
        return {false,
                "The disk answers in " + in_ms_or_us(commit.median_us) +
                    ": no disk writes so fast, so it acknowledges from a cache, or the folder "
                    "lies in memory. A power cut can take points that the CNC was told are "
                    "safe. Put the state directory on a real disk with write-through."};
    if (commit.median_us > slow_commit_us)
        return {false, "Each point holds the CNC " + in_ms_or_us(commit.median_us) +
                           " longer than it must: a slow disk or a network folder. Nothing is lost "
                           "by it. A local SSD takes below 1 ms."};
    return {true, "After its window a point takes " + in_ms_or_us(commit.median_us) +
                      " to be on disk, at worst " + in_ms_or_us(commit.worst_us) +
                      "; the CNC waits that long for its answer. No reading waits for it."};
}

SelftestVerdict judge_timer(const Delays& timer) {
    const std::string moving = "A moving axis at 1000 mm/min travels " + travel_of(timer.p99_us) +
                               " in it, unless the instrument numbers its own samples.";
    if (timer.p99_us > 5000)
        return {false,
                "The computer wakes up to " + in_ms_or_us(timer.worst_us) +
                    " late (99 of 100: " + in_ms_or_us(timer.p99_us) +
                    "): it is busy with something else. Points at rest are not harmed, their "
                    "window is searched in the samples. " +
                    moving};
    return {true, "The computer wakes " + in_ms_or_us(timer.median_us) +
                      " late, 99 of 100 times within " + in_ms_or_us(timer.p99_us) + ", at worst " +
                      in_ms_or_us(timer.worst_us) +
                      ". Points at rest do not feel it: their window is searched in the samples. " +
                      moving};
}

SelftestVerdict judge_serial(const Delays& serial) {
    return {serial.p99_us <= 5000,
            "A byte needs " + in_ms_or_us(serial.median_us) +
                " from the kernel to the program, 99 of "
                "100 within " +
                in_ms_or_us(serial.p99_us) + ", at worst " + in_ms_or_us(serial.worst_us) +
                ". The adapter's own hold-back comes on top: name your ports to see it."};
}

SelftestVerdict judge_port(const SerialPort& port) {
    if (!port.refused.empty())
        return {false, port.path + " cannot be used: " + port.refused +
                           ". Is it plugged in, and is this user in its group?"};
    if (!port.latency_timer_ms)
        return {true, port.path + " is no FTDI adapter with a latency timer: what it holds back is "
                                  "not known here."};
    const double held_us = 1000.0 * *port.latency_timer_ms;
    if (*port.latency_timer_ms > 1)
        return {false, port.path + " holds bytes back for up to " +
                           std::to_string(*port.latency_timer_ms) + " ms: " + travel_of(held_us) +
                           " at 1000 mm/min. Install systemd/70-axiscal.rules, or write 1 to its "
                           "latency_timer."};
    return {true, port.path + " holds bytes back for 1 ms at most: " + travel_of(held_us) +
                      " at 1000 mm/min, nothing at rest."};
}

} // namespace axiscal
