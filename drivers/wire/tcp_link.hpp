#pragma once
// Connecting a TCP link. Loop-bound.

#include "drivers/wire/byte_link.hpp"

namespace axiscal {

/// Resolves and connects, Nagle off.
/// @errors Fault::link_timeout at the deadline, Fault::link_closed when nobody answers there.
Task<Result<std::unique_ptr<ByteLink>>>
open_tcp(Scheduler& scheduler, LinkSettings settings, MonotonicTime deadline);

} // namespace axiscal
