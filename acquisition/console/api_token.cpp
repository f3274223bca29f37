#include "acquisition/console/api_token.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <random>
#include <sys/stat.h>
#include <unistd.h>

namespace axiscal {
namespace {

constexpr mode_t mode_of_token = 0640;

std::string octal(mode_t mode) {
    std::array<char, 8> digits{};
    std::snprintf(digits.data(), digits.size(), "%04o", static_cast<unsigned>(mode));
    return digits.data();
}

/// A token that others may have read is none any more. Empty where there is no file yet.
Result<std::string> stored_token(const std::string& path) {
    struct stat info {};
    if (::lstat(path.c_str(), &info) != 0) {
        if (errno == ENOENT) return std::string{};
        return fail(Fault::io, "cannot read the token file " + path,
                    {errno, std::generic_category()});
    }
    if (!S_ISREG(info.st_mode))
        return fail(Fault::refused, "the token file " + path + " is no plain file: remove it");
    if (info.st_uid != ::geteuid() && info.st_uid != 0)
        return fail(Fault::refused, "the token file " + path + " belongs to user " +
                                        std::to_string(info.st_uid) +
                                        ", who knows the token and may change it; remove " + path +
                                        ", and a new one is made at the next start");
    const mode_t mode = info.st_mode & 07777U;
    if ((mode & ~mode_of_token) != 0)
        return fail(Fault::refused, "the token file " + path + " has mode " + octal(mode) +
                                        " in place of " + octal(mode_of_token) +
                                        ": others may have read or changed the token; remove " +
                                        path + ", and a new one is made at the next start");
    std::string token;
    std::getline(std::ifstream{path}, token);
    return token;
}

} // namespace

Result<std::string> load_or_make_token(const std::string& path) {
    constexpr std::size_t fewest_digits = 32;
    AXISCAL_TRY(std::string token, stored_token(path));
    if (token.size() >= fewest_digits) return token;
    std::random_device random;
    token.clear();
    for (int i = 0; i < 8; ++i) {
        std::array<char, 9> word{};
        std::snprintf(word.data(), word.size(), "%08x", static_cast<unsigned>(random()));
        token += word.data();
    }
    const mode_t before = ::umask(0777 & ~mode_of_token);
    std::ofstream file{path, std::ios::trunc};
    ::umask(before);
    if (!(file << token << '\n' << std::flush))
        return fail(Fault::io, "cannot write the token file " + path);
    return token;
}

} // namespace axiscal
