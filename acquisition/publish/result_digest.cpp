#include "acquisition/publish/result_digest.hpp"

#include "analysis/certificate.hpp"

#include <array>
#include <sodium.h>
#include <vector>

namespace axiscal {

std::string result_digest(const PositioningResult& result) {
    const std::vector<std::byte> bytes = canonical_bytes(result);
    std::array<unsigned char, crypto_hash_sha256_BYTES> hash{};
    crypto_hash_sha256(hash.data(), reinterpret_cast<const unsigned char*>(bytes.data()),
                       bytes.size());
    std::array<char, crypto_hash_sha256_BYTES * 2 + 1> hex{};
    sodium_bin2hex(hex.data(), hex.size(), hash.data(), hash.size());
    return hex.data();
}

} // namespace axiscal
