#include "acquisition/runfile/signing_key.hpp"

#include "acquisition/runfile/digest.hpp"
#include "acquisition/runfile/durable_file.hpp"

#include <algorithm>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

namespace axiscal {
namespace {

constexpr std::string_view first_line = "axiscal signing key 1";
constexpr std::size_t id_digits = 32; // machine-id(5)

struct KeyFile {
    std::string machine; ///< as machine_mark()
    SecretKey key;
};

/// machine-id(5) asks that the id itself be given to nobody.
std::string machine_mark(const std::string& machine_id) {
    return sha256_hex(std::string{first_line} + "\n" + machine_id);
}

template <std::size_t count> std::string hex_text(const std::array<std::uint8_t, count>& bytes) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text;
    for (const auto byte : bytes) {
        text += digits[byte >> 4U];
        text += digits[byte & 15U];
    }
    return text;
}

std::optional<SecretKey::Seed> seed_of(const std::string& text) {
    SecretKey::Seed seed{};
    if (text.size() != 2 * seed.size() ||
        text.find_first_not_of("0123456789abcdef") != std::string::npos)
        return std::nullopt;
    for (std::size_t i = 0; i < seed.size(); ++i)
        seed[i] = static_cast<std::uint8_t>(std::stoi(text.substr(2 * i, 2), nullptr, 16));
    return seed;
}

tl::unexpected<Error> refuse_key(const std::string& path, const std::string& why) {
    return fail(Fault::refused, path + " " + why);
}

/// Empty where there is no such file.
Result<std::optional<KeyFile>> read_key_file(const std::string& path) {
    const FileHandle file{::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC)};
    if (!file && errno == ENOENT) return std::optional<KeyFile>{};
    if (!file) return fail_io("cannot open", path);
    struct stat found {};
    if (::fstat(file.get(), &found) != 0) return fail_io("cannot look at", path);
    constexpr mode_t of_others = 077;
    if (!S_ISREG(found.st_mode) || (found.st_mode & of_others) != 0)
        return refuse_key(path,
                          "may be read by others than its owner, and whoever has it can sign: "
                          "remove it, and a new key is made at the next start (or, where "
                          "nobody else can have read it, chmod 600 " +
                              path + ")");
    std::string text(512, '\0');
    const auto got = ::read(file.get(), text.data(), text.size());
    if (got < 0) return fail_io("cannot read", path);
    text.resize(static_cast<std::size_t>(got));
    constexpr std::size_t marks = 64;
    const std::string head = std::string{first_line} + "\nmachine ";
    const std::string middle = "\nseed ";
    const auto seed = text.size() == head.size() + marks + middle.size() + marks + 1
                          ? seed_of(text.substr(head.size() + marks + middle.size(), marks))
                          : std::nullopt;
    if (!seed || !text.starts_with(head) ||
        text.compare(head.size() + marks, middle.size(), middle) != 0)
        return refuse_key(path, "is no signing key: put it back from a backup, or remove it, and a "
                                "new key is made at the next start");
    return std::optional{KeyFile{text.substr(head.size(), marks), SecretKey{*seed}}};
}

/// Behind those that are there: runs of an earlier key still verify by it.
Result<void> keep_public_key(const std::string& path, const PublicKey& key) {
    std::ifstream file{path, std::ios::binary};
    std::string text{std::istreambuf_iterator<char>{file}, {}};
    const std::string pem = to_pem(key);
    if (text.find(pem) != std::string::npos) return {};
    constexpr mode_t for_everybody = 0644;
    return put_synced(path, text + pem, for_everybody);
}

Result<SecretKey> make_key(const std::string& path, const std::string& machine_id) {
    SecretKey::Seed seed{};
    if (::getrandom(seed.data(), seed.size(), 0) != static_cast<ssize_t>(seed.size()))
        return fail_io("no random bytes for", path);
    SecretKey key{seed};
    // First the public one: a key that has signed is never without it.
    AXISCAL_CHECK(
        keep_public_key(folder_of(path) + "/" + std::string{public_keys_file}, key.public_key()));
    constexpr mode_t for_its_owner = 0600;
    AXISCAL_CHECK(put_synced(path,
                             std::string{first_line} + "\nmachine " + machine_mark(machine_id) +
                                 "\nseed " + hex_text(seed) + "\n",
                             for_its_owner));
    return key;
}

std::string path_of_key(const std::string& state_directory) {
    return state_directory + "/" + std::string{signing_key_file};
}

} // namespace

std::string read_machine_id(const std::string& path) {
    std::string id;
    std::getline(std::ifstream{path}, id);
    const bool known = id.size() == id_digits &&
                       id.find_first_not_of("0123456789abcdef") == std::string::npos &&
                       id.find_first_not_of('0') != std::string::npos;
    return known ? id : std::string{};
}

Result<StationKey> open_station_key(const std::string& state_directory,
                                    const std::string& machine_id) {
    const std::string path = path_of_key(state_directory);
    const std::string pem = state_directory + "/" + std::string{public_keys_file};
    AXISCAL_TRY(auto found, read_key_file(path));
    if (machine_id.empty())
        return StationKey{nullptr,
                          "Runs are closed without a signature: /etc/machine-id names no machine, "
                          "and the key is tied to it ('sudo systemd-machine-id-setup', then start "
                          "axiscald anew).",
                          true};
    StationKey station;
    if (found && found->machine == machine_mark(machine_id)) {
        station.key = std::make_shared<const SecretKey>(found->key);
        AXISCAL_CHECK(keep_public_key(pem, station.key->public_key()));
        return station;
    }
    AXISCAL_TRY(const SecretKey made, make_key(path, machine_id));
    station.key = std::make_shared<const SecretKey>(made);
    const std::string name = short_name_of(made.public_key());
    station.warns = found.has_value();
    station.news = found ? "The machine-id of this computer has changed: runs are signed by a new "
                           "key from now on, " +
                               name + ", no longer by " + short_name_of(found->key.public_key()) +
                               ". Hand out " + pem + " anew: both stand in it."
                         : "Runs are signed by a new key, " + name + ". Hand out " + pem + ".";
    return station;
}

Result<std::shared_ptr<const SecretKey>> read_station_key(const std::string& state_directory,
                                                          const std::string& machine_id) {
    AXISCAL_TRY(const auto found, read_key_file(path_of_key(state_directory)));
    if (!found || machine_id.empty() || found->machine != machine_mark(machine_id))
        return std::shared_ptr<const SecretKey>{};
    return std::make_shared<const SecretKey>(found->key);
}

} // namespace axiscal
