// Clock, kernel modules, font and programs.
// Sources: adjtimex(2); Documentation/ABI/testing/sysfs-devices-system-clocksource; depmod(8).
#include "acquisition/measurement/certificate_writer.hpp"
#include "tools/axiscal/doctor/doctor.hpp"

#include <algorithm>
#include <array>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <sys/timex.h>
#include <unistd.h>

namespace axiscal {
namespace {

namespace fs = std::filesystem;

constexpr int clock_readings = 1000; // of a clock that runs back, one in thousands is enough to see

bool monotonic_clock_runs_back() {
    timespec last{}, now{};
    ::clock_gettime(CLOCK_MONOTONIC, &last);
    for (int i = 0; i < clock_readings; ++i, last = now) {
        ::clock_gettime(CLOCK_MONOTONIC, &now);
        if (now.tv_sec < last.tv_sec || (now.tv_sec == last.tv_sec && now.tv_nsec < last.tv_nsec))
            return true;
    }
    return false;
}

struct Module {
    const char *name, *serves, *driver; ///< driver: how its name begins; empty: none needs it
};
constexpr std::array modules{
    Module{"ftdi_sio", "FTDI serial adapters", ""},
    Module{"cdc_acm", "USB instruments with a serial port of their own", ""},
    Module{"usbhid", "TEMPer sticks", "temper"},
    Module{"ch341", "TEMPerX232 sticks", "temper-serial"},
    Module{"gs_usb", "CAN adapters of the candleLight kind", ""},
    Module{"can_raw", "instruments on a CAN bus", "canopen"},
    Module{"ds2490", "1-Wire adapter DS9490R", "ds18b20"},
    Module{"w1_therm", "1-Wire thermometers", "ds18b20"},
    Module{"counter", "A-quad-B counters", "counter"},
};

/// "cdc_acm" of "kernel/drivers/usb/class/cdc-acm.ko.xz: ...".
std::string module_of(const std::string& line) {
    const std::string path = line.substr(0, line.find(':'));
    std::string name = path.substr(path.rfind('/') + 1);
    name = name.substr(0, name.find(".ko"));
    std::ranges::replace(name, '-', '_');
    return name;
}

bool is_listed(const std::string& file, const std::string& name) {
    std::ifstream list{file};
    for (std::string line; std::getline(list, line);)
        if (module_of(line) == name) return true;
    return false;
}

ModuleState state_of(const std::string& name, const DoctorPlaces& places) {
    std::error_code error;
    if (fs::exists(fs::path{places.kernel.sysfs} / "module" / name, error))
        return ModuleState::loaded;
    const std::string loadable = places.modules + "/modules.dep";
    if (!fs::exists(loadable, error)) return ModuleState::unknown;
    const bool there =
        is_listed(loadable, name) || is_listed(places.modules + "/modules.builtin", name);
    return there ? ModuleState::available : ModuleState::missing;
}

std::string needed_by(const Module& module, const StationWires& wires) {
    if (*module.driver == '\0') return "";
    for (const StationWires::Entry& entry : wires.instruments)
        if (entry.driver.starts_with(module.driver)) return entry.name;
    return "";
}

bool has_font(const std::string& folder) {
    std::error_code error;
    for (fs::recursive_directory_iterator at{folder, error}, end; !error && at != end;
         at.increment(error))
        if (at->path().filename() == "DejaVuSans.ttf") return true;
    return false;
}

} // namespace

std::vector<Finding> check_clock(const DoctorPlaces& places) {
    ClockReading clock;
    timex kernel{};
    const int state = ::adjtimex(&kernel);
    clock.synchronised = state >= 0 && state != TIME_ERROR && (kernel.status & STA_UNSYNC) == 0;
    clock.largest_error_s = 1e-6 * static_cast<double>(kernel.maxerror);
    std::ifstream source{places.kernel.sysfs +
                         "/devices/system/clocksource/clocksource0/current_clocksource"};
    if (!std::getline(source, clock.source)) clock.source = "an unknown source";
    clock.ran_back = monotonic_clock_runs_back();
    const std::time_t now = std::time(nullptr);
    tm utc{};
    ::gmtime_r(&now, &utc);
    clock.year = 1900 + utc.tm_year;
    return judge_clock(clock);
}

std::vector<Finding> check_modules(const CheckedSystem& checked, const DoctorPlaces& places) {
    std::vector<Finding> found;
    std::string unknown;
    for (const Module& module : modules) {
        const ModuleState state = state_of(module.name, places);
        if (state == ModuleState::unknown)
            unknown += (unknown.empty() ? "" : ", ") + std::string{module.name};
        else
            found.push_back(
                judge_module(module.name, module.serves, state, needed_by(module, checked.wires)));
    }
    if (!unknown.empty())
        found.push_back(
            {Health::note, "kernel",
             "this kernel has no list of its modules here (a container?); not known: " + unknown,
             "run axiscal doctor on the PC itself"});
    return found;
}

std::vector<Finding> check_papers(const DoctorPlaces& places) {
    std::vector<Finding> found;
    if (std::ranges::any_of(places.fonts, has_font))
        found.push_back(
            {Health::good, "papers", "the certificates' font DejaVu Sans is there", ""});
    else
        found.push_back({Health::broken, "papers",
                         "the font DejaVu Sans is not installed: no certificate can be printed",
                         "sudo apt-get install fonts-dejavu-core"});
    const std::string report = sibling_program("axiscal-report");
    if (::access(report.c_str(), X_OK) == 0)
        found.push_back({Health::good, "papers", report + " makes the certificates", ""});
    else
        found.push_back({Health::broken, "papers",
                         report + " is missing: it makes the certificates", "tools/install"});
    return found;
}

} // namespace axiscal
