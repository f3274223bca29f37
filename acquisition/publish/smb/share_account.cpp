#include "acquisition/publish/smb/share_account.hpp"

#include "acquisition/runfile/durable_file.hpp"

#include <array>
#include <cstdlib>
#include <fcntl.h>
#include <sstream>
#include <sys/stat.h>
#include <unistd.h>

namespace axiscal {
namespace {

constexpr std::size_t longest_file = 4096; // bytes; three short lines

Result<std::string> content_of(const FileHandle& file, const std::string& path) {
    std::array<char, longest_file> bytes{};
    const auto got = ::read(file.get(), bytes.data(), bytes.size());
    if (got < 0) return fail_io("cannot read", path);
    if (static_cast<std::size_t>(got) == bytes.size())
        return fail(Fault::bad_configuration, path + " is too long for a file of one account");
    return std::string{bytes.data(), static_cast<std::size_t>(got)};
}

Result<void> check_rights(const FileHandle& file, const std::string& path) {
    struct stat status {};
    if (::fstat(file.get(), &status) != 0) return fail_io("cannot look at", path);
    if (!S_ISREG(status.st_mode)) return fail(Fault::refused, path + " is no plain file");
    if ((status.st_mode & (S_IRWXG | S_IRWXO)) != 0)
        return fail(Fault::refused,
                    "others may read the password in " + path + ": chmod 600 " + path);
    if (status.st_uid != ::geteuid() && status.st_uid != 0)
        return fail(Fault::refused, path + " belongs to another user: chown axiscal " + path);
    return {};
}

Result<std::string> read_credential() {
    // systemd sets it before main, and nothing here ever changes the environment.
    const char* const folder =
        std::getenv("CREDENTIALS_DIRECTORY"); // NOLINT(concurrency-mt-unsafe)
    const std::string path = std::string{folder ? folder : ""} + "/" + share_credential;
    const FileHandle file{folder ? ::open(path.c_str(), O_RDONLY | O_CLOEXEC) : -1};
    if (!file)
        return fail(Fault::bad_configuration,
                    "the share's account is missing: set publish.credentials to a file with "
                    "username= and password=, or give the service the credential " +
                        std::string{share_credential});
    return content_of(file, path);
}

} // namespace

Result<ShareAccount> parse_share_account(const std::string& text, const std::string& name) {
    ShareAccount account;
    std::istringstream lines{text};
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        if (line.ends_with('\r')) line.pop_back();
        line.erase(0, line.find_first_not_of(" \t"));
        if (line.empty() || line.front() == '#') continue;
        const auto equals = line.find('=');
        const std::string key = line.substr(0, equals);
        const std::string value = equals == std::string::npos ? "" : line.substr(equals + 1);
        if (key == "username")
            account.user = value;
        else if (key == "password")
            account.password = value;
        else if (key == "domain")
            account.domain = value;
        else
            return fail(Fault::bad_configuration, name + ":" + std::to_string(number) +
                                                      ": is none of username=, password=, domain=");
    }
    if (account.user.empty() || account.password.empty())
        return fail(Fault::bad_configuration, name + " needs the lines username= and password=");
    return account;
}

Result<ShareAccount> read_share_account(const std::string& path) {
    if (path.empty()) {
        AXISCAL_TRY(const auto text, read_credential());
        return parse_share_account(text, share_credential);
    }
    const FileHandle file{::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC)};
    if (!file) return fail_io("cannot open the share's account", path);
    AXISCAL_CHECK(check_rights(file, path));
    AXISCAL_TRY(const auto text, content_of(file, path));
    return parse_share_account(text, path);
}

} // namespace axiscal
