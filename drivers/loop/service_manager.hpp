#pragma once
// What the daemon says to systemd, as sd_notify(3) and sd_watchdog_enabled(3) describe it for
// programs that speak for themselves. libsystemd would load six libraries for it, one MiB of an
// idle daemon's memory.

#include "analysis/quantity/time.hpp"

#include <optional>
#include <string_view>

namespace axiscal {

/// Says `words` ("READY=1") to the socket that NOTIFY_SOCKET names, a path or (with @) an abstract
/// name. Where none is named, or nobody listens, nothing happens. Waits for a manager that is
/// behind with ten such words.
void tell_service_manager(std::string_view words);

/// Within what the service manager wants WATCHDOG=1 again and again; empty where it does not watch
/// this process.
std::optional<Duration> watchdog_limit();

} // namespace axiscal
