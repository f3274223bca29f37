#pragma once
// Simulated CANopen devices on a bus without a kernel: the models of axiscal-simulate are the wire,
// virtual time is theirs. Tests only.

#include "drivers/wire/can_interface.hpp"
#include "drivers/wire/can_link.hpp"
#include "tests/support/made_instrument.hpp"
#include "tests/support/sample_recorder.hpp"
#include "tests/support/virtual_scheduler.hpp"
#include "wire/can/can_node.hpp"

#include <boost/asio/co_spawn.hpp>

#include <algorithm>
#include <functional>
#include <set>

namespace axiscal::testing {

/// One bus. Devices are borrowed. Frames are stamped when they are sent, whoever reads them later.
class ModelCanBus final : public LinkOpener {
public:
    explicit ModelCanBus(Scheduler& scheduler)
        : scheduler_{scheduler} {}
    Task<Result<std::unique_ptr<ByteLink>>> open(const LinkSettings&, MonotonicTime) override {
        co_return fail(Fault::internal, "a CAN bus is no stream of bytes");
    }
    Task<Result<std::unique_ptr<CanLink>>> open_can(const LinkSettings& settings,
                                                    MonotonicTime) override;

    std::vector<simulate::CanNode*> nodes;
    CanState state = CanState::up;
    /// The next frames from devices that come to nobody.
    int swallow = 0;
    /// They are dropped by the kernel, which counts them.
    int drop = 0;
    /// When the kernel stamps a frame that was sent at a time; empty: at that time.
    std::function<MonotonicTime(MonotonicTime sent)> stamp;
    /// Frames from devices lose all bytes beyond.
    std::size_t longest = 8;
    /// Frames that were heard by no filter of anybody, and those that were.
    int unheard = 0, heard = 0;
    std::vector<CanFrame> sent; ///< by drivers

private:
    friend class ModelCanLink;
    [[nodiscard]] double now_s() const {
        return 1e-9 * static_cast<double>(nanoseconds_of(scheduler_.now()));
    }
    void advance();
    void deliver(const std::vector<simulate::CanMessage>& frames, MonotonicTime at);
    [[nodiscard]] MonotonicTime next_due() const;

    Scheduler& scheduler_;
    std::vector<class ModelCanLink*> links_;
};

class ModelCanLink final : public CanLink {
public:
    ModelCanLink(ModelCanBus& bus, Scheduler& scheduler)
        : bus_{bus}
        , scheduler_{scheduler} {
        bus_.links_.push_back(this);
    }
    ~ModelCanLink() override { std::erase(bus_.links_, this); }
    ModelCanLink(const ModelCanLink&) = delete;
    ModelCanLink& operator=(const ModelCanLink&) = delete;

