#include "drivers/wire/usb_link.hpp"

#include "drivers/loop/asio_scheduler.hpp"
#include "drivers/wire/usb_handle.hpp"

#include <atomic>

namespace axiscal {
namespace {

using Handle = std::shared_ptr<UsbHandle>;

/// 25 s of a stream of 40 packets a second.
constexpr int most_waiting = 1000;
/// How soon reading ahead notices that something else is wanted.
constexpr Duration stream_slice = std::chrono::milliseconds{100};
/// A device that answers each transfer with STALL would take a whole CPU.
constexpr Duration after_stall = std::chrono::milliseconds{10};

/// What was read ahead. `packets` and `arrival` belong to the loop, `waiting` to both.
struct Inbox {
    explicit Inbox(const boost::asio::any_io_executor& loop)
        : arrival{loop, boost::asio::steady_timer::time_point::max()} {}
    std::deque<Result<TimedBytes>> packets;
    boost::asio::steady_timer arrival;
    std::atomic<int> waiting{0}; ///< read, not yet taken
};

void hand_over(const std::shared_ptr<Inbox>& inbox,
               const boost::asio::any_io_executor& loop,
               Result<TimedBytes> packet) {
    ++inbox->waiting;
    boost::asio::post(loop, [inbox, packet = std::move(packet)]() mutable {
        inbox->packets.push_back(std::move(packet));
        inbox->arrival.cancel();
    });
}

/// Reads until something else is wanted or the stream ends by an error, which is handed over too.
/// STALL is no end: the endpoint was told to go on.
void read_ahead(const WorkThread& thread,
                UsbHandle& handle,
                int endpoint,
                std::size_t longest,
                const std::shared_ptr<Inbox>& inbox,
                const boost::asio::any_io_executor& loop) {
    while (!thread.wanted()) {
        if (inbox->waiting >= most_waiting) {
            std::this_thread::sleep_for(stream_slice); // the device counts what it loses
            continue;
        }
        auto packet = handle.bulk_in(endpoint, longest, monotonic_now() + stream_slice);
        if (!packet && packet.error().fault == Fault::link_timeout) continue;
        const bool refused = !packet && packet.error().fault == Fault::refused;
        const bool ended = !packet && !refused;
        hand_over(inbox, loop, std::move(packet));
        if (ended) return;
        if (refused) std::this_thread::sleep_for(after_stall);
    }
}

Task<void> arrival_of(std::shared_ptr<Inbox> inbox) {
    co_await inbox->arrival.async_wait(boost::asio::as_tuple(boost::asio::use_awaitable));
}
/// `before` wants a value.
Task<bool> arrival_or_not(std::shared_ptr<Inbox> inbox) {
    co_await arrival_of(std::move(inbox));
    co_return true;
}

class LibusbLink final : public UsbLink {
public:
    LibusbLink(Scheduler& scheduler, std::shared_ptr<WorkThread> thread, Handle handle)
        : scheduler_{scheduler}
        , thread_{std::move(thread)}
        , entry_{handle->entry()}
        , handle_{std::move(handle)} {}
    /// The handle is closed on its thread.
    ~LibusbLink() override {
        thread_->finish([handle = std::move(handle_)]() mutable { handle.reset(); });
    }
    LibusbLink(const LibusbLink&) = delete;
    LibusbLink& operator=(const LibusbLink&) = delete;

    Task<Result<TimedBytes>> control_in(UsbRequest request, MonotonicTime deadline) override;
    Task<Result<void>>
    bulk_out(int endpoint, std::vector<std::byte> bytes, MonotonicTime deadline) override;
    Task<Result<TimedBytes>>
    bulk_in(int endpoint, std::size_t longest, MonotonicTime deadline) override;
    Task<Result<TimedBytes>>
    next_packet(int endpoint, std::size_t longest, MonotonicTime deadline) override;
    [[nodiscard]] const UsbEntry& entry() const override { return entry_; }

private:
    template <class T>
    Task<Result<T>> call(std::function<Result<T>()> job, MonotonicTime deadline) {
        inbox_.reset(); // the job ends the reading ahead
        return on_thread<T>(thread_, scheduler_, std::move(job), deadline);
    }
    void begin_stream(int endpoint, std::size_t longest);

    Scheduler& scheduler_;
    std::shared_ptr<WorkThread> thread_;
    UsbEntry entry_;
    Handle handle_; ///< used on the thread only
    std::shared_ptr<Inbox> inbox_;
};

Task<Result<TimedBytes>> LibusbLink::control_in(UsbRequest request, MonotonicTime deadline) {
    std::function<Result<TimedBytes>()> job = [handle = handle_, request, deadline] {
        return handle->control_in(request, deadline);
    };
    return call<TimedBytes>(std::move(job), deadline);
}

Task<Result<void>>
LibusbLink::bulk_out(int endpoint, std::vector<std::byte> bytes, MonotonicTime deadline) {
    std::function<Result<void>()> job = [handle = handle_, endpoint, bytes = std::move(bytes),
                                         deadline] {
        return handle->bulk_out(endpoint, bytes, deadline);
    };
    return call<void>(std::move(job), deadline);
}

Task<Result<TimedBytes>>
LibusbLink::bulk_in(int endpoint, std::size_t longest, MonotonicTime deadline) {
    std::function<Result<TimedBytes>()> job = [handle = handle_, endpoint, longest, deadline] {
        return handle->bulk_in(endpoint, longest, deadline);
    };
    return call<TimedBytes>(std::move(job), deadline);
}

void LibusbLink::begin_stream(int endpoint, std::size_t longest) {
    const auto loop = scheduler_.executor();
    inbox_ = std::make_shared<Inbox>(loop);
    // The thread outlives its jobs; a job that held it would have it join itself.
    thread_->post([thread = thread_.get(), handle = handle_, inbox = inbox_, loop, endpoint,
                   longest]() mutable {
        read_ahead(*thread, *handle, endpoint, longest, inbox, loop);
        loop.execute([inbox = std::move(inbox)] {}); // timers die on the loop
    });
}

Task<Result<TimedBytes>>
LibusbLink::next_packet(int endpoint, std::size_t longest, MonotonicTime deadline) {
    if (!inbox_) begin_stream(endpoint, longest);
    const std::shared_ptr<Inbox> inbox = inbox_;
    while (inbox->packets.empty()) {
        Task<bool> arrival = arrival_or_not(inbox);
        const auto came = co_await before(scheduler_, std::move(arrival), deadline);
        if (!came && inbox->packets.empty())
            co_return fail(Fault::link_timeout, entry_.describe() + " does not answer");
    }
    Result<TimedBytes> packet = std::move(inbox->packets.front());
    inbox->packets.pop_front();
    --inbox->waiting;
    co_return packet;
}

} // namespace

Task<Result<std::unique_ptr<UsbLink>>> open_usb_device(Scheduler& scheduler,
                                                       WorkThreads& threads,
                                                       UsbPlace place,
                                                       MonotonicTime deadline) {
    std::string key = place.describe();
    if (place.nth > 0) key += " (" + std::to_string(place.nth + 1) + ")";
    auto thread = threads.start(key);
    if (!thread) co_return tl::unexpected<Error>(thread.error());
    std::function<Result<Handle>()> job = [place = std::move(place)] {
        return UsbHandle::open(place);
    };
    auto opened = co_await on_thread<Handle>(*thread, scheduler, std::move(job), deadline);
    if (!opened) {
        (*thread)->finish();
        co_return tl::unexpected<Error>(opened.error());
    }
    co_return std::make_unique<LibusbLink>(scheduler, *std::move(thread), *std::move(opened));
}

} // namespace axiscal
