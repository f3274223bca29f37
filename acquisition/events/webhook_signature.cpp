#include "acquisition/events/webhook_signature.hpp"

#include "acquisition/runfile/durable_file.hpp"

#include <nettle/base64.h>
#include <nettle/hmac.h>

#include <array>
#include <fcntl.h>
#include <optional>
#include <sstream>
#include <sys/stat.h>
#include <unistd.h>

namespace axiscal {
namespace {

constexpr std::string_view secret_prefix = "whsec_";
constexpr std::size_t shortest_key = 24, longest_key = 64; // bytes; by the standard
constexpr std::size_t most_keys = 2;
constexpr std::size_t longest_secret_file = 4096; // bytes

std::optional<WebhookKey> decoded(std::string_view base64) {
    WebhookKey key(BASE64_DECODE_LENGTH(base64.size()), '\0');
    base64_decode_ctx state{};
    base64_decode_init(&state);
    std::size_t length = key.size();
    const bool whole =
        base64_decode_update(&state, &length, reinterpret_cast<std::uint8_t*>(key.data()),
                             base64.size(), base64.data()) == 1 &&
        base64_decode_final(&state) == 1;
    if (!whole || length < shortest_key || length > longest_key) return std::nullopt;
    key.resize(length);
    return key;
}

std::string encoded(const std::array<std::uint8_t, SHA256_DIGEST_SIZE>& bytes) {
    std::string text(BASE64_ENCODE_RAW_LENGTH(SHA256_DIGEST_SIZE), '\0');
    base64_encode_raw(text.data(), bytes.size(), bytes.data());
    return text;
}

void add_text(hmac_sha256_ctx& state, std::string_view text) {
    hmac_sha256_update(&state, text.size(), reinterpret_cast<const std::uint8_t*>(text.data()));
}

Result<void> check_secret_rights(const FileHandle& file, const std::string& path) {
    struct stat status {};
    if (::fstat(file.get(), &status) != 0) return fail_io("cannot look at", path);
    if (!S_ISREG(status.st_mode)) return fail(Fault::refused, path + " is no plain file");
    if ((status.st_mode & (S_IRWXG | S_IRWXO)) != 0)
        return fail(Fault::refused,
                    "others may read the secret in " + path + ": chmod 600 " + path);
    if (status.st_uid != ::geteuid() && status.st_uid != 0 && ::geteuid() != 0)
        return fail(Fault::refused, path + " belongs to another user: chown axiscal " + path);
    return {};
}

} // namespace

Result<std::vector<WebhookKey>> parse_webhook_secret(const std::string& text,
                                                     const std::string& name) {
    std::vector<WebhookKey> keys;
    std::istringstream lines{text};
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        if (line.ends_with('\r')) line.pop_back();
        if (line.empty() || line.front() == '#') continue;
        const std::string place = name + ":" + std::to_string(number) + ": ";
        if (!line.starts_with(secret_prefix))
            return fail(Fault::bad_configuration, place + "a secret begins with whsec_");
        auto key = decoded(std::string_view{line}.substr(secret_prefix.size()));
        if (!key)
            return fail(Fault::bad_configuration,
                        place + "behind whsec_ stands the base64 of 24 to 64 bytes");
        keys.push_back(*std::move(key));
    }
    if (keys.empty() || keys.size() > most_keys)
        return fail(Fault::bad_configuration,
                    name + " holds one secret, or two while they change: echo whsec_$(head -c 32 "
                           "/dev/urandom | base64)");
    return keys;
}

Result<std::vector<WebhookKey>> read_webhook_secret(const std::string& path) {
    const FileHandle file{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
    if (!file) return fail_io("cannot open", path);
    AXISCAL_CHECK(check_secret_rights(file, path));
    std::array<char, longest_secret_file> bytes{};
    const auto got = ::read(file.get(), bytes.data(), bytes.size());
    if (got < 0) return fail_io("cannot read", path);
    const auto length = static_cast<std::size_t>(got);
    if (length == bytes.size())
        return fail(Fault::bad_configuration, path + " is too long for a file of one secret");
    return parse_webhook_secret(std::string{bytes.data(), length}, path);
}

std::string webhook_signatures(const std::vector<WebhookKey>& keys,
                               const std::string& id,
                               std::int64_t utc_s,
                               std::string_view body) {
    std::string all;
    for (const WebhookKey& key : keys) {
        hmac_sha256_ctx state{};
        hmac_sha256_set_key(&state, key.size(), reinterpret_cast<const std::uint8_t*>(key.data()));
        add_text(state, id + "." + std::to_string(utc_s) + ".");
        add_text(state, body);
        std::array<std::uint8_t, SHA256_DIGEST_SIZE> sum{};
        hmac_sha256_digest(&state, sum.size(), sum.data());
        all += (all.empty() ? "v1," : " v1,") + encoded(sum);
    }
    return all;
}

} // namespace axiscal
