#pragma once
// The key by which a station signs what it closes: made at the first start, kept in the state
// directory, and of this computer alone. Blocking; the daemon calls it before anything else runs.

#include "acquisition/runfile/ed25519.hpp"

#include <memory>
#include <string>

namespace axiscal {

inline constexpr std::string_view signing_key_file = "signing.key",
                                  public_keys_file = "public-keys.pem";

struct StationKey {
    std::shared_ptr<const SecretKey> key; ///< null: nothing is signed, and `news` says why
    std::string news;                     ///< what people have to be told; most often nothing
    bool warns = false;                   ///< `news` is more than that of a first start
};

/// The id of this computer (machine-id(5)); empty where it is missing or none: an id that nobody
/// knows is equal to nothing.
std::string read_machine_id(const std::string& path = "/etc/machine-id");

/// Reads the key in `state_directory`, or makes one (mode 0600). One of another machine-id is
/// replaced by a new one. The public key of each that ever signed stays in public-keys.pem.
/// Without a machine-id nothing is made and nothing is signed.
/// @errors Fault::refused for a key file that others may read or that is none, with the way out;
///         Fault::io.
Result<StationKey> open_station_key(const std::string& state_directory,
                                    const std::string& machine_id);

/// The same for who only signs: reads, makes nothing. Null where this computer has no key there.
/// @errors as above.
Result<std::shared_ptr<const SecretKey>> read_station_key(const std::string& state_directory,
                                                          const std::string& machine_id);

} // namespace axiscal
