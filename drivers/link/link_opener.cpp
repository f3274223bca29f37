#include "drivers/link/link_opener.hpp"

#include "drivers/link/serial_link.hpp"
#include "drivers/link/tcp_link.hpp"

namespace axiscal {

RealLinkOpener::RealLinkOpener(Scheduler& scheduler)
    : scheduler_{scheduler}
    , buses_{scheduler.executor()} {}

Task<Result<std::unique_ptr<ByteLink>>> RealLinkOpener::open(const LinkSettings& settings,
                                                             MonotonicTime deadline) {
    if (settings.kind == LinkSettings::Kind::serial) co_return open_serial(scheduler_, settings);
    auto opened = co_await open_tcp(scheduler_, settings, deadline);
    co_return opened;
}

} // namespace axiscal
