#pragma once
// Is a CAN interface there, and can it be spoken on? Asks the kernel, which answers at once.

#include "analysis/quantity/result.hpp"

#include <cstdint>
#include <string>

namespace axiscal {

enum class CanState : std::uint8_t { up, bus_off, down, missing, not_can };

/// Flags by ioctl; the controller's state by rtnetlink, where its driver has one (vcan has none).
CanState can_state(const std::string& interface);

/// Why nothing can be said there, with the way out, in the same words however it was noticed: a log
/// then tells it once. Fault::link_closed; bad_configuration for `not_can`.
Error can_absence(const std::string& interface, CanState state);

} // namespace axiscal
