#include "acquisition/console/api_token.hpp"

#include <array>
#include <cstdio>
#include <fstream>
#include <random>
#include <sys/stat.h>

namespace axiscal {

Result<std::string> load_or_make_token(const std::string& path) {
    std::string token;
    if (std::ifstream file{path}; std::getline(file, token) && token.size() >= 32) return token;
    std::random_device random;
    token.clear();
    for (int i = 0; i < 8; ++i) {
        std::array<char, 9> word{};
        std::snprintf(word.data(), word.size(), "%08x", static_cast<unsigned>(random()));
        token += word.data();
    }
    const mode_t before = ::umask(0137); // 0640
    std::ofstream file{path, std::ios::trunc};
    ::umask(before);
    if (!(file << token << '\n' << std::flush))
        return fail(Fault::io, "cannot write the token file " + path);
    return token;
}

} // namespace axiscal
