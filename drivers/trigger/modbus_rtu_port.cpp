#include "drivers/trigger/modbus_rtu_port.hpp"

#include "drivers/loop/asio_scheduler.hpp"
#include "drivers/trigger/modbus_answer.hpp"
#include "drivers/trigger/rtu_framer.hpp"

#include <boost/asio/post.hpp>

#include <algorithm>
#include <cerrno>
#include <exception>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

namespace axiscal {
namespace {

constexpr Duration listen_slice = std::chrono::milliseconds{100}; // where nothing tells of stop()
/// A frame with such a hole is dropped: longer than an adapter holds bytes back (16 ms), shorter
/// than a master waits for its answer. The 3.5 characters of the protocol are added.
constexpr auto adapter_hole = std::chrono::milliseconds{50};
constexpr int characters_of_silence = 4, bits_of_character = 11;
constexpr auto longest_forgetting = std::chrono::milliseconds{500}; // a line may never be silent
constexpr auto loop_patience = std::chrono::seconds{1};
constexpr Duration first_pause = std::chrono::milliseconds{250},
                   longest_pause = std::chrono::seconds{5};
constexpr std::size_t crc_bytes = 2, address_bytes = 1;
constexpr std::uint8_t exception_bit = 0x80; // in the function code of answers alone
constexpr std::size_t kernel_buffer = 4096;  // what one read can find at most

Duration silence_at(int baud) {
    return adapter_hole + std::chrono::microseconds{std::int64_t{1'000'000} * bits_of_character *
                                                    characters_of_silence / baud};
}

/// What divides frames, 3.5 characters, above 19200 baud a fixed time (serial line V1.02,
/// 2.5.1.1): a master that hears an answer begin earlier takes it for more of its own request.
Duration silence_between_frames(int baud) {
    constexpr int fixed_above_baud = 19'200;
    if (baud > fixed_above_baud) return std::chrono::microseconds{1750};
    return std::chrono::microseconds{std::int64_t{3'500'000} * bits_of_character / baud};
}

/// The thread's side: owns the line, touches nothing of the loop but by posting. libmodbus opens
/// it and writes the answers. It does not read: after a request to another slave it takes the next
/// frame for that slave's answer, and where none comes the next request to us is lost (3.1.6).
class RtuLine {
public:
    RtuLine(TriggerConfig config,
            AddressSpace space,
            boost::asio::any_io_executor loop,
            std::shared_ptr<TriggerServer> server,
            std::shared_ptr<RtuMailbox> mailbox)
        : config_{std::move(config)}
        , space_{space}
        , loop_{std::move(loop)}
        , server_{std::move(server)}
        , mailbox_{std::move(mailbox)} {}

