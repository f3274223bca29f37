#pragma once
// The kernel's name for this boot. What sd_id128_get_boot(3) reads, without the six libraries that
// libsystemd loads (drivers/loop/service_manager.hpp).

#include "analysis/quantity/boot_id.hpp"

namespace axiscal {

/// Unknown where the file cannot be read (a sandbox with ProcSubset=pid hides it) or does not hold
/// a UUID in lower-case letters that is not all zeros.
BootId read_boot_id(const std::string& path = "/proc/sys/kernel/random/boot_id");

} // namespace axiscal
