#include "drivers/trigger/modbus_client.hpp"

#include "drivers/framing/modbus_reply.hpp"
#include "drivers/trigger/mbap_framer.hpp"

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/connect.hpp>
#include <boost/asio/experimental/awaitable_operators.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/asio/write.hpp>

#include <variant>

namespace axiscal {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using namespace asio::experimental::awaitable_operators;

constexpr auto quietly = asio::as_tuple(asio::use_awaitable);
constexpr auto answer_patience = std::chrono::seconds{1};
constexpr auto connect_patience = std::chrono::seconds{3};
constexpr std::uint8_t read_function = 3, write_function = 16;

void put_word(std::vector<std::uint8_t>& bytes, int word) {
    bytes.push_back(static_cast<std::uint8_t>(word >> 8));
    bytes.push_back(static_cast<std::uint8_t>(word));
}

std::string exception_text(int code) {
    switch (code) {
    case 1: return "1 (it does not know this function)";
    case 2: return "2 (no such address: check base_address and the area it opens to Modbus)";
    case 3: return "3 (illegal value)";
    default: return std::to_string(code);
    }
}

} // namespace

ModbusClient::ModbusClient(Scheduler* scheduler, std::string host, int port, int unit_id)
    : scheduler_{scheduler}
    , host_{std::move(host)}
    , port_{port}
    , unit_id_{unit_id}
    , socket_{scheduler->executor()} {}

std::string ModbusClient::place() const {
    return host_ + ":" + std::to_string(port_);
}

Task<Result<void>> ModbusClient::connect() {
    auto reaching = reach();
    auto limit = scheduler_->sleep_for(connect_patience);
    auto first = co_await (std::move(reaching) || std::move(limit));
    if (first.index() == 0) co_return std::get<0>(std::move(first));
    co_return fail(Fault::link_timeout, "The CNC's Modbus server " + place() + " is silent.");
}

Task<Result<void>> ModbusClient::reach() {
    boost::system::error_code named;
    std::vector<tcp::endpoint> endpoints;
    const auto address = asio::ip::make_address(host_, named);
    if (!named) {
        endpoints.emplace_back(address, static_cast<std::uint16_t>(port_));
    } else {
        tcp::resolver resolver{scheduler_->executor()};
        const auto [unknown, found] =
            co_await resolver.async_resolve(host_, std::to_string(port_), quietly);
        if (unknown)
            co_return fail(Fault::link_closed, "No address is known for the CNC " + host_ + ".",
                           unknown);
        for (const auto& entry : found)
            endpoints.push_back(entry.endpoint());
    }
    const auto [error, endpoint] = co_await asio::async_connect(socket_, endpoints, quietly);
    if (error)
        co_return fail(Fault::link_closed,
                       "The CNC's Modbus server " + place() + " is not reached: is it started?",
                       error);
    boost::system::error_code ignored; // only slower without it
    socket_.set_option(tcp::no_delay(true), ignored);
    co_return Result<void>{};
}

Task<Result<ModbusClient::Bytes>> ModbusClient::ask(Bytes pdu) {
    auto talking = talk(std::move(pdu));
    auto limit = scheduler_->sleep_for(answer_patience);
    auto first = co_await (std::move(talking) || std::move(limit));
    if (first.index() == 0) co_return std::get<0>(std::move(first));
    co_return fail(Fault::link_timeout, "The CNC's Modbus server " + place() + " is silent.");
}

Task<Result<ModbusClient::Bytes>> ModbusClient::talk(Bytes pdu) {
    ++transaction_;
    out_.clear();
    put_word(out_, transaction_);
    put_word(out_, 0);
    put_word(out_, static_cast<int>(pdu.size() + 1));
    out_.push_back(static_cast<std::uint8_t>(unit_id_));
    out_.insert(out_.end(), pdu.begin(), pdu.end());
    const auto [unsent, sent] = co_await asio::async_write(socket_, asio::buffer(out_), quietly);
    if (unsent) co_return fail(Fault::link_closed, place() + " hung up.", unsent);
    in_.resize(mbap_header);
    const auto [cut, header] = co_await asio::async_read(socket_, asio::buffer(in_), quietly);
    if (cut) co_return fail(Fault::link_closed, place() + " hung up.", cut);
    const auto length = modbus_reply_length(in_, transaction_, static_cast<std::uint8_t>(unit_id_));
    if (!length) co_return fail(Fault::bad_frame, place() + " does not answer in Modbus.");
    in_.resize(*length);
    const auto [torn, rest] = co_await asio::async_read(socket_, asio::buffer(in_), quietly);
    if (torn) co_return fail(Fault::link_closed, place() + " hung up.", torn);
    const ModbusReplyKind kind = kind_of_modbus_reply(in_, pdu[0]);
    if (kind == ModbusReplyKind::exception)
        co_return fail(Fault::refused, place() + " answers function " + std::to_string(pdu[0]) +
                                           " with exception " + exception_text(in_[1]) + ".");
    if (kind == ModbusReplyKind::other)
        co_return fail(Fault::bad_frame, place() + " answers something else.");
    co_return in_;
}

Task<Result<std::vector<std::uint16_t>>> ModbusClient::read_holding(int address, int count) {
    Bytes pdu{read_function};
    put_word(pdu, address);
    put_word(pdu, count);
    auto asked = co_await ask(std::move(pdu));
    AXISCAL_CO_TRY(const Bytes answer, std::move(asked));
    auto words = registers_of_reply(answer, count);
    if (!words) co_return fail(Fault::bad_frame, place() + " sent another number of registers.");
    co_return *std::move(words);
}

Task<Result<void>> ModbusClient::write_registers(int address, std::vector<std::uint16_t> words) {
    Bytes pdu{write_function};
    put_word(pdu, address);
    put_word(pdu, static_cast<int>(words.size()));
    pdu.push_back(static_cast<std::uint8_t>(2 * words.size()));
    for (const auto word : words)
        put_word(pdu, word);
    const Bytes expected(pdu.begin(), pdu.begin() + 5);
    auto asked = co_await ask(std::move(pdu));
    AXISCAL_CO_TRY(const Bytes answer, std::move(asked));
    if (answer != expected)
        co_return fail(Fault::bad_frame, place() + " wrote another block than it was sent.");
    co_return Result<void>{};
}

} // namespace axiscal
