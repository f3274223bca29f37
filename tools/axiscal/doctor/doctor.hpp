#pragma once
// `axiscal doctor`: what could keep a station from measuring on this PC, and the one line that
// mends each. It looks and tries, and leaves everything as it was. Blocking.

#include "acquisition/publish/mount_points.hpp"
#include "acquisition/station/station_loader.hpp"
#include "drivers/plugged/candidates.hpp"
#include "tools/axiscal/doctor/judges.hpp"
#include "tools/axiscal/station_client.hpp"

#include <string>
#include <vector>

namespace axiscal {

/// Where the doctor looks; other folders in tests.
struct DoctorPlaces {
    KernelPlaces kernel;
    std::string modules; ///< of the running kernel: "/lib/modules/6.1.0-40-amd64"
    std::vector<std::string> fonts{"/usr/share/fonts", "/usr/local/share/fonts"};
};

/// What every check may ask.
struct CheckedSystem {
    const StationConfig* config = nullptr; ///< null: the station file was refused
    StationWires wires;
    Account service;
    bool daemon_answers = false;
    std::string daemon_version; ///< as it answers
    std::string trigger_note;   ///< what the daemon says of its trigger port
};

std::vector<Finding> check_account(const CheckedSystem& checked);
/// The wire of each instrument, and of the CNC's serial line.
std::vector<Finding> check_wires(const CheckedSystem& checked, const DoctorPlaces& places);
std::vector<Finding> check_certificates(const StationConfig& config, std::int64_t utc_ns);
std::vector<Finding> check_clock(const DoctorPlaces& places);
/// The state directory: rights, space, file system, one durable commit where the caller may write.
std::vector<Finding> check_disk(const CheckedSystem& checked);
/// Files in it that the service may not write and that are not its own; none: no finding.
std::vector<Finding> check_owners(const std::string& folder, const Account& service);
/// The destination: there, mounted where a file of the system says so, writable; the publisher.
std::vector<Finding>
check_share(const CheckedSystem& checked, std::int64_t utc_ns, const MountPlaces& mounts = {});
/// The secret of the webhook, and what waits for its receiver; none without [webhook].
std::vector<Finding> check_webhook(const CheckedSystem& checked);
/// Sockets: the Modbus port of the CNC, the port of the console.
std::vector<Finding> check_ports(const CheckedSystem& checked);
std::vector<Finding> check_modules(const CheckedSystem& checked, const DoctorPlaces& places);
std::vector<Finding> check_papers(const DoctorPlaces& places);

} // namespace axiscal
