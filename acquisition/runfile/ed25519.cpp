#include "acquisition/runfile/ed25519.hpp"

#include "acquisition/runfile/digest.hpp"

#include <algorithm>
#include <nettle/base64.h>
#include <nettle/eddsa.h>
#include <ranges>

namespace axiscal {
namespace {

constexpr std::string_view pem_begin = "-----BEGIN PUBLIC KEY-----",
                           pem_end = "-----END PUBLIC KEY-----";
/// SubjectPublicKeyInfo of RFC 8410, section 4, before the 32 bytes of the key.
constexpr std::array<std::uint8_t, 12> key_info{0x30, 0x2a, 0x30, 0x05, 0x06, 0x03,
                                                0x2b, 0x65, 0x70, 0x03, 0x21, 0x00};

const std::uint8_t* bytes_in(std::string_view text) {
    return reinterpret_cast<const std::uint8_t*>(text.data());
}

/// Empty where it is no base64.
std::vector<std::uint8_t> from_base64(std::string_view text) {
    base64_decode_ctx state{};
    base64_decode_init(&state);
    std::vector<std::uint8_t> bytes(BASE64_DECODE_LENGTH(text.size()));
    std::size_t count = bytes.size();
    const bool whole =
        base64_decode_update(&state, &count, bytes.data(), text.size(), text.data()) != 0 &&
        base64_decode_final(&state) != 0;
    bytes.resize(whole ? count : 0);
    return bytes;
}

} // namespace

SecretKey::SecretKey(const Seed& seed)
    : seed_{seed} {
    ed25519_sha512_public_key(public_key_.data(), seed_.data());
}

Signature SecretKey::sign(std::string_view message) const {
    Signature signature{};
    ed25519_sha512_sign(public_key_.data(), seed_.data(), message.size(), bytes_in(message),
                        signature.data());
    return signature;
}

bool is_signed_by(const PublicKey& key, std::string_view message, const Signature& signature) {
    return ed25519_sha512_verify(key.data(), message.size(), bytes_in(message), signature.data()) ==
           1;
}

std::string to_pem(const PublicKey& key) {
    std::array<std::uint8_t, key_info.size() + 32> info{};
    std::ranges::copy(key, std::ranges::copy(key_info, info.begin()).out);
    std::string text(BASE64_ENCODE_RAW_LENGTH(info.size()), '\0');
    base64_encode_raw(text.data(), info.size(), info.data());
    return std::string{pem_begin} + "\n" + text + "\n" + std::string{pem_end} + "\n";
}

Result<std::vector<PublicKey>> public_keys_of(const std::string& pem) {
    std::vector<PublicKey> keys;
    for (auto begin = pem.find(pem_begin); begin != std::string::npos;
         begin = pem.find(pem_begin, begin)) {
        begin += pem_begin.size();
        const auto end = pem.find(pem_end, begin);
        const auto info = from_base64(
            std::string_view{pem}.substr(begin, end == std::string::npos ? 0 : end - begin));
        PublicKey key{};
        if (info.size() != key_info.size() + key.size() ||
            !std::ranges::equal(key_info, info | std::views::take(key_info.size())))
            return fail(Fault::bad_case, "a public key of another kind than Ed25519, or a damaged "
                                         "one: take public-keys.pem of the station");
        std::ranges::copy(info | std::views::drop(key_info.size()), key.begin());
        keys.push_back(key);
    }
    if (keys.empty())
        return fail(Fault::bad_case, "no line '" + std::string{pem_begin} +
                                         "': take public-keys.pem of the station");
    return keys;
}

std::string short_name_of(const PublicKey& key) {
    constexpr std::size_t digits = 16;
    return sha256_hex({reinterpret_cast<const char*>(key.data()), key.size()}).substr(0, digits);
}

} // namespace axiscal
