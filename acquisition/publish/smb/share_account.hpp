#pragma once
// The account of a share, from a file that nobody else may read. Never printed.

#include "analysis/quantity/result.hpp"

#include <string>

namespace axiscal {

struct ShareAccount {
    std::string user, password;
    std::string domain; ///< empty: the server's own accounts
};

/// Name of the systemd credential: LoadCredential=share.credentials:FILE.
inline constexpr const char* share_credential = "share.credentials";

/// Lines username=, password=, domain= as mount.cifs reads them; '#' begins a comment line. A value
/// is everything behind the '='.
/// @errors Fault::bad_configuration naming file and line, never a value.
Result<ShareAccount> parse_share_account(const std::string& text, const std::string& name);

/// From `file`, which must be a plain file of this user or root with no right for group and others;
/// with an empty name from systemd's credential (whose rights are systemd's).
/// @errors Fault::refused for wider rights; Fault::bad_configuration; Fault::io.
Result<ShareAccount> read_share_account(const std::string& file);

} // namespace axiscal
