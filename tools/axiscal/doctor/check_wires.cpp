// Each instrument of the station: plugged in, usable by the service, its certificate good.
#include "config/certificate_dates.hpp"
#include "tools/axiscal/doctor/doctor.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string_view>

namespace axiscal {
namespace {

constexpr std::int64_t warning_ns = 30LL * 24 * 3600 * 1'000'000'000; // 30 days: time to send it in

Finding finding_of(const Obstacle& obstacle, const std::string& name) {
    return {obstacle.stops ? Health::broken : Health::note, "wire",
            "\"" + name + "\": " + obstacle.what, obstacle.mend};
}

void check_device(const PluggedDevice& device,
                  const std::string& name,
                  const Account& service,
                  std::vector<Finding>& found) {
    const auto list = obstacles(device, service);
    for (const Obstacle& obstacle : list)
        found.push_back(finding_of(obstacle, name));
    if (list.empty())
        found.push_back(
            {Health::good, "wire", "\"" + name + "\" is plugged in at " + device.place, ""});
}

/// Each device that the entry may mean, its rights too. The note stays beside what is broken: of
/// several, the one that is meant may be the other one.
/// @returns whether there is any
bool check_possible(const StationWires::Entry& entry,
                    const std::vector<PluggedDevice>& plugged,
                    const CheckedSystem& checked,
                    std::vector<Finding>& found) {
    bool any = false;
    for (const PluggedDevice& device : plugged) {
        const auto names = may_be(device, checked.wires);
        if (std::ranges::find(names, entry.name) == names.end()) continue;
        any = true;
        for (const Obstacle& obstacle : obstacles(device, checked.service))
            found.push_back(finding_of(obstacle, entry.name));
        found.push_back({Health::note, "wire",
                         "\"" + entry.name + "\" (" + entry.link + ") may be the one at " +
                             device.place +
                             ": its serial number can be read only when it is opened",
                         "start axiscald, then axiscal devices shows whether it is this one"});
    }
    return any;
}

bool is_far(const StationWires::Entry& entry) {
    return entry.link.starts_with("tcp:");
}

Finding absent(const StationWires::Entry& entry) {
    const std::string wire = entry.link.empty() ? "its sensors" : entry.link;
    return {Health::broken, "wire", "\"" + entry.name + "\" is not plugged in: " + wire,
            "axiscal devices shows what is plugged in; plug it in, or correct its link"};
}

/// A terminal that is there without hardware that the kernel could tell of (a pseudo terminal, a
/// radio link).
std::optional<PluggedDevice> bare_terminal(const std::string& path) {
    std::error_code error;
    if (path.empty() || !std::filesystem::exists(path, error)) return std::nullopt;
    PluggedDevice device;
    device.place = device.node = path;
    return device;
}

std::string path_of(const std::string& link) {
    constexpr std::string_view prefix = "serial:";
    return link.starts_with(prefix) ? link.substr(prefix.size()) : "";
}

const PluggedDevice* device_of(const std::string& name,
                               const std::vector<PluggedDevice>& plugged,
                               const StationWires& wires) {
    const auto found = std::ranges::find_if(
        plugged, [&](const PluggedDevice& device) { return known_as(device, wires) == name; });
    return found == plugged.end() ? nullptr : &*found;
}

/// Alone: two instruments of one Modbus line share its device.
StationWires only(const StationWires::Entry& entry) {
    return {{entry}, ""};
}

} // namespace

std::vector<Finding> check_wires(const CheckedSystem& checked, const DoctorPlaces& places) {
    const auto plugged = list_plugged(places.kernel);
    std::vector<Finding> found;
    for (const StationWires::Entry& entry : checked.wires.instruments) {
        if (is_far(entry)) {
            found.push_back({Health::good, "wire",
                             "axiscald reads \"" + entry.name + "\" over the network (" +
                                 entry.link + "): axiscal devices shows whether it answers",
                             ""});
            continue;
        }
        if (const PluggedDevice* device = device_of(entry.name, plugged, only(entry)))
            check_device(*device, entry.name, checked.service, found);
        else if (const auto bare = bare_terminal(path_of(entry.link)))
            check_device(*bare, entry.name, checked.service, found);
        else if (!check_possible(entry, plugged, checked, found))
            found.push_back(absent(entry));
    }
    if (checked.wires.trigger_line.empty()) return found;
    const StationWires line{{}, checked.wires.trigger_line};
    if (const PluggedDevice* device = device_of("trigger", plugged, line))
        check_device(*device, "trigger", checked.service, found);
    else if (const auto bare = bare_terminal(checked.wires.trigger_line))
        check_device(*bare, "trigger", checked.service, found);
    else
        found.push_back(
            {Health::broken, "wire",
             "the CNC's serial line " + checked.wires.trigger_line + " does not exist on this PC",
             "axiscal devices shows what is plugged in; plug it in, or correct serial_port"});
    return found;
}

std::vector<Finding> check_certificates(const StationConfig& config, std::int64_t utc_ns) {
    const std::string today = iso8601_utc(utc_ns).substr(0, 10);
    const std::string soon = iso8601_utc(utc_ns + warning_ns).substr(0, 10);
    std::vector<Finding> found;
    for (const Refusal& past : expired_certificates(config, today))
        found.push_back({Health::broken, "certificate", past.reason,
                         "have it calibrated, then write its new dates"});
    for (const InstrumentConfig& instrument : config.instruments)
        if (!instrument.due_on.empty() && instrument.due_on >= today && instrument.due_on < soon)
            found.push_back(
                {Health::note, "certificate",
                 "the certificate of \"" + instrument.name + "\" ends on " + instrument.due_on,
                 "plan its calibration"});
    if (found.empty())
        found.push_back({Health::good, "certificate",
                         "no certificate of an instrument ends within 30 days", ""});
    return found;
}

} // namespace axiscal
