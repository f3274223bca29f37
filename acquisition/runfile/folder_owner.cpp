#include "acquisition/runfile/folder_owner.hpp"

#include <array>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

namespace axiscal {
namespace {

/// Its number where this computer has no name for it.
std::string name_of_user(uid_t uid) {
    passwd entry{};
    passwd* found = nullptr;
    std::array<char, 4096> texts{};
    ::getpwuid_r(uid, &entry, texts.data(), texts.size(), &found);
    return found != nullptr ? found->pw_name : "#" + std::to_string(uid);
}

} // namespace

Result<void> refuse_root_on_foreign(const std::string& folder, const std::string& program) {
    struct stat info {};
    if (::geteuid() != 0 || ::stat(folder.c_str(), &info) != 0 || info.st_uid == 0) return {};
    const std::string owner = name_of_user(info.st_uid);
    return fail(Fault::refused, folder + " belongs to user " + owner +
                                    ", who cannot change what root writes there: sudo -u " + owner +
                                    " " + program + " ..., or systemctl start " + program);
}

} // namespace axiscal
