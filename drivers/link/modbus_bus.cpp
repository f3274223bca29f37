#include "drivers/link/modbus_bus.hpp"

#include "drivers/asio_scheduler.hpp"

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <modbus/modbus.h>

#include <cerrno>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>

namespace axiscal {
namespace {

using boost::asio::steady_timer;

/// After so many requests without a reply a line is opened anew: ftdi_sio stops reading for good at
/// a STALL, until its next opening.
constexpr int silent_requests = 3;

Fault fault_of(int modbus_error) {
    switch (modbus_error) {
    case ETIMEDOUT: return Fault::link_timeout;
    case EMBBADCRC: return Fault::checksum;
    case EMBXILFUN:
    case EMBXILADD:
    case EMBXILVAL:
    case EMBXSFAIL:
    case EMBXSBUSY: return Fault::refused;
    case EMBBADDATA:
    case EMBBADEXC:
    case EMBUNKEXC:
    case EMBMDATA:
    case EMBBADSLAVE: return Fault::bad_frame;
    default: return Fault::link_closed;
    }
}

modbus_t* make_context(const LinkSettings& settings) {
    if (settings.kind == LinkSettings::Kind::tcp)
        return ::modbus_new_tcp_pi(settings.host.c_str(), std::to_string(settings.port).c_str());
    return ::modbus_new_rtu(settings.path.c_str(), settings.baud, settings.parity,
                            settings.data_bits, settings.stop_bits);
}

} // namespace

/// One answer that is waited for. Lives and dies on the loop: the thread knows it weakly.
struct ModbusBus::Pending {
    explicit Pending(const boost::asio::any_io_executor& loop)
        : done{loop, steady_timer::time_point::max()} {}
    std::optional<Result<ModbusWords>> reply;
    steady_timer done;
};

/// The libmodbus context; lives on the bus thread alone.
class ModbusBus::Context {
public:
    explicit Context(const LinkSettings& settings)
        : settings_{settings}
        , context_{make_context(settings)} {}
    ~Context() {
        close();
        if (context_) ::modbus_free(context_);
    }
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    Result<ModbusWords> read(const ModbusRead& request) {
        if (!context_) return failed("no Modbus context for", EINVAL);
        set_timeouts(request.timeout);
        ::modbus_set_slave(context_, request.unit_id);
        if (!connected_ && ::modbus_connect(context_) != 0)
            return failed("no connection to", errno);
        connected_ = true;
        ModbusWords reply;
        reply.words.resize(static_cast<std::size_t>(request.count));
        const auto function =
            request.function == 4 ? ::modbus_read_input_registers : ::modbus_read_registers;
        reply.asked_at = monotonic_now();
        const int got = function(context_, request.address, request.count, reply.words.data());
        const int error_number = errno;
        reply.read_at = monotonic_now();
        if (got == request.count) {
            silent_ = 0;
            return reply;
        }
        auto error = failed("unit " + std::to_string(request.unit_id) + " on", error_number);
        recover(error.value().fault);
        return error;
    }

private:
    void set_timeouts(Duration timeout) {
        const auto us = std::chrono::duration_cast<std::chrono::microseconds>(timeout).count();
        const auto seconds = static_cast<std::uint32_t>(us / 1'000'000);
        const auto rest = static_cast<std::uint32_t>(us % 1'000'000);
        ::modbus_set_response_timeout(context_, seconds, rest);
        // 0: the response timeout bounds the whole reply, also one that trickles in.
        ::modbus_set_byte_timeout(context_, 0, 0);
    }
    [[nodiscard]] tl::unexpected<Error> failed(const std::string& what, int error_number) const {
        const std::string text =
            what + " " + settings_.describe() + ": " + ::modbus_strerror(error_number);
        return fail(fault_of(error_number), text);
    }
    /// A late reply must not be taken for the next one: TCP connects anew, a line is emptied.
    void recover(Fault fault) {
        if (fault == Fault::refused) return;
        const bool serial = settings_.kind == LinkSettings::Kind::serial;
        silent_ = fault == Fault::link_timeout ? silent_ + 1 : 0;
        if (serial && fault != Fault::link_closed && silent_ < silent_requests)
            ::modbus_flush(context_);
        else
            close();
    }
    void close() {
        if (connected_) ::modbus_close(context_);
        connected_ = false;
        silent_ = 0;
    }

