#pragma once
// The CNC's inputs and outputs between the program that uses them and the Modbus exchange that
// carries them. Here a fault of the handshake is injected. Thread-safe.

#include "scenario.hpp"

#include <array>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>

namespace axiscal::simulate {

/// What the program has set: 0 sequence, 1 target, 2 direction, 3 position, 4 approach, 5 feed,
/// 6 the indexing table, 7 CMD of the sequence-block (0, as long as no program has set it:
/// capture).
using CncOutputs = std::array<double, 8>;
/// Output and value with which a program sends prepare in place of capture.
constexpr int command_output = 7;
constexpr double command_prepare = 1;

/// One write of the exchange, in the order in which the program made them.
struct CncWrite {
    /// Words 1..9 of the sequence-block; only the first for single-register and coil-and-index.
    std::array<std::uint16_t, 9> words{};
    bool is_coil = false, coil = false;
    double not_before_s = 0;
    bool restored = false; ///< written again after a new connection
};

/// What the other side answered last.
struct CncAnswer {
    std::optional<std::uint16_t> done; ///< ACK_SEQ or the echo
    std::uint16_t result = 0, fault_sequence = 0;
    bool acknowledged = false; ///< coil-and-index: the discrete input
};

class CncLines {
public:
    explicit CncLines(CncScenario cnc);

    // the program's side
    /// Output 0 is the sequence (or index): a change makes a request of outputs 1..5 and 7 as they
    /// stand.
    void set_analog(int output, double value, double now_s);
    void set_digital(int output, bool on, double now_s);
    /// Input 0: done equals the sequence; for coil-and-index the discrete input, and input 1 the
    /// comparison.
    [[nodiscard]] bool input(int input) const;

    // the exchange's side
    /// The next write that is due; take it off with written() once it is out.
    [[nodiscard]] std::optional<CncWrite> due(double now_s) const;
    void written();
    /// The connection is new: the last request stands there again, as in a PLC that writes always.
    void connected();
    void answered(const CncAnswer& answer);
    void disconnected();

    [[nodiscard]] CncAnswer answer() const;
    [[nodiscard]] int requests() const;
    /// Words 1..9 for a sequence. Pure.
    static std::array<std::uint16_t, 9> block(const CncScenario& cnc, const CncOutputs& outputs);

private:
    void request(CncWrite write, double now_s);
    [[nodiscard]] const CncFault* fault_now() const;

    mutable std::mutex mutex_;
    CncScenario cnc_;
    CncOutputs analog_{};
    std::deque<CncWrite> queue_;
    std::optional<CncWrite> standing_, standing_coil_;
    CncAnswer answer_;
    int requests_ = 0;
    bool deaf_ = false; ///< an injected fault: the CNC goes on without waiting for the answer
};

} // namespace axiscal::simulate
