#pragma once
// "smb://server/share/folder" as a person writes it in the station file. Pure.

#include "analysis/quantity/result.hpp"

#include <string>
#include <string_view>

namespace axiscal {

struct ShareAddress {
    std::string server; ///< name or IPv4 address
    int port = 445;
    std::string share;
    std::string folder; ///< below the share, "a/b", no slash at its ends; empty: the share itself
};

/// The text speaks of an SMB share, well written or not.
bool is_share_address(std::string_view text);

/// "smb://server[:port]/share[/folder...]". Names stand as Explorer shows them: blanks are allowed,
/// percent escapes are not, and neither is an account: it has a file of its own.
/// @errors Fault::bad_request saying what would be right.
Result<ShareAddress> parse_share_address(std::string_view text);

/// As it was written; the port only where it is not 445.
std::string address_text(const ShareAddress& address);

} // namespace axiscal
