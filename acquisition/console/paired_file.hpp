#pragma once
// The file of the paired browsers in the state directory, and the kernel's random bytes. What the
// file holds lets nobody in: hashes, never a token.

#include "acquisition/console/pairing.hpp"

#include <span>
#include <string>
#include <vector>

namespace axiscal {

/// getrandom(2).
bool random_bytes(std::span<std::uint8_t> bytes);

/// Nobody where there is no file yet. @errors Fault::refused for a file that is damaged, or that
/// others than its owner may read or write, or that is no plain file; Fault::io. Each names the
/// path: nobody is paired then.
Result<std::vector<PairedBrowser>> read_paired(const std::string& path);
/// Durable, mode 0600. Thread-safe: no state. @errors Fault::io naming the path.
Result<void> write_paired(const std::string& path, const std::vector<PairedBrowser>& paired);

} // namespace axiscal
