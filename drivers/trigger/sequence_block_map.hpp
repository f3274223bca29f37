#pragma once
// sequence-block: a request with its whole claim in ten words, our answer in seventeen. Pure.

#include "drivers/trigger/register_map.hpp"

namespace axiscal {

namespace sequence_block {
/// Word addresses. 0..9 are written by the CNC, 10..15 are reserved (read 0), the others are ours.
enum Word : std::uint8_t {
    cnc_heartbeat = 0,
    command = 1,
    command_sequence = 2,
    target_index = 3,
    direction = 4,
    nominal_position = 5, ///< 2 words, signed, 0.1 um or 1e-5 degree
    run_index = 7,
    feed = 8, ///< 2 words, mm/min
    daemon_heartbeat = 16,
    state = 17,
    acknowledged_sequence = 18,
    result = 19,
    measured_position = 20, ///< 2 words, as nominal_position
    deviation = 22,         ///< 2 words, signed, 0.01 um or 1e-6 degree
    next_target = 24,
    next_nominal = 25, ///< 2 words, as nominal_position
    permit = 27,
    air_temperature = 28,      ///< 0.01 degC
    air_pressure = 29,         ///< 0.1 hPa
    air_humidity = 30,         ///< 0.1 %
    material_temperature = 31, ///< 0.01 degC
    fault_sequence = 32
};
inline constexpr int words = 33, cnc_words = 10, daemon_words = words - daemon_heartbeat;
/// What stands for an absent value; no value that is there is ever published as one of them.
inline constexpr std::uint16_t absent = 0x8000;           ///< -32768 in an environment word
inline constexpr std::uint32_t absent_long = 0x8000'0000; ///< in measured_position .. next_nominal
inline constexpr std::uint16_t absent_index = 0xFFFF;     ///< in next_target
/// RESULT of an acknowledged CMD 3; the other numbers are those of cnc_result_code().
inline constexpr std::uint16_t skipped_without_point = 13;
} // namespace sequence_block

class SequenceBlockMap : public RegisterMap {
public:
    /// @param low_word_first  32-bit values; the rule is high word first
    /// @param watch_heartbeat  CNC_HEARTBEAT standing still for more than 2 s is reported
    SequenceBlockMap(bool low_word_first, bool watch_heartbeat);
    [[nodiscard]] AddressSpace space() const override;
    [[nodiscard]] RegisterImage image() const override;
    /// An edge is a change of CMD_SEQ; a number other than 0 withdraws the last RESULT. What is no
    /// command here is refused at once as bad_command.
    MapNews write(const ModbusRequest& request, MonotonicTime at) override;
    MapNews tick(MonotonicTime now) override;
    /// When CNC_HEARTBEAT will have stood still for too long, where that is watched.
    [[nodiscard]] std::optional<MonotonicTime> due() const override;
    void arm() override;
    void end_run(RunEnd end) override;
    void refuse(std::uint16_t sequence, Fault fault) override;
    void show(const PortStatus& status) override;

protected:
    void finish(std::uint16_t sequence) override;
    void finish_skip(std::uint16_t sequence) override;

private:
    void hear_heartbeat(MonotonicTime at, MapNews& news);
    void take_edge(MonotonicTime at, MapNews& news);
    [[nodiscard]] std::optional<TriggerEvent> decode() const;
    [[nodiscard]] std::int32_t long_at(int word) const;
    void put_long(int word, std::uint32_t bits);
    /// STATE and PERMIT, from what the station shows and where the CNC stands.
    void show_permission();

    PortStatus shown_;
    bool ends_with_request_ = false; ///< done becomes no_run_sequence with the next number
    std::array<std::uint16_t, sequence_block::words> words_{};
    std::optional<std::uint16_t> last_request_; ///< empty: none seen since the start
    std::optional<MonotonicTime> heard_at_;
    bool low_word_first_, watch_heartbeat_, armed_ = false, silent_ = false;
};

} // namespace axiscal
