#include "drivers/wire/byte_link.hpp"

#include "drivers/wire/can_link.hpp"
#include "drivers/wire/usb_link.hpp"

namespace axiscal {

Task<Result<std::unique_ptr<UsbLink>>> LinkOpener::open_usb(const LinkSettings& settings,
                                                            MonotonicTime /*deadline*/) {
    co_return fail(Fault::link_closed, "no USB here for " + settings.describe());
}

Task<Result<std::unique_ptr<CanLink>>> LinkOpener::open_can(const LinkSettings& settings,
                                                            MonotonicTime /*deadline*/) {
    co_return fail(Fault::link_closed, "no CAN here for " + settings.describe());
}

} // namespace axiscal
