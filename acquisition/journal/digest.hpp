#pragma once
// SHA-256 by libsodium, the one hash of run files and published results. Pure, but for the file.

#include "analysis/quantity/result.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace axiscal {

using Digest = std::array<std::uint8_t, 32>;

Digest sha256(std::string_view bytes);
/// SHA-256(previous, bytes): one link of a chain.
Digest sha256_link(const Digest& previous, std::string_view bytes);
std::string hex_of(const Digest& digest); ///< 64 lower-case digits
std::string sha256_hex(std::string_view bytes);

/// Of the whole file as it is on disk, read in blocks. `progress` is called after each block
/// (1 MiB). @errors Fault::io naming the path.
Result<std::string> sha256_of_file(const std::string& path,
                                   const std::function<void()>& progress = {});

} // namespace axiscal
