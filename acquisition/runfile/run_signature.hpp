#pragma once
// Who closed this run: each closing of a run file is signed by the station's key, and each result
// with the closing that it was computed of. docs/run-file.md says what that proves. Blocking.

#include "acquisition/runfile/digest.hpp"
#include "acquisition/runfile/ed25519.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace axiscal {

class Database;

/// What is signed. Its bytes are those of a row (docs/run-file.md) named `signature` with these
/// four values.
struct ClosingMark {
    std::string run_id;
    int closing = 0; ///< from 1
    Digest closing_hash{};
    std::optional<Digest> result_hash; ///< none: no figures were computed yet
};
std::string signed_bytes(const ClosingMark& mark);

/// Adds the signature of the last closing, with `result_hash` where figures were computed of it.
/// For the transaction that writes the closing or the result.
Result<void> append_signature(Database& database,
                              const SecretKey& key,
                              const std::optional<Digest>& result_hash);
/// Whether the last closing is signed: then its result has to be, too.
Result<bool> is_closing_signed(const Database& database);

/// The newest closing and the newest result of a closed file.
/// @errors Fault::refused while it is open; those of open_run_file().
Result<ClosingMark> last_closing_mark(const std::string& run_file);

enum class SignatureVerdict : std::uint8_t { good, bad, absent, unknown_key };
std::string_view name_of(SignatureVerdict verdict); ///< "unknown_key"

struct SignatureReport {
    SignatureVerdict verdict = SignatureVerdict::absent;
    std::string sentence; ///< for people: why
};

/// `known`: public keys that came by another way than the file. Good: every closing and every
/// result is signed by one of them. Without any the verdict is never good, whatever stands in the
/// file. The rows themselves are proved by verify_chain(). @errors those of open_run_file().
Result<SignatureReport> check_signatures(const std::string& run_file,
                                         std::span<const PublicKey> known);

enum class AnchorVerdict : std::uint8_t { match, differs, absent };
std::string_view name_of(AnchorVerdict verdict);

struct AnchorReport {
    AnchorVerdict verdict = AnchorVerdict::absent;
    std::string sentence;
};

/// Holds a file against what was said of it earlier, when perhaps it had fewer closings.
/// @errors those of open_run_file().
Result<AnchorReport> compare_with_anchor(const std::string& run_file, const ClosingMark& anchor);

} // namespace axiscal
