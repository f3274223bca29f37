#include "drivers/link/modbus_bus.hpp"

#include "drivers/asio_scheduler.hpp"

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <modbus/modbus.h>

#include <cerrno>
#include <optional>

namespace axiscal {
namespace {

using boost::asio::steady_timer;

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

/// One request on its way. `reply` and `done` are touched on the loop only.
struct ModbusBus::Pending {
    Pending(ModbusRead of, const boost::asio::any_io_executor& loop)
        : request{of}
        , done{loop, steady_timer::time_point::max()} {}
    ModbusRead request;
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
        const int got = function(context_, request.address, request.count, reply.words.data());
        const int error_number = errno;
        reply.read_at = monotonic_now();
        if (got == request.count) return reply;
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
        if (serial && fault != Fault::link_closed)
            ::modbus_flush(context_);
        else
            close();
    }
    void close() {
        if (connected_) ::modbus_close(context_);
        connected_ = false;
    }

    const LinkSettings& settings_;
    modbus_t* context_;
    bool connected_ = false;
};

ModbusBus::ModbusBus(LinkSettings settings, boost::asio::any_io_executor loop)
    : settings_{std::move(settings)}
    , loop_{std::move(loop)}
    , thread_{&ModbusBus::serve, this} {}

ModbusBus::~ModbusBus() {
    {
        const std::lock_guard lock{mutex_};
        stopping_ = true;
    }
    wake_.notify_all();
    thread_.join();
}

Task<Result<ModbusWords>> ModbusBus::read(ModbusRead request) {
    const auto pending = std::make_shared<Pending>(request, loop_);
    {
        const std::lock_guard lock{mutex_};
        requests_.push_back(pending);
    }
    wake_.notify_all();
    co_await pending->done.async_wait(boost::asio::as_tuple(boost::asio::use_awaitable));
    if (!pending->reply) co_return fail(Fault::link_closed, "given up: " + settings_.describe());
    co_return *std::move(pending->reply);
}

std::shared_ptr<ModbusBus::Pending> ModbusBus::next_request() {
    std::unique_lock lock{mutex_};
    wake_.wait(lock, [this] { return stopping_ || !requests_.empty(); });
    if (stopping_) return nullptr;
    auto pending = std::move(requests_.front());
    requests_.pop_front();
    return pending;
}

/// False when the bus stops meanwhile.
bool ModbusBus::keep_silent(Duration gap) {
    std::unique_lock lock{mutex_};
    return !wake_.wait_for(lock, gap, [this] { return stopping_; });
}

void ModbusBus::serve() {
    Context context{settings_};
    while (auto pending = next_request()) {
        if (!keep_silent(pending->request.gap)) return;
        auto reply = context.read(pending->request);
        // The last reference goes with the handler: timers die on the loop.
        boost::asio::post(loop_,
                          [pending = std::move(pending), reply = std::move(reply)]() mutable {
                              pending->reply = std::move(reply);
                              pending->done.cancel();
                          });
    }
}

Result<ModbusBus*> ModbusBuses::bus(const LinkSettings& settings) {
    const bool serial = settings.kind == LinkSettings::Kind::serial;
    auto& bus = buses_[serial ? settings.path : settings.describe()];
    if (!bus) bus = std::make_unique<ModbusBus>(settings, loop_);
    if (bus->settings().describe() != settings.describe())
        return fail(Fault::bad_configuration, settings.describe() +
                                                  ": another instrument uses this line as " +
                                                  bus->settings().describe());
    return bus.get();
}

} // namespace axiscal
