// Whose the files of the state directory are. One start by hand (sudo axiscald) leaves files of
// root there, and the service is shut out of its own folder.
#include "tools/axiscal/doctor/doctor.hpp"

#include <algorithm>
#include <filesystem>
#include <sys/stat.h>

namespace axiscal {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_named = 3;

/// The service's own files are as it made them, be it for reading alone.
bool is_shut_to(const Account& service, const fs::path& path) {
    struct stat about {};
    if (::lstat(path.c_str(), &about) != 0 || S_ISLNK(about.st_mode)) return false;
    return about.st_uid != service.user && !may_use(service, path.string());
}

std::vector<std::string> shut_files(const std::string& folder, const Account& service) {
    std::vector<std::string> names;
    std::error_code error;
    fs::recursive_directory_iterator at{folder, fs::directory_options::skip_permission_denied,
                                        error};
    for (; !error && at != fs::recursive_directory_iterator{}; at.increment(error))
        if (is_shut_to(service, at->path()))
            names.push_back(at->path().lexically_relative(folder).string());
    return names;
}

std::string list_of(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < names.size() && i < most_named; ++i)
        text += (i == 0 ? "" : ", ") + names[i];
    const std::size_t more = names.size() - std::min(names.size(), most_named);
    return more == 0 ? text : text + " and " + std::to_string(more) + " more";
}

} // namespace

std::vector<Finding> check_owners(const std::string& folder, const Account& service) {
    const std::vector<std::string> names = shut_files(folder, service);
    if (names.empty()) return {};
    return {{Health::broken, "disk",
             "in " + folder + " the user " + service.name + " may not write " + list_of(names) +
                 " (" + rights_text(folder + "/" + names.front()) +
                 "): axiscald was started there by another user",
             "sudo chown -R " + service.name + ": " + folder +
                 " && sudo systemctl restart axiscald axiscal-publish"}};
}

} // namespace axiscal
