#include "acquisition/runfile/file_users.hpp"

#include <fstream>
#include <set>
#include <sstream>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <sys/types.h>
#include <unistd.h>

namespace axiscal {
namespace {

/// As the list writes it: major and minor number in hexadecimal, two digits at least, the inode.
std::string place_of(const struct stat& file) {
    std::ostringstream text;
    text << std::hex;
    for (const unsigned part : {major(file.st_dev), minor(file.st_dev)})
        text << (part < 0x10 ? "0" : "") << part << ":";
    text << std::dec << file.st_ino;
    return text.str();
}

/// A line: "1: POSIX  ADVISORY  READ 1234 08:01:12345 1073741826 1073742335". One that begins with
/// "->" behind its number only waits.
std::set<pid_t> processes_on(const std::string& place, const std::string& list) {
    std::set<pid_t> found;
    std::ifstream file{list};
    for (std::string line; std::getline(file, line);) {
        std::istringstream words{line};
        std::string number, kind, mode, way, where;
        pid_t process = 0;
        if (!(words >> number >> kind >> mode >> way >> process >> where)) continue;
        if (where == place && process > 0 && process != ::getpid()) found.insert(process);
    }
    return found;
}

/// A process names itself with any bytes; those that are no plain letters do not leave here.
std::string name_of(pid_t process) {
    std::ifstream file{"/proc/" + std::to_string(process) + "/comm"};
    std::string name;
    std::getline(file, name);
    for (char& letter : name)
        if (letter < ' ' || letter > '~') letter = '?';
    return name;
}

} // namespace

std::string file_users_text(const std::string& path, const std::string& list) {
    struct stat file {};
    if (::stat(path.c_str(), &file) != 0) return "another program";
    std::string words;
    for (const pid_t process : processes_on(place_of(file), list)) {
        words += (words.empty() ? "process " : " and process ") + std::to_string(process);
        if (const std::string name = name_of(process); !name.empty()) words += " (" + name + ")";
    }
    return words.empty() ? "another program" : words;
}

} // namespace axiscal
