#pragma once
// The kernel's counter character device as a link: events are asked for, then come as records.

#include "drivers/wire/byte_link.hpp"

#include <memory>
#include <string>

namespace axiscal {

using CounterWatch = decltype(LinkSettings::watch);

/// Opens `path`, adds the watch and enables the events; a named pipe in its place needs neither
/// (tests). Loop-bound.
/// @errors Fault::link_closed when it is missing or in use, or its driver does not have the event.
Result<std::unique_ptr<ByteLink>>
open_counter(Scheduler& scheduler, const std::string& path, const CounterWatch& watch);

} // namespace axiscal
