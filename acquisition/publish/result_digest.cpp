#include "acquisition/publish/result_digest.hpp"

#include "analysis/certificate.hpp"
#include "analysis/circular/circular_certificate.hpp"

#include <array>
#include <sodium.h>
#include <vector>

namespace axiscal {

namespace {

std::string sha256_of(const std::vector<std::byte>& bytes) {
    std::array<unsigned char, crypto_hash_sha256_BYTES> hash{};
    crypto_hash_sha256(hash.data(), reinterpret_cast<const unsigned char*>(bytes.data()),
                       bytes.size());
    std::array<char, crypto_hash_sha256_BYTES * 2 + 1> hex{};
    sodium_bin2hex(hex.data(), hex.size(), hash.data(), hash.size());
    return hex.data();
}

} // namespace

std::string result_digest(const PositioningResult& result) {
    return sha256_of(canonical_bytes(result));
}

std::string result_digest(const CircularParameters& parameters) {
    return sha256_of(canonical_bytes(parameters));
}

} // namespace axiscal
