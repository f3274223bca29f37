#pragma once
// Files that root makes in the folder of the service's user shut the service out later.

#include "analysis/quantity/result.hpp"

#include <string>

namespace axiscal {

/// Where this process is root and `folder` is another user's.
/// @errors Fault::refused naming the folder, its owner and how `program` is started as that user.
Result<void> refuse_root_on_foreign(const std::string& folder, const std::string& program);

} // namespace axiscal
