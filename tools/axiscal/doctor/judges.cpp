#include "tools/axiscal/doctor/judges.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <linux/magic.h>
#include <string_view>

namespace axiscal {
namespace {

/// Before the first release of this program no certificate can have been made.
constexpr int first_year = 2026;
/// A run of 110 points takes 0.3 MB, an hour of a 1 kHz stream about 30 MB.
constexpr double least_free = 200e6, comfortable_free = 2e9;
/// The kernel's bound on the clock's error, when it is synchronised; a certificate prints seconds.
constexpr double usable_error_s = 1;

struct FileSystem {
    long kind;
    std::string_view name;
    Health health;
    std::string_view why;
};
constexpr std::string_view in_memory = "everything on it is gone after a power cut";
constexpr std::string_view far_away =
    "it is on another computer, where this PC cannot make a point durable";
constexpr std::string_view no_rights = "it has no owners and no journal";
constexpr std::array file_systems{
    FileSystem{EXT4_SUPER_MAGIC, "ext4", Health::good, ""},
    FileSystem{XFS_SUPER_MAGIC, "xfs", Health::good, ""},
    FileSystem{BTRFS_SUPER_MAGIC, "btrfs", Health::good, ""},
    FileSystem{F2FS_SUPER_MAGIC, "f2fs", Health::good, ""},
    FileSystem{TMPFS_MAGIC, "tmpfs", Health::broken, in_memory},
    FileSystem{RAMFS_MAGIC, "ramfs", Health::broken, in_memory},
    FileSystem{NFS_SUPER_MAGIC, "nfs", Health::broken, far_away},
    FileSystem{0xFF534D42, "cifs", Health::broken, far_away},
    FileSystem{0xFE534D42, "smb", Health::broken, far_away},
    FileSystem{MSDOS_SUPER_MAGIC, "fat", Health::broken, no_rights},
    FileSystem{0x2011BAB0, "exfat", Health::broken, no_rights},
    FileSystem{OVERLAYFS_SUPER_MAGIC, "overlay", Health::note,
               "it belongs to a container and goes with it"},
    FileSystem{FUSE_SUPER_MAGIC, "fuse", Health::note,
               "a program serves it: whether a commit is durable is that program's to know"},
};

std::string amount(double bytes) {
    char text[32];
    std::snprintf(text, sizeof text, bytes < 10e9 ? "%.2f GB" : "%.0f GB", bytes * 1e-9);
    return text;
}

Finding judge_file_system(const DiskReading& disk) {
    const auto row = std::ranges::find(file_systems, disk.kind, &FileSystem::kind);
    if (row == file_systems.end())
        return {Health::note, "disk", disk.folder + " lies on a file system that is not known here",
                "axiscal selftest measures its commits"};
    if (row->health == Health::good)
        return {Health::good, "disk", disk.folder + " lies on " + std::string{row->name}, ""};
    return {row->health, "disk",
            disk.folder + " lies on " + std::string{row->name} + ": " + std::string{row->why},
            "set station.state_directory to a folder on a disk of this PC (ext4)"};
}

Finding judge_space(const DiskReading& disk) {
    const std::string left = disk.folder + " has " + amount(disk.free_bytes) + " left";
    const std::string mend =
        "back up old run files from " + disk.folder + "/runs, then remove them";
    if (!disk.names_left)
        return {Health::broken, "disk", disk.folder + " has no file names (inodes) left", mend};
    if (disk.free_bytes < least_free) return {Health::broken, "disk", left, mend};
    if (disk.free_bytes < comfortable_free) return {Health::note, "disk", left, mend};
    return {Health::good, "disk", left, ""};
}

std::string place_of(const PortReading& port) {
    return port.purpose + " " + port.host + ":" + std::to_string(port.port);
}

} // namespace

std::vector<Finding> judge_clock(const ClockReading& clock) {
    std::vector<Finding> found;
    if (clock.ran_back || clock.source == "jiffies" || clock.source == "refined-jiffies")
        found.push_back({Health::broken, "clock",
                         "the monotonic clock (" + clock.source +
                             ") cannot show which of two samples came first",
                         "start this PC without the kernel option clocksource=, and enable HPET or "
                         "TSC in its BIOS"});
    else
        found.push_back({Health::good, "clock", "the monotonic clock runs on " + clock.source, ""});
    const std::string mend = "sudo timedatectl set-ntp true; without a network, set it by hand: "
                             "sudo timedatectl set-time";
    if (clock.year < first_year)
        found.push_back({Health::broken, "clock",
                         "the date is wrong: it is not the year " + std::to_string(clock.year),
                         mend});
    else if (!clock.synchronised || clock.largest_error_s > usable_error_s)
        found.push_back(
            {Health::note, "clock",
             "no time server sets the date: certificates show the time of this PC's own clock",
             mend});
    else
        found.push_back({Health::good, "clock", "a time server sets the date of this PC", ""});
    return found;
}

std::vector<Finding> judge_disk(const DiskReading& disk) {
    return {judge_file_system(disk), judge_space(disk)};
}

namespace {

/// ip(7), ip_unprivileged_port_start.
constexpr int first_port_for_all = 1024;

Finding no_right_to_port(const std::string& place) {
    return {Health::note, "port",
            place + " is below 1024: the service needs a right that it does not have by itself",
            "take a port above 1023, or give CAP_NET_BIND_SERVICE as install.md says"};
}

} // namespace

Finding judge_port_trial(const PortReading& port) {
    const std::string place = place_of(port);
    switch (port.trial) {
    case PortTrial::free:
        if (port.tried_by_root && port.port < first_port_for_all && !port.daemon_answers)
            return no_right_to_port(place);
        if (port.daemon_answers)
            return {Health::broken, "port", place + " is not open, although axiscald runs",
                    "sudo systemctl restart axiscald, then: journalctl -u axiscald"};
        return {Health::good, "port", place + " is free for axiscald", ""};
    case PortTrial::taken:
        if (port.daemon_answers)
            return {Health::good, "port", place + " is in use while axiscald runs", ""};
        return {Health::broken, "port", place + " is in use by another program",
                "sudo ss -ltnp 'sport = :" + std::to_string(port.port) + "' names it"};
    case PortTrial::no_right: return no_right_to_port(place);
    case PortTrial::no_address:
        return {Health::broken, "port", place + ": no network card of this PC has that address",
                "ip -brief address shows what there is; write one of them as host"};
    case PortTrial::failed: break;
    }
    return {Health::broken, "port", place + " cannot be opened", "ip -brief address"};
}

Finding judge_module(const std::string& name,
                     const std::string& serves,
                     ModuleState state,
                     const std::string& needed_by) {
    const std::string subject = "kernel module " + name + " (" + serves + ")";
    switch (state) {
    case ModuleState::loaded: return {Health::good, "kernel", subject + " is loaded", ""};
    case ModuleState::available:
        return {Health::good, "kernel", subject + " is there and loads when it is needed", ""};
    case ModuleState::unknown:
    case ModuleState::missing: break;
    }
    const std::string build =
        name == "counter" ? "; Debian's stock kernel does not build that subsystem" : "";
    if (needed_by.empty())
        return {Health::note, "kernel",
                subject + " is not in this kernel" + build +
                    "; no instrument of this station "
                    "needs it",
                ""};
    return {Health::broken, "kernel",
            subject + " is not in this kernel" + build + ", and the instrument \"" + needed_by +
                "\" needs it",
            "install a kernel that has it (Debian's linux-image-amd64, for the counter one built "
            "with CONFIG_COUNTER)"};
}

} // namespace axiscal
