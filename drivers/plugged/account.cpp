#include "drivers/plugged/account.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <grp.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

namespace axiscal {
namespace {

constexpr std::size_t longest_entry = 16384; // of passwd or group; larger ones count as unknown

std::optional<passwd> user_named(const char* name, std::vector<char>& storage) {
    passwd entry{};
    passwd* found = nullptr;
    storage.resize(longest_entry);
    ::getpwnam_r(name, &entry, storage.data(), storage.size(), &found);
    return found != nullptr ? std::optional{entry} : std::nullopt;
}

std::string name_of_user(uid_t user) {
    passwd entry{};
    passwd* found = nullptr;
    std::vector<char> storage(longest_entry);
    ::getpwuid_r(user, &entry, storage.data(), storage.size(), &found);
    return found != nullptr ? entry.pw_name : std::to_string(user);
}

std::string name_of_group(gid_t id) {
    group entry{};
    group* found = nullptr;
    std::vector<char> storage(longest_entry);
    ::getgrgid_r(id, &entry, storage.data(), storage.size(), &found);
    return found != nullptr ? entry.gr_name : std::to_string(id);
}

Account caller() {
    Account account;
    account.is_service = false;
    account.user = ::geteuid();
    account.name = name_of_user(account.user);
    account.groups = own_groups();
    account.groups.push_back(::getegid());
    return account;
}

} // namespace

std::vector<gid_t> own_groups() {
    const int room = std::max(::getgroups(0, nullptr), 0);
    std::vector<gid_t> groups(static_cast<std::size_t>(room));
    const int count = ::getgroups(room, groups.data());
    groups.resize(static_cast<std::size_t>(std::max(count, 0)));
    return groups;
}

std::optional<gid_t> group_named(const std::string& name) {
    group entry{};
    group* found = nullptr;
    std::vector<char> storage(longest_entry);
    ::getgrnam_r(name.c_str(), &entry, storage.data(), storage.size(), &found);
    return found != nullptr ? std::optional{entry.gr_gid} : std::nullopt;
}

Account service_account() {
    std::vector<char> storage;
    const auto entry = user_named("axiscal", storage);
    if (!entry) return caller();
    Account account;
    account.name = "axiscal";
    account.user = entry->pw_uid;
    std::array<gid_t, 64> groups{};
    int count = static_cast<int>(groups.size());
    ::getgrouplist(entry->pw_name, entry->pw_gid, groups.data(), &count);
    account.groups.assign(groups.begin(),
                          groups.begin() + std::clamp(count, 0, static_cast<int>(groups.size())));
    if (const auto dialout = group_named("dialout")) account.groups.push_back(*dialout);
    return account;
}

std::string rights_text(const std::string& path) {
    struct stat about {};
    if (::stat(path.c_str(), &about) != 0) return {};
    char mode[8];
    std::snprintf(mode, sizeof mode, " %04o", about.st_mode & 07777U);
    return name_of_user(about.st_uid) + ":" + name_of_group(about.st_gid) + mode;
}

bool may_use(const Account& account, const std::string& path) {
    struct stat about {};
    if (::stat(path.c_str(), &about) != 0) return false;
    if (account.user == 0) return true;
    const bool member = std::ranges::find(account.groups, about.st_gid) != account.groups.end();
    mode_t wanted = S_IROTH | S_IWOTH;
    if (S_ISDIR(about.st_mode)) wanted |= S_IXOTH;
    if (account.user == about.st_uid)
        wanted <<= 6U;
    else if (member)
        wanted <<= 3U;
    return (about.st_mode & wanted) == wanted;
}

} // namespace axiscal
