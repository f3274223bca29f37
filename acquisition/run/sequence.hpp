#pragma once
// The numbering of requests: 0 is idle, 65534 is followed by 1, 65535 is
// `done` while no run takes requests. Pure.

#include "drivers/trigger/trigger_port.hpp"

#include <cstdint>
#include <string>

namespace axiscal {

/// One sentence for a request that is neither the last durable one nor the next: names it as
/// missed, restarted or late, with the numbers. `last_durable` 0: nothing is durable yet.
std::string describe_disorder(std::uint16_t came, std::uint16_t last_durable);

} // namespace axiscal
