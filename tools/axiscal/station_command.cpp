#include "tools/axiscal/station_command.hpp"

#include "acquisition/runfile/durable_file.hpp"
#include "acquisition/station/station_loader.hpp"
#include "config/json_text.hpp"
#include "drivers/registry.hpp"
#include "tools/axiscal/complaint.hpp"
#include "tools/axiscal/exit_code.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <sys/stat.h>
#include <unistd.h>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

std::string content_of(const std::string& path) {
    std::ifstream file{path, std::ios::binary};
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

/// The example that the package put there holds nothing of anybody's.
bool is_the_example(const std::string& path) {
    std::error_code unreadable;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", unreadable);
    const auto example = program.parent_path() / "../share/axiscal/station.example.toml";
    return std::filesystem::exists(example, unreadable) &&
           content_of(path) == content_of(example.string());
}

bool ask(const StationQuestion& question, StationAnswers& answers) {
    std::string& answer = answers[question.name()];
    for (;;) {
        std::cerr << question.words << " [for example " << question.example << "]: " << std::flush;
        if (!std::getline(std::cin, answer)) return false;
        const std::string complaint =
            answer.empty() ? "nothing is guessed here" : complaint_about(question, answers);
        if (complaint.empty()) return true;
        std::cerr << "  " << complaint << "\n";
    }
}

/// What is still missing is asked for on a terminal; else every missing option is told at once.
bool complete(StationAnswers& answers) {
    const bool terminal = ::isatty(STDIN_FILENO) == 1;
    std::string missing, wrong;
    for (const StationQuestion& question : station_questions()) {
        if (!is_asked(question, answers)) continue;
        if (!answers.contains(question.name())) {
            if (terminal && !ask(question, answers)) return false;
            if (!terminal)
                missing += "  --" + std::string{question.option} + "  " +
                           std::string{question.words} + ", for example \"" +
                           std::string{question.example} + "\"\n";
            continue;
        }
        const std::string complaint = complaint_about(question, answers);
        if (!complaint.empty())
            wrong += "  --" + std::string{question.option} + ": " + complaint + "\n";
    }
    if (!missing.empty()) std::cerr << "These are not guessed:\n" << missing;
    if (!wrong.empty()) std::cerr << "These would be refused:\n" << wrong;
    return missing.empty() && wrong.empty();
}

/// "PLACE=DRIVER" of the command line, by place, node or link; the link as a file's name, too.
std::string driver_stated_for(const PluggedDevice& device, std::vector<std::string>& stated) {
    const std::string file =
        device.link.starts_with("serial:") ? device.link.substr(std::strlen("serial:")) : "";
    for (const std::string& name : {device.place, device.node, device.link, file}) {
        const auto found = std::ranges::find_if(stated, [&](const std::string& one) {
            return !name.empty() && one.starts_with(name + "=");
        });
        if (found == stated.end()) continue;
        const std::string driver = found->substr(name.size() + 1);
        stated.erase(found);
        return driver;
    }
    return "";
}

std::string names_of(const std::vector<const InstrumentDriver*>& drivers) {
    std::string list;
    for (const InstrumentDriver* driver : drivers)
        list += (list.empty() ? "" : ", ") + std::string{driver->name};
    return list;
}

/// Of several drivers the one that a person at the terminal names; empty: leave it out.
std::string ask_driver(const PluggedDevice& device,
                       const std::vector<const InstrumentDriver*>& drivers) {
    if (::isatty(STDIN_FILENO) != 1) return "";
    std::string driver;
    std::cerr << device.place << " could be: " << names_of(drivers)
              << "\nwhich one [enter: leave it out]: " << std::flush;
    std::getline(std::cin, driver);
    return driver;
}

struct Chosen {
    PluggedDevice device;
    std::string driver;
};

std::vector<Chosen> choose(NewStationRequest& request, std::string& left_out) {
    std::vector<Chosen> chosen;
    const auto line = request.answers.find("trigger.serial_port");
    const std::string to_the_cnc = line == request.answers.end() ? "none" : line->second;
    for (PluggedDevice& device : list_plugged(request.places)) {
        const auto drivers = could_be(device);
        std::string driver = driver_stated_for(device, request.instruments);
        const bool of_cnc = "serial:" + to_the_cnc == device.link || to_the_cnc == device.node;
        if (of_cnc || drivers.empty()) continue;
        if (driver.empty() && drivers.size() == 1) driver = drivers.front()->name;
        if (driver.empty()) driver = ask_driver(device, drivers);
        if (driver.empty())
            left_out += "  " + device.place + " could be " + names_of(drivers) + ": --instrument " +
                        device.place + "=DRIVER adds it\n";
        else
            chosen.push_back({std::move(device), std::move(driver)});
    }
    for (const std::string& other : request.instruments) { // on a network, or not plugged in yet
        const auto equals = other.rfind('=');
        PluggedDevice device;
        device.wire = other.starts_with("tcp:") ? Wire::tcp : Wire::serial;
        device.place = device.link = other.substr(0, equals);
        if (device.link.starts_with('/')) device.link = "serial:" + device.link;
        if (equals != std::string::npos)
            chosen.push_back({std::move(device), other.substr(equals + 1)});
    }
    return chosen;
}

/// "material.profile=xy-md02" for the instrument of that name.
std::vector<std::pair<std::string, std::string>>
settings_of(const std::string& name, const std::vector<std::string>& settings) {
    std::vector<std::pair<std::string, std::string>> own;
    for (const std::string& one : settings) {
        const auto equals = one.find('=');
        if (one.starts_with(name + ".") && equals != std::string::npos)
            own.emplace_back(one.substr(name.size() + 1, equals - name.size() - 1),
                             one.substr(equals + 1));
    }
    return own;
}

Result<std::string> instrument_blocks(const std::vector<Chosen>& chosen,
                                      const std::vector<std::string>& settings,
                                      std::string& to_look_at) {
    StationWires wires;
    std::string text;
    for (const Chosen& one : chosen) {
        AXISCAL_TRY(const InstrumentDriver* driver, find_driver(one.driver));
        if (!driver->shows)
            return fail(Fault::bad_request, one.driver + " is no driver of a device: its page in "
                                                         "docs/instruments lists its lines");
        std::string block = toml_block(one.device, *driver, wires);
        const auto begin = block.find("name = \"") + 8;
        const std::string name = block.substr(begin, block.find('"', begin) - begin);
        wires.instruments.push_back({name, one.driver, one.device.link, {}});
        block = block_with(block, settings_of(name, settings));
        for (const std::string& line : examples_in(block))
            to_look_at += "  " + name + ": " + line + "\n";
        text += "\n" + block;
    }
    return text;
}

Result<void> put_aside(const std::string& path, bool force) {
    if (!std::filesystem::exists(path) || is_the_example(path)) return {};
    if (!force)
        return fail(Fault::refused, path + " is there: name another file with --out, or put this "
                                           "one aside with --force");
    return move_to_free_name(path, path + ".before");
}

/// As readable for the service as the file before it.
Result<void> write_like_before(const std::string& path, const std::string& text, bool force) {
    struct stat before {};
    const bool was_there = ::stat(path.c_str(), &before) == 0;
    AXISCAL_CHECK(put_aside(path, force));
    AXISCAL_CHECK(replace_synced(path, text));
    if (was_there && (::chown(path.c_str(), before.st_uid, before.st_gid) != 0 ||
                      ::chmod(path.c_str(), before.st_mode & 07777U) != 0))
        return fail(Fault::io, "cannot give " + path + " the rights of the file before it");
    return {};
}

std::string heading(const std::string& path) {
    return "# Station file of axiscald, made by `axiscal station new`. Every key that may stand "
           "here, and what\n# stands for one that is left out: "
           "/usr/share/axiscal/station.example.toml. After a change:\n#     axiscal check-config " +
           path + "\n";
}

int judge(const std::string& path) {
    const auto loaded = load_station(path);
    if (loaded) return exit_ok;
    std::cerr << "It is written, and refused as it stands:\n";
    return complain(loaded.error(), false);
}

} // namespace

int command_new_station(NewStationRequest request, bool json) {
    if (!complete(request.answers)) return exit_usage;
    std::string left_out, to_look_at;
    const auto chosen = choose(request, left_out);
    const auto blocks = instrument_blocks(chosen, request.settings, to_look_at);
    if (!blocks) return std::cerr << blocks.error().detail << "\n", exit_usage;
    const std::string text = heading(request.out) + station_text(request.answers) + *blocks;
    if (const auto written = write_like_before(request.out, text, request.force); !written)
        return complain(written.error());
    const int code = judge(request.out);
    if (json) {
        std::cout << json_text(Json{{"file", request.out},
                                    {"instruments", chosen.size()},
                                    {"accepted", code == exit_ok}})
                  << "\n";
        return code;
    }
    std::cout << request.out << " is written, with " << chosen.size() << " instruments.\n";
    if (!left_out.empty()) std::cout << "Left out:\n" << left_out;
    if (!to_look_at.empty())
        std::cout << "Look at these lines, they hold examples:\n" << to_look_at;
    std::cout << "Next: axiscal check-config " << request.out << ", then axiscal doctor\n";
    return code;
}

} // namespace axiscal
