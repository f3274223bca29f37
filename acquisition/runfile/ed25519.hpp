#pragma once
// Ed25519 (RFC 8032) by nettle, and public keys as PEM (RFC 8410), as `openssl pkey -pubin` reads
// them. Pure.

#include "analysis/quantity/result.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

using PublicKey = std::array<std::uint8_t, 32>;
using Signature = std::array<std::uint8_t, 64>;

class SecretKey {
public:
    using Seed = std::array<std::uint8_t, 32>; ///< 32 random bytes: what RFC 8032 calls private key
    explicit SecretKey(const Seed& seed);
    [[nodiscard]] const PublicKey& public_key() const { return public_key_; }
    [[nodiscard]] const Seed& seed() const { return seed_; }
    [[nodiscard]] Signature sign(std::string_view message) const;

private:
    Seed seed_;
    PublicKey public_key_{};
};

bool is_signed_by(const PublicKey& key, std::string_view message, const Signature& signature);

/// "-----BEGIN PUBLIC KEY-----", one line of base64, "-----END PUBLIC KEY-----".
std::string to_pem(const PublicKey& key);
/// Every public key of a text, in its order; what stands between them is passed over.
/// @errors Fault::bad_case without a key, or where one is no Ed25519 key.
Result<std::vector<PublicKey>> public_keys_of(const std::string& pem);
/// How people call a key: the first 16 hexadecimal digits of its SHA-256.
std::string short_name_of(const PublicKey& key);

} // namespace axiscal