    const LinkSettings& settings_;
    modbus_t* context_;
    bool connected_ = false;
    int silent_ = 0; ///< time-outs since the last reply
};

/// What the loop and the thread of one line share.
class ModbusBus::Line {
public:
    Line(LinkSettings settings, boost::asio::any_io_executor loop)
        : settings_{std::move(settings)}
        , loop_{std::move(loop)} {}
    [[nodiscard]] const LinkSettings& settings() const { return settings_; }
    [[nodiscard]] const boost::asio::any_io_executor& loop() const { return loop_; }

    void ask(const ModbusRead& request, const std::shared_ptr<Pending>& asker) {
        {
            const std::lock_guard lock{mutex_};
            orders_.push_back({request, asker});
        }
        changed_.notify_all();
    }
    /// The thread: until stopped.
    void serve() {
        {
            Context context{settings_};
            while (const auto order = next_order()) {
                if (!keep_silent(order->request.gap)) break;
                deliver(order->asker, context.read(order->request));
            }
        }
        const std::lock_guard lock{mutex_};
        ended_ = true;
        changed_.notify_all();
    }
    /// The loop: nothing is posted any more; waits for the thread at most this long.
    void stop(Duration patience) {
        std::unique_lock lock{mutex_};
        stopping_ = true;
        changed_.notify_all();
        changed_.wait_for(lock, patience, [this] { return ended_; });
    }

private:
    struct Order {
        ModbusRead request;
        std::weak_ptr<Pending> asker;
    };
    std::optional<Order> next_order() {
        std::unique_lock lock{mutex_};
        changed_.wait(lock, [this] { return stopping_ || !orders_.empty(); });
        if (stopping_) return std::nullopt;
        Order order = std::move(orders_.front());
        orders_.pop_front();
        return order;
    }
    /// False when the bus stops meanwhile.
    bool keep_silent(Duration gap) {
        std::unique_lock lock{mutex_};
        return !changed_.wait_for(lock, gap, [this] { return stopping_; });
    }
    void deliver(const std::weak_ptr<Pending>& asker, Result<ModbusWords> reply) {
        const std::lock_guard lock{mutex_};
        if (stopping_) return; // the loop may be gone
        auto arrive = [asker, reply = std::move(reply)]() mutable {
            const auto pending = asker.lock();
            if (!pending) return;
            pending->reply = std::move(reply);
            pending->done.cancel();
        };
        boost::asio::post(loop_, std::move(arrive));
    }

    const LinkSettings settings_;
    const boost::asio::any_io_executor loop_;
    std::mutex mutex_; ///< guards all below
    std::condition_variable changed_;
    std::deque<Order> orders_;
    bool stopping_ = false, ended_ = false;
};

ModbusBus::ModbusBus(LinkSettings settings, boost::asio::any_io_executor loop)
    : line_{std::make_shared<Line>(std::move(settings), std::move(loop))} {
    std::thread{[line = line_] { line->serve(); }}.detach();
}

ModbusBus::~ModbusBus() {
    line_->stop(std::chrono::seconds{1});
}

const LinkSettings& ModbusBus::settings() const {
    return line_->settings();
}

Task<Result<ModbusWords>> ModbusBus::read(ModbusRead request) {
    const auto pending = std::make_shared<Pending>(line_->loop());
    line_->ask(request, pending);
    co_await pending->done.async_wait(boost::asio::as_tuple(boost::asio::use_awaitable));
    if (!pending->reply)
        co_return fail(Fault::link_closed, "given up: " + line_->settings().describe());
    co_return *std::move(pending->reply);
}

Result<ModbusBus*> ModbusBuses::bus(const LinkSettings& settings) {
    const bool serial = settings.kind == LinkSettings::Kind::serial;
    auto& line = buses_[serial ? settings.path : settings.describe()];
    if (!line.bus) {
        LinkSettings place = settings;
        if (detour_) {
            AXISCAL_TRY(place, detour_(settings));
        }
        line = {settings.describe(), std::make_unique<ModbusBus>(std::move(place), loop_)};
    }
    if (line.asked != settings.describe())
        return fail(Fault::bad_configuration,
                    settings.describe() + ": another instrument uses this line as " + line.asked);
    return line.bus.get();
}

} // namespace axiscal
