#include "drivers/wire/link_opener.hpp"

#include "drivers/wire/can_link.hpp"
#include "drivers/wire/counter_link.hpp"
#include "drivers/wire/hid_link.hpp"
#include "drivers/wire/serial_link.hpp"
#include "drivers/wire/tcp_link.hpp"
#include "drivers/wire/usb_link.hpp"

namespace axiscal {

RealLinkOpener::RealLinkOpener(Scheduler& scheduler)
    : scheduler_{scheduler}
    , buses_{scheduler, *this}
    , files_{scheduler.executor()} {}

RealLinkOpener::~RealLinkOpener() {
    for (auto& [path, serial_opener] : serial_openers_)
        serial_opener->forget_loop();
}

Task<Result<std::unique_ptr<ByteLink>>> RealLinkOpener::open(const LinkSettings& settings,
                                                             MonotonicTime deadline) {
    if (settings.kind == LinkSettings::Kind::tcp) {
        auto connected = co_await open_tcp(scheduler_, settings, deadline);
        co_return connected;
    }
    if (settings.kind == LinkSettings::Kind::hid) {
        auto hid = co_await open_hid(scheduler_, threads_, settings.usb, deadline);
        co_return hid;
    }
    if (settings.kind == LinkSettings::Kind::counter)
        co_return open_counter(scheduler_, settings.path, settings.watch);
    if (settings.kind == LinkSettings::Kind::files) co_return files_.open(settings.path);
    if (settings.kind == LinkSettings::Kind::usb || settings.kind == LinkSettings::Kind::can)
        co_return fail(Fault::internal, settings.describe() + " is no stream of bytes");
    auto& serial_opener = serial_openers_[settings.path];
    if (!serial_opener)
        serial_opener = std::make_shared<SerialOpener>(settings.describe(), scheduler_.executor());
    auto opened = co_await open_serial(scheduler_, serial_opener, settings, deadline);
    co_return opened;
}

Task<Result<std::unique_ptr<UsbLink>>> RealLinkOpener::open_usb(const LinkSettings& settings,
                                                                MonotonicTime deadline) {
    auto opened = co_await open_usb_device(scheduler_, threads_, settings.usb, deadline);
    co_return opened;
}

Task<Result<std::unique_ptr<CanLink>>> RealLinkOpener::open_can(const LinkSettings& settings,
                                                                MonotonicTime /*deadline*/) {
    co_return open_socketcan(scheduler_, settings.path);
}

Task<bool>
RealLinkOpener::worth_another_try(Scheduler& scheduler, LinkSettings settings, RetryTimes times) {
    const Arrival arrival = co_await await_arrival(scheduler, std::move(settings), times.latest);
    if (arrival == Arrival::cannot_tell) co_await scheduler.sleep_until(times.usual);
    co_return arrival == Arrival::came;
}

} // namespace axiscal
