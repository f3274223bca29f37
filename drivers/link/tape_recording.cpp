#include "drivers/link/tape_recording.hpp"

#include "drivers/link/can_link.hpp"
#include "drivers/link/usb_link.hpp"
#include "drivers/spawn.hpp"

#include <boost/asio/experimental/awaitable_operators.hpp>

#include <array>
#include <optional>

namespace axiscal {
namespace {

constexpr Duration patience = std::chrono::seconds{5};     // to open the instrument's own line
constexpr Duration before_again = std::chrono::seconds{1}; // after it could not be opened
constexpr Duration very_long = std::chrono::hours{24};     // a relay waits until somebody speaks

constexpr std::array<std::string_view, 7> kind_names{"serial", "tcp",     "usb",  "hid",
                                                     "can",    "counter", "files"};

/// Until either side is closed.
Task<void> pass_on(Scheduler& scheduler, ByteLink& from, ByteLink& to) {
    for (;;) {
        auto some = co_await from.read_some(scheduler.now() + very_long);
        if (!some && some.error().fault == Fault::link_timeout) continue;
        if (!some) co_return;
        std::vector<std::byte> bytes = std::move(some->bytes);
        const auto written = co_await to.write_all(std::move(bytes), scheduler.now() + patience);
        if (!written) co_return;
    }
}

} // namespace

/// A wire made here, and the instrument's own line behind it.
class RecordingOpener::Relay {
public:
    Relay(RecordingOpener& owner, LinkSettings place, std::unique_ptr<NearWire> wire)
        : owner_{owner}
        , place_{std::move(place)}
        , wire_{std::move(wire)} {}
    Relay(const Relay&) = delete;
    Relay& operator=(const Relay&) = delete;
    ~Relay() = default;
    [[nodiscard]] LinkSettings near_end() const { return wire_->settings(); }

    Task<void> run() {
        using namespace boost::asio::experimental::awaitable_operators;
        Scheduler& scheduler = owner_.scheduler_;
        for (;;) {
            auto near = co_await wire_->accept(scheduler.now() + very_long);
            if (!near) continue;
            auto far = co_await owner_.open(place_, scheduler.now() + patience);
            if (!far) {
                near->reset();
                co_await scheduler.sleep_for(before_again);
                continue;
            }
            Task<void> asked = pass_on(scheduler, **near, **far);
            Task<void> answered = pass_on(scheduler, **far, **near);
            co_await (std::move(asked) || std::move(answered));
        }
    }

private:
    RecordingOpener& owner_;
    LinkSettings place_;
    std::unique_ptr<NearWire> wire_;
};

RecordingOpener::RecordingOpener(Scheduler& scheduler, LinkOpener& inner, std::ostream& tape)
    : scheduler_{scheduler}
    , inner_{inner}
    , tape_{tape}
    , buses_{scheduler.executor(),
             [this](const LinkSettings& settings) { return lead_over_here(settings); }} {}

RecordingOpener::~RecordingOpener() = default;

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

Result<LinkSettings> RecordingOpener::lead_over_here(const LinkSettings& settings) {
    const bool tcp = settings.kind == LinkSettings::Kind::tcp;
    AXISCAL_TRY(auto wire, tcp ? make_tcp_wire(scheduler_, 0) : make_pty_wire(scheduler_, ""));
    relays_.push_back(std::make_unique<Relay>(*this, settings, std::move(wire)));
    LinkSettings led = settings;
    const LinkSettings near = relays_.back()->near_end();
    led.path = near.path;
    led.host = near.host;
    led.port = near.port;
    spawn(scheduler_, relays_.back()->run());
    return led;
}

} // namespace axiscal
