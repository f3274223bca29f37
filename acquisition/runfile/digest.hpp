#pragma once
// SHA-256 by nettle, the one hash of run files and published results. Pure, but for the file.

#include "analysis/quantity/result.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <nettle/sha2.h>
#include <string>
#include <string_view>

namespace axiscal {

using Digest = std::array<std::uint8_t, SHA256_DIGEST_SIZE>;

/// Of bytes that come in parts.
class Sha256 {
public:
    Sha256() { sha256_init(&state_); }
    void add(std::string_view bytes);
    /// Of all that was added; begins anew.
    Digest finish();

private:
    sha256_ctx state_{};
};

Digest sha256(std::string_view bytes);
/// SHA-256(previous, bytes): one link of a chain.
Digest sha256_link(const Digest& previous, std::string_view bytes);
std::string hex_of(const Digest& digest); ///< 64 lower-case digits
std::string sha256_hex(std::string_view bytes);

/// Of the whole file as it is on disk, read in blocks (block_for). `progress` is called
/// after each. @errors Fault::io naming the path.
Result<std::string> sha256_of_file(const std::string& path,
                                   const std::function<void()>& progress = {});

} // namespace axiscal