    Result<void> hear(const std::vector<std::uint32_t>& ids) override {
        ids_ = {ids.begin(), ids.end()};
        return {};
    }
    Task<Result<std::vector<TimedCanFrame>>> read_some(MonotonicTime deadline) override {
        for (;;) {
            if (bus_.state != CanState::up)
                co_return tl::unexpected<Error>(can_absence("can0", bus_.state));
            bus_.advance();
            if (!queue_.empty()) co_return std::exchange(queue_, {});
            if (scheduler_.now() >= deadline) co_return fail(Fault::link_timeout, "nothing came");
            const MonotonicTime next =
                std::max(bus_.next_due(), scheduler_.now() + std::chrono::microseconds{100});
            co_await scheduler_.sleep_until(std::min(deadline, next));
        }
    }
    Task<Result<void>> send(CanFrame frame, MonotonicTime) override {
        if (bus_.state != CanState::up)
            co_return tl::unexpected<Error>(can_absence("can0", bus_.state));
        bus_.sent.push_back(frame);
        simulate::CanMessage message{frame.id, {}, frame.remote};
        for (const std::byte byte : frame.remote ? std::span<const std::byte>{} : frame.bytes())
            message.data.push_back(std::to_integer<std::uint8_t>(byte));
        for (simulate::CanNode* node : bus_.nodes)
            bus_.deliver(node->take(message, bus_.now_s()), scheduler_.now());
        co_return Result<void>{};
    }

private:
    friend class ModelCanBus;
    ModelCanBus& bus_;
    Scheduler& scheduler_;
    std::set<std::uint32_t> ids_;
    std::vector<TimedCanFrame> queue_;
    std::uint64_t dropped_ = 0;
};

inline Task<Result<std::unique_ptr<CanLink>>> ModelCanBus::open_can(const LinkSettings&,
                                                                    MonotonicTime) {
    if (state != CanState::up) co_return tl::unexpected<Error>(can_absence("can0", state));
    co_return std::make_unique<ModelCanLink>(*this, scheduler_);
}

inline void ModelCanBus::deliver(const std::vector<simulate::CanMessage>& frames,
                                 MonotonicTime at) {
    for (const simulate::CanMessage& message : frames) {
        CanFrame frame;
        frame.id = message.id;
        frame.length = std::min(message.data.size(), longest);
        std::ranges::copy(std::as_bytes(std::span{message.data}.first(frame.length)),
                          frame.data.begin());
        if (swallow > 0 && swallow-- > 0) continue;
        const MonotonicTime stamped = stamp ? stamp(at) : at;
        bool taken = false;
        for (ModelCanLink* link : links_) {
            if (!link->ids_.contains(frame.id)) continue;
            taken = true;
            if (drop > 0 && drop-- > 0)
                ++link->dropped_;
            else
                link->queue_.push_back({frame, stamped, link->dropped_});
        }
        ++(taken ? heard : unheard);
    }
}

/// Each device at its own due times, so that frames have the times at which they were sent.
inline void ModelCanBus::advance() {
    for (simulate::CanNode* node : nodes) {
        for (double due_s = std::max(0.0, node->next_due_s()); due_s <= now_s();
             due_s = node->next_due_s()) {
            const double at_s = due_s == 0 ? now_s() : due_s;
            deliver(node->advance(at_s), monotonic_from_ns(std::llround(at_s * 1e9)));
        }
    }
}

inline MonotonicTime ModelCanBus::next_due() const {
    double due_s = now_s() + 1;
    for (const simulate::CanNode* node : nodes)
        due_s = std::min(due_s, node->next_due_s());
    return monotonic_from_ns(static_cast<std::int64_t>(std::ceil(due_s * 1e9)));
}

/// An instrument on the bus, opened again a quarter of a second after its end. Must live as long as
/// the scheduler runs.
class InstrumentOnCan {
public:
    InstrumentOnCan(VirtualScheduler& scheduler,
                    ModelCanBus& bus,
                    const std::string& driver,
                    const std::string& keys)
        : sink{scheduler.now()}
        , instrument{testing::instrument(driver, keys)}
        , scheduler_{scheduler}
        , bus_{bus} {
        sink.name_channels(instrument->channels());
    }
    void start() {
        boost::asio::co_spawn(scheduler_.loop(), keep_running(),
                              [](const std::exception_ptr& bug) { EXPECT_FALSE(bug); });
    }
    [[nodiscard]] const InstrumentCounters& counters() const { return instrument->counters(); }
    [[nodiscard]] std::string last_end() const { return ends.empty() ? "" : describe(ends.back()); }

    SampleRecorder sink;
    std::unique_ptr<Instrument> instrument;
    std::vector<Error> ends;

private:
    Task<void> keep_running() {
        for (;;) {
            const InstrumentContext context{&scheduler_, &bus_, &sink};
            const auto ended = co_await instrument->run(context);
            ends.push_back(ended.error());
            co_await scheduler_.sleep_for(std::chrono::milliseconds{250});
        }
    }
    VirtualScheduler& scheduler_;
    ModelCanBus& bus_;
};

} // namespace axiscal::testing
