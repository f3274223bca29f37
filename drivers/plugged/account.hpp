#pragma once
// Whether the account under which axiscald runs may use a file or device node, judged from owner,
// group and mode: no access is tried, so that the question can be asked by anybody.

#include "analysis/quantity/result.hpp"

#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace axiscal {

struct Account {
    std::string name; ///< "axiscal"
    uid_t user = 0;
    std::vector<gid_t> groups;
    bool is_service = true; ///< false: there is no user axiscal here, this is whoever asks
};

/// The user axiscal with the groups that its unit gives it (dialout), or, on a PC where axiscal is
/// not installed, the caller.
Account service_account();

/// The supplementary groups of this process.
std::vector<gid_t> own_groups();

/// Empty when there is no such group.
std::optional<gid_t> group_named(const std::string& name);

/// "root:dialout 0660"; empty for a file that is not there.
std::string rights_text(const std::string& path);
/// May read and write, and enter what is a folder. Access lists (ACL) are not looked at: the service is given none.
bool may_use(const Account& account, const std::string& path);

} // namespace axiscal
