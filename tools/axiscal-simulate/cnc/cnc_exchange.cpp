#include "cnc/cnc_exchange.hpp"

#include <modbus.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <thread>

namespace axiscal::simulate {

namespace {

/// Words of the sequence-block.
enum Word { heartbeat_word = 0, command_word = 1, done_word = 18, fault_word = 32 };
constexpr int daemon_words = fault_word - done_word + 1;
constexpr double beat_s = 0.1;
constexpr int response_timeout_us = 500000;
constexpr auto reconnect_after = std::chrono::milliseconds{200};

} // namespace

/// One connection; libmodbus contexts belong to one thread.
struct CncClient::Line {
    explicit Line(modbus_t* made)
        : context{made} {}
    ~Line() {
        modbus_close(context);
        modbus_free(context);
    }
    Line(const Line&) = delete;
    Line& operator=(const Line&) = delete;
    modbus_t* context;
};

CncClient::CncClient(CncScenario cnc, CncLines& lines, SimClock clock)
    : cnc_{std::move(cnc)}
    , lines_{lines}
    , clock_{clock}
    , address_{cnc_.host, cnc_.port} {}

int CncClient::port() const {
    const std::lock_guard lock{address_mutex_};
    return address_.port;
}

void CncClient::redirect(DaemonAddress address) {
    const std::lock_guard lock{address_mutex_};
    address_ = std::move(address);
    redirected_ = true;
}

std::unique_ptr<CncClient::Line> CncClient::connect() {
    modbus_t* context = nullptr;
    if (cnc_.transport == "rtu") {
        context = modbus_new_rtu(cnc_.path.c_str(), cnc_.baud, cnc_.parity, 8, 1);
    } else {
        const std::lock_guard lock{address_mutex_};
        if (address_.port == 0) return nullptr; // not told yet
        context = modbus_new_tcp(address_.host.c_str(), address_.port);
        redirected_ = false;
    }
    if (context == nullptr) return nullptr;
    auto line = std::make_unique<Line>(context);
    modbus_set_slave(context, cnc_.unit);
    modbus_set_response_timeout(context, 0, response_timeout_us);
    if (modbus_connect(context) != 0) return nullptr;
    // An answer that came too late would be taken for that of the next request, for ever.
    modbus_flush(context);
    return line;
}

bool CncClient::write_due(Line& line) {
    while (const auto write = lines_.due(clock_.now_s())) {
        int sent = 0;
        if (write->is_coil) {
            const std::uint8_t bit = write->coil ? 1 : 0;
            sent = modbus_write_bits(line.context, 0, 1, &bit);
        } else if (cnc_.shape == "sequence-block") {
            sent =
                modbus_write_registers(line.context, cnc_.base_address + command_word,
                                       static_cast<int>(write->words.size()), write->words.data());
        } else {
            sent = modbus_write_registers(line.context, cnc_.base_address, 1, write->words.data());
        }
        if (sent < 0) return false;
        lines_.written();
    }
    return true;
}

bool CncClient::read_answer(Line& line) {
    CncAnswer answer;
    if (cnc_.shape == "coil-and-index") {
        std::uint8_t bit = 0;
        if (modbus_read_input_bits(line.context, 0, 1, &bit) < 0) return false;
        answer.acknowledged = bit != 0;
        std::uint16_t done = 0;
        if (modbus_read_input_registers(line.context, 0, 1, &done) < 0) return false;
        answer.done = done;
    } else if (cnc_.shape == "single-register") {
        std::uint16_t echo = 0;
        if (modbus_read_input_registers(line.context, cnc_.base_address, 1, &echo) < 0)
            return false;
        answer.done = echo;
    } else {
        std::uint16_t words[daemon_words] = {};
        const int first = cnc_.base_address + done_word;
        if (modbus_read_registers(line.context, first, daemon_words, words) < 0) return false;
        answer.done = words[0];
        answer.result = words[1];
        answer.fault_sequence = words[fault_word - done_word];
    }
    lines_.answered(answer);
    return true;
}

bool CncClient::beat(Line& line) {
    if (cnc_.shape != "sequence-block" || clock_.now_s() < next_beat_s_) return true;
    next_beat_s_ = clock_.now_s() + beat_s;
    ++beat_;
    return modbus_write_registers(line.context, cnc_.base_address + heartbeat_word, 1, &beat_) >= 0;
}

/// One pass in the order of a PLC: outputs, then inputs.
bool CncClient::pass(Line& line) {
    return write_due(line) && beat(line) && read_answer(line);
}

void CncClient::run(std::stop_token stop) {
    std::unique_ptr<Line> line;
    const auto period = std::chrono::duration<double>(cnc_.poll_s);
    while (!stop.stop_requested()) {
        if (!line) {
            line = connect();
            connected_ = line != nullptr;
            if (line) lines_.connected();
        }
        const bool held = line && !redirected_ && pass(*line);
        if (held) {
            std::this_thread::sleep_for(period);
            continue;
        }
        if (line) lines_.disconnected();
        line.reset();
        connected_ = false;
        std::this_thread::sleep_for(reconnect_after);
    }
}

CncServer::CncServer(CncScenario cnc, CncLines& lines, SimClock clock)
    : cnc_{std::move(cnc)}
    , lines_{lines}
    , clock_{clock} {
    bank_.functions = {3, 16};
    for (int word = 0; word < 64; ++word)
        bank_.holding[cnc_.base_address + word] = 0;
}

Result<std::unique_ptr<CncServer>>
CncServer::open(CncScenario cnc, CncLines& lines, SimClock clock) {
    std::unique_ptr<CncServer> server{new CncServer{std::move(cnc), lines, clock}};
    auto answer = [raw = server.get()](int, std::span<const std::uint8_t> pdu) {
        return raw->answer(pdu);
    };
    AXISCAL_TRY(server->slave_, TcpSlave::listen(server->cnc_.port, std::move(answer)));
    return server;
}

/// The CNC's own words as they stand now.
void CncServer::refresh() {
    const int base = cnc_.base_address;
    bank_.holding[base + heartbeat_word] =
        static_cast<std::uint16_t>(std::llround(clock_.now_s() / beat_s));
    if (const auto write = lines_.due(clock_.now_s())) {
        for (std::size_t i = 0; i < write->words.size(); ++i)
            bank_.holding[base + command_word + static_cast<int>(i)] = write->words[i];
        lines_.written();
    }
}

Bytes CncServer::answer(std::span<const std::uint8_t> pdu) {
    heard_ = true;
    Bytes reply = answer_pdu(bank_, pdu);
    const int base = cnc_.base_address;
    if (!pdu.empty() && pdu[0] == 16)
        lines_.answered({bank_.holding[base + done_word], bank_.holding[base + done_word + 1],
                         bank_.holding[base + fault_word]});
    return reply;
}

void CncServer::run(std::stop_token stop) {
    slave_->run(stop, [this] { refresh(); });
}

} // namespace axiscal::simulate
