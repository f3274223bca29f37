#include "acquisition/journal/digest.hpp"

#include "acquisition/journal/durable_file.hpp"

#include <sodium.h>

#include <fcntl.h>
#include <unistd.h>
#include <vector>

namespace axiscal {
namespace {

static_assert(crypto_hash_sha256_BYTES == std::tuple_size_v<Digest>);

const unsigned char* bytes_of(std::string_view text) {
    return reinterpret_cast<const unsigned char*>(text.data());
}

} // namespace

Digest sha256(std::string_view bytes) {
    Digest digest{};
    crypto_hash_sha256(digest.data(), bytes_of(bytes), bytes.size());
    return digest;
}

Digest sha256_link(const Digest& previous, std::string_view bytes) {
    crypto_hash_sha256_state state;
    Digest digest{};
    crypto_hash_sha256_init(&state);
    crypto_hash_sha256_update(&state, previous.data(), previous.size());
    crypto_hash_sha256_update(&state, bytes_of(bytes), bytes.size());
    crypto_hash_sha256_final(&state, digest.data());
    return digest;
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
    crypto_hash_sha256_state state;
    crypto_hash_sha256_init(&state);
    std::vector<unsigned char> block(1U << 20U);
    for (;;) {
        const auto got = ::read(file.get(), block.data(), block.size());
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return fail_io("cannot read", path);
        if (got == 0) break;
        crypto_hash_sha256_update(&state, block.data(), static_cast<std::size_t>(got));
        if (progress) progress();
    }
    Digest digest{};
    crypto_hash_sha256_final(&state, digest.data());
    return hex_of(digest);
}

} // namespace axiscal
