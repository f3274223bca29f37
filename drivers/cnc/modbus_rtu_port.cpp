#include "drivers/cnc/modbus_rtu_port.hpp"

#include "drivers/asio_scheduler.hpp"
#include "drivers/cnc/modbus_answer.hpp"

#include <boost/asio/post.hpp>

#include <algorithm>
#include <cerrno>
#include <exception>

namespace axiscal {
namespace {

constexpr auto listen_slice = std::chrono::milliseconds{100}; // bounds how long stop() waits
constexpr auto byte_silence = std::chrono::milliseconds{100}; // a frame with such a hole is dropped
constexpr auto loop_patience = std::chrono::seconds{1};
constexpr Duration first_pause = std::chrono::milliseconds{250},
                   longest_pause = std::chrono::seconds{5};
constexpr std::size_t crc_bytes = 2, address_bytes = 1;

std::uint32_t microseconds(Duration span) {
    return static_cast<std::uint32_t>(
        std::chrono::duration_cast<std::chrono::microseconds>(span).count());
}

/// The thread's side: owns the libmodbus context, touches nothing of the loop but by posting.
class RtuLine {
public:
    RtuLine(TriggerConfig config,
            AddressSpace space,
            boost::asio::any_io_executor loop,
            std::shared_ptr<TriggerDesk> desk,
            std::shared_ptr<RtuMailbox> mailbox)
        : config_{std::move(config)}
        , space_{space}
        , loop_{std::move(loop)}
        , desk_{std::move(desk)}
        , mailbox_{std::move(mailbox)} {}

    void work() {
        Duration pause = first_pause;
        bool told = false;
        while (!mailbox_->stopped()) {
            if (open()) {
                if (told) post_note(Fault::none, config_.serial_path + " is open again.");
                told = false;
                pause = first_pause;
                serve();
                if (mailbox_->stopped()) return;
            }
            if (!told)
                post_note(Fault::link_closed, "The trigger line " + config_.serial_path +
                                                  " failed: " + modbus_strerror(errno) +
                                                  "; it is tried again and again.");
            told = true;
            context_.reset();
            mailbox_->pause(pause);
            pause = std::min(2 * pause, longest_pause);
        }
    }

private:
    bool open() {
        context_.reset(modbus_new_rtu(config_.serial_path.c_str(), config_.baud, config_.parity, 8,
                                      config_.stop_bits));
        if (!context_ || modbus_set_slave(context_.get(), config_.unit_id) != 0) return false;
        modbus_set_indication_timeout(context_.get(), 0, microseconds(listen_slice));
        modbus_set_byte_timeout(context_.get(), 0, microseconds(byte_silence));
        return modbus_connect(context_.get()) == 0;
    }

    /// Returns with the line's error in errno, or when stopped.
    void serve() {
        std::array<std::uint8_t, MODBUS_RTU_MAX_ADU_LENGTH> frame{};
        while (!mailbox_->stopped()) {
            const int length = modbus_receive(context_.get(), frame.data());
            if (length > 0)
                answer({frame.data(), static_cast<std::size_t>(length)}, monotonic_now());
            else if (length < 0 && !is_only_noise(errno))
                break;
        }
        const int cause = errno;
        modbus_close(context_.get());
        errno = cause;
    }

    static bool is_only_noise(int error) {
        return error == ETIMEDOUT || error == EMBBADCRC || error == EMBBADDATA ||
               error == EMBBADSLAVE || error == EINTR || error == EAGAIN;
    }

    void answer(std::span<const std::uint8_t> frame, MonotonicTime at) {
        if (frame.size() < address_bytes + crc_bytes + 1) return;
        if (frame[0] == MODBUS_BROADCAST_ADDRESS) return; // meant for others: nobody is answered
        const auto pdu = frame.subspan(address_bytes, frame.size() - address_bytes - crc_bytes);
        const auto request = parse_modbus_request(pdu);
        auto verdict = request ? space_.check(*request) : request.error();
        if (verdict == ModbusException::none && !request->values.empty()) post_write(*request, at);
        auto image = mailbox_->image_after(posted_writes_, loop_patience);
        if (mailbox_->stopped()) return;
        if (!image) verdict = ModbusException::busy;
        RegisterImage content = image.value_or(RegisterImage{});
        content.stamp(monotonic_now());
        answer_request(context_.get(), frame, verdict, content);
        post_count(verdict);
    }

    void post_write(const ModbusRequest& request, MonotonicTime at) {
        ++posted_writes_;
        boost::asio::post(loop_, [desk = desk_, mailbox = mailbox_, request, at] {
            desk->write(request, at); // on_change puts the new image into the mailbox
            mailbox->count_write();
        });
    }
    void post_count(ModbusException verdict) {
        boost::asio::post(loop_, [desk = desk_, verdict] {
            ++desk->counters.requests;
            if (verdict != ModbusException::none) ++desk->counters.exceptions;
        });
    }
    void post_note(Fault fault, std::string sentence) {
        boost::asio::post(loop_, [desk = desk_, fault, text = std::move(sentence)] {
            if (fault == Fault::none) ++desk->counters.reconnects;
            desk->note(fault, text);
        });
    }

    TriggerConfig config_;
    AddressSpace space_;
    boost::asio::any_io_executor loop_;
    std::shared_ptr<TriggerDesk> desk_; // used on the loop only, inside posts
    std::shared_ptr<RtuMailbox> mailbox_;
    ModbusContext context_;
    std::uint64_t posted_writes_ = 0;
};

} // namespace

ModbusRtuPort::ModbusRtuPort(std::unique_ptr<RegisterMap> map, TriggerConfig config)
    : MappedPort{std::move(map), std::move(config)} {}

ModbusRtuPort::~ModbusRtuPort() {
    stop();
}

void ModbusRtuPort::start(const TriggerContext& context) {
    mailbox_ = std::make_shared<RtuMailbox>();
    desk_->attach(context);
    // The desk outlives both in every post; a raw pointer keeps it from owning itself.
    desk_->on_change = [desk = desk_.get(), mailbox = mailbox_, scheduler = context.scheduler] {
        mailbox->put(desk->image(scheduler->now()));
    };
    desk_->on_change();
    RtuLine line{config_, desk_->space(), context.scheduler->executor(), desk_, mailbox_};
    thread_ = std::thread{[line = std::move(line)]() mutable { line.work(); }};
}

void ModbusRtuPort::stop() {
    desk_->detach();
    desk_->on_change = nullptr;
    if (mailbox_) mailbox_->stop();
    if (thread_.joinable()) thread_.join();
}

Task<Result<void>> ModbusRtuPort::run(TriggerContext context) {
    start(context);
    try {
        co_await desk_->keep_time(context.scheduler);
    } catch (const std::exception&) { // cancelled: the way a port ends
    }
    stop();
    co_return fail(Fault::link_closed, describe() + " was stopped.");
}

std::string ModbusRtuPort::describe() const {
    return std::string{shape_name(config_.shape)} + ", Modbus RTU " + config_.serial_path + " " +
           std::to_string(config_.baud) + " 8" + config_.parity +
           std::to_string(config_.stop_bits) + ", address " + std::to_string(config_.unit_id);
}

} // namespace axiscal
