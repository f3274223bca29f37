#include "acquisition/runfile/digest.hpp"

#include "acquisition/runfile/durable_file.hpp"

#include <fcntl.h>
#include <unistd.h>
#include <vector>

namespace axiscal {

void Sha256::add(std::string_view bytes) {
    sha256_update(&state_, bytes.size(), reinterpret_cast<const std::uint8_t*>(bytes.data()));
}

Digest Sha256::finish() {
    Digest digest{};
    sha256_digest(&state_, digest.size(), digest.data());
    return digest;
}

Digest sha256(std::string_view bytes) {
    Sha256 hash;
    hash.add(bytes);
    return hash.finish();
}

Digest sha256_link(const Digest& previous, std::string_view bytes) {
    Sha256 hash;
    hash.add({reinterpret_cast<const char*>(previous.data()), previous.size()});
    hash.add(bytes);
    return hash.finish();
}

std::string hex_of(const Digest& digest) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text;
    for (const auto byte : digest) {
        text += digits[byte >> 4U];
        text += digits[byte & 15U];
    }
    return text;
}

std::string sha256_hex(std::string_view bytes) {
    return hex_of(sha256(bytes));
}

Result<std::string> sha256_of_file(const std::string& path, const std::function<void()>& progress) {
    const FileHandle file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
    if (!file) return fail_io("cannot open", path);
    Sha256 hash;
    std::vector<char> block(block_for(file));
    for (;;) {
        const auto got = ::read(file.get(), block.data(), block.size());
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return fail_io("cannot read", path);
        if (got == 0) break;
        hash.add({block.data(), static_cast<std::size_t>(got)});
        if (progress) progress();
    }
    return hex_of(hash.finish());
}

} // namespace axiscal
