#include "drivers/recording/tape_recording.hpp"

#include "drivers/wire/can_link.hpp"
#include "drivers/wire/usb_link.hpp"

#include <array>

namespace axiscal {
namespace {

constexpr std::array<std::string_view, 7> kind_names{"serial", "tcp",     "usb",  "hid",
                                                     "can",    "counter", "files"};

} // namespace

RecordingOpener::RecordingOpener(Scheduler& scheduler, LinkOpener& inner, std::ostream& tape)
    : scheduler_{scheduler}
    , inner_{inner}
    , tape_{tape}
    , buses_{scheduler, *this} {}

MonotonicTime RecordingOpener::begin() {
    if (!begin_) begin_ = scheduler_.now();
    return *begin_;
}

void RecordingOpener::end() {
    if (begin_)
        TapeWriter{tape_, *begin_}.write(TapeEntry::Direction::closed, scheduler_.now(), {});
}

Task<Result<std::unique_ptr<ByteLink>>> RecordingOpener::open(const LinkSettings& settings,
                                                              MonotonicTime deadline) {
    const MonotonicTime zero = begin();
    wire_ = kind_names[static_cast<std::size_t>(settings.kind)];
    auto opened = co_await inner_.open(settings, deadline);
    if (!opened) co_return opened;
    co_return std::make_unique<TapeRecorderLink>(*std::move(opened), scheduler_, tape_, zero);
}

Task<Result<std::unique_ptr<UsbLink>>> RecordingOpener::open_usb(const LinkSettings& settings,
                                                                 MonotonicTime deadline) {
    const MonotonicTime zero = begin();
    wire_ = kind_names[static_cast<std::size_t>(settings.kind)];
    auto opened = co_await inner_.open_usb(settings, deadline);
    if (!opened) co_return opened;
    co_return record_usb(*std::move(opened), scheduler_, tape_, zero);
}

Task<Result<std::unique_ptr<CanLink>>> RecordingOpener::open_can(const LinkSettings& settings,
                                                                 MonotonicTime deadline) {
    const MonotonicTime zero = begin();
    wire_ = kind_names[static_cast<std::size_t>(settings.kind)];
    auto opened = co_await inner_.open_can(settings, deadline);
    if (!opened) co_return opened;
    co_return record_can(*std::move(opened), scheduler_, tape_, zero);
}

} // namespace axiscal
