#pragma once
// The virtual time in which tests let whole runs pass, under the name that they know.

#include "drivers/loop/virtual_scheduler.hpp"

namespace axiscal::testing {

using axiscal::VirtualScheduler;

} // namespace axiscal::testing