    void work() {
        Duration pause = first_pause;
        bool reported = false;
        while (!mailbox_->stopped()) {
            if (open()) {
                if (reported) post_note(Fault::none, config_.serial_path + " is open again.");
                reported = false;
                pause = first_pause;
                serve();
                if (mailbox_->stopped()) return;
            }
            if (!reported)
                post_note(Fault::link_closed, "The trigger line " + config_.serial_path +
                                                  " failed: " + modbus_strerror(errno) +
                                                  "; it is tried again and again.");
            reported = true;
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
        return modbus_connect(context_.get()) == 0 && forget_what_was_before();
    }

    /// What lies in the kernel or the adapter was for whoever listened before, and its master waits
    /// no more: until the line was silent once, nothing is a request.
    bool forget_what_was_before() {
        ::tcflush(modbus_get_socket(context_.get()), TCIFLUSH);
        const MonotonicTime limit = monotonic_now() + longest_forgetting;
        while (!mailbox_->stopped() && monotonic_now() < limit) {
            const auto arrived = read(silence_at(config_.baud));
            if (!arrived) return false;
            if (arrived->empty()) break;
        }
        return true;
    }

    /// Between two frames nothing is waited for but the line and the end.
    [[nodiscard]] std::optional<Duration> patience_between_frames() const {
        return mailbox_->stop_signal() >= 0 ? std::nullopt : std::optional{listen_slice};
    }

    /// Empty: nothing came for so long, or it is to stop. None: the line failed, errno says how.
    std::optional<std::span<const std::uint8_t>> read(std::optional<Duration> patience) {
        const auto wait =
            std::chrono::ceil<std::chrono::milliseconds>(patience.value_or(listen_slice));
        const int wait_ms = patience ? static_cast<int>(wait.count()) : -1;
        for (;;) {
            std::array<pollfd, 2> ends{};
            ends[0] = {modbus_get_socket(context_.get()), POLLIN, 0};
            ends[1] = {mailbox_->stop_signal(), POLLIN, 0};
            const int ready = ::poll(ends.data(), ends.size(), wait_ms);
            const bool stopping = ready > 0 && ends[1].revents != 0;
            if (ready == 0 || stopping) return std::span<const std::uint8_t>{};
            const ssize_t count = ready < 0 ? -1 : ::read(ends[0].fd, came_.data(), came_.size());
            if (count > 0) return std::span{came_}.first(static_cast<std::size_t>(count));
            if (count < 0 && (errno == EINTR || errno == EAGAIN)) continue;
            if (count == 0) errno = ECONNRESET; // the adapter was pulled
            return std::nullopt;
        }
    }

    /// Returns with the line's error in errno, or when stopped.
    void serve() {
        RtuFramer framer{static_cast<std::uint8_t>(config_.unit_id)};
        while (!mailbox_->stopped()) {
            const bool within = framer.pending();
            const auto arrived =
                read(within ? std::optional{silence_at(config_.baud)} : patience_between_frames());
            if (!arrived) break;
            if (arrived->empty())
                framer.silence();
            else
                framer.feed(*arrived);
            answer_last(framer, monotonic_now());
        }
        const int cause = errno;
        modbus_close(context_.get());
        errno = cause;
    }

    /// Nobody waits any more for the answer to a request that has something behind it: the master
    /// has gone on, and the answer would be taken for another one's.
    void answer_last(RtuFramer& framer, MonotonicTime at) {
        std::vector<std::uint8_t> last;
        while (auto frame = framer.next()) {
            if (is_request_to_us(last)) post([](PortCounters& counters) { ++counters.overtaken; });
            last = *std::move(frame);
        }
        if (is_request_to_us(last)) answer(last, at);
    }

    [[nodiscard]] bool is_request_to_us(std::span<const std::uint8_t> frame) const {
        return !frame.empty() && frame[0] == config_.unit_id && frame[1] < exception_bit;
    }

    void answer(std::span<const std::uint8_t> frame, MonotonicTime at) {
        const auto pdu = frame.subspan(address_bytes, frame.size() - address_bytes - crc_bytes);
        const auto request = parse_modbus_request(pdu);
        auto verdict = request ? space_.check(*request) : request.error();
        if (verdict == ModbusException::none && !request->values.empty())
            post_write(*request, at);
        else
            post_look();
        auto image = mailbox_->image_after(posted_, loop_patience);
        if (mailbox_->stopped()) return;
        if (!image) verdict = ModbusException::busy;
        // Stamped by the loop alone: where it stands still, so does DAEMON_HEARTBEAT.
        const RegisterImage content = image.value_or(RegisterImage{});
        if (const Duration left = at + silence_between_frames(config_.baud) - monotonic_now();
            left > Duration{})
            mailbox_->pause(left);
        if (mailbox_->stopped()) return;
        answer_request(context_.get(), frame, verdict, content);
        post([verdict](PortCounters& counters) {
            ++counters.requests;
            if (verdict != ModbusException::none) ++counters.exceptions;
        });
    }

    void post_look() {
        ++posted_;
        boost::asio::post(loop_, [server = server_, mailbox = mailbox_] {
            server->look();
            mailbox->count();
        });
    }
    void post_write(const ModbusRequest& request, MonotonicTime at) {
        ++posted_;
        boost::asio::post(loop_, [server = server_, mailbox = mailbox_, request, at] {
            server->write(request, at); // on_change puts the new image into the mailbox
            mailbox->count();
        });
    }
    template <class Count> void post(Count count) {
        boost::asio::post(loop_, [server = server_, count] { count(server->counters); });
    }
    void post_note(Fault fault, std::string sentence) {
        boost::asio::post(loop_, [server = server_, fault, text = std::move(sentence)] {
            if (fault == Fault::none) ++server->counters.reconnects;
            server->note(fault, text);
        });
    }

    TriggerConfig config_;
    AddressSpace space_;
    boost::asio::any_io_executor loop_;
    std::shared_ptr<TriggerServer> server_; // used on the loop only, inside posts
    std::shared_ptr<RtuMailbox> mailbox_;
    ModbusContext context_;
    std::array<std::uint8_t, kernel_buffer> came_{};
    std::uint64_t posted_ = 0; ///< requests, to be answered by the loop
};

} // namespace

ModbusRtuPort::ModbusRtuPort(std::unique_ptr<RegisterMap> map, TriggerConfig config)
    : MappedPort{std::move(map), std::move(config)} {}

ModbusRtuPort::~ModbusRtuPort() {
    stop();
}

void ModbusRtuPort::start(const TriggerContext& context) {
    mailbox_ = std::make_shared<RtuMailbox>();
    server_->attach(context);
    // The server outlives both in every post; a raw pointer keeps it from owning itself.
    server_->on_change = [server = server_.get(), mailbox = mailbox_,
                          scheduler = context.scheduler] {
        mailbox->put(server->image(scheduler->now()));
    };
    server_->on_change();
    RtuLine line{config_, server_->space(), context.scheduler->executor(), server_, mailbox_};
    thread_ = std::thread{[line = std::move(line)]() mutable { line.work(); }};
}

void ModbusRtuPort::stop() {
    server_->detach();
    server_->on_change = nullptr;
    if (mailbox_) mailbox_->stop();
    if (thread_.joinable()) thread_.join();
}

Task<Result<void>> ModbusRtuPort::run(TriggerContext context) {
    start(context);
    try {
        co_await server_->keep_time(context.scheduler);
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
