#pragma once
// Requests for registers and bits, and which bytes of a line or connection answer one. Pure. Modbus
// over serial line V1.02, 2.5.1 (RTU: unit, PDU, checksum); Modbus Messaging on TCP/IP V1.0b, 3.1.3
// (TCP: transaction, protocol 0, length, unit, PDU).

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace axiscal {

struct ModbusQuestion {
    /// 1 coils, 2 discrete inputs, 3 holding, 4 input registers
    std::uint8_t unit = 1, function = 3;
    std::uint16_t address = 0;
    int count = 1; ///< 1 to 125
};

std::vector<std::byte> rtu_request(const ModbusQuestion& question);
std::vector<std::byte> tcp_request(const ModbusQuestion& question, std::uint16_t transaction);

struct ModbusAnswer {
    enum class Kind : std::uint8_t {
        words,
        exception,  ///< of this unit, or of the gateway before it
        damaged,    ///< its checksum is wrong
        another,    ///< answers something else
        out_of_step ///< no frame: where the next one begins cannot be told
    } kind = Kind::another;
    std::vector<std::uint16_t> words; ///< a bit is 0 or 1
    int exception = 0;
};

/// The answer to one request on an RTU line. A frame does not tell which request it answers: what
/// was on the line before the request must not be fed.
class RtuAnswer {
public:
    explicit RtuAnswer(const ModbusQuestion& question)
        : question_{question} {}
    void feed(std::span<const std::byte> bytes);
    /// Empty while bytes are missing. Whole frames of other units are passed over: late answers.
    std::optional<ModbusAnswer> take();
    [[nodiscard]] bool empty() const { return held_.empty(); }

private:
    ModbusQuestion question_;
    std::vector<std::uint8_t> held_;
};

/// Frames of a connection, from its begin on: the rest of a late answer comes with the next one.
class TcpAnswers {
public:
    void feed(std::span<const std::byte> bytes);
    /// Empty while bytes are missing. Answers of other transactions are passed over.
    std::optional<ModbusAnswer> take(const ModbusQuestion& question, std::uint16_t transaction);

private:
    std::vector<std::uint8_t> held_;
};

} // namespace axiscal
