#pragma once
// The CNC is the Modbus server and we are its client: the sequence-block lies in the CNC's own
// registers, from a base address on. Loop-bound.

#include "drivers/trigger/modbus_client.hpp"
#include "drivers/trigger/trigger_server.hpp"

namespace axiscal {

/// Reads the CNC's ten words with one FC3 each poll, and once more when CMD_SEQ has changed: a
/// block is used only when both readings agree. Writes our seventeen words with one FC16 when they
/// changed, which the heartbeat does each 100 ms. Connects again for ever, pausing 0.25 to 5 s.
class MirroredPort final : public MappedPort {
public:
    MirroredPort(std::unique_ptr<RegisterMap> map, TriggerConfig config);
    Task<Result<void>> run(TriggerContext context) override;
    [[nodiscard]] std::string describe() const override;

private:
    using Words = std::vector<std::uint16_t>;
    Task<void> stay_connected(Scheduler* scheduler);
    Task<Result<void>> exchange(ModbusClient& cnc, Scheduler* scheduler);
    Task<Result<void>> read_request(ModbusClient& cnc, Scheduler* scheduler);
    Task<Result<void>> write_answer(ModbusClient& cnc, Scheduler* scheduler);

    std::optional<std::uint16_t> last_sequence_; ///< CMD_SEQ of the last block used
    Words last_written_;                         ///< empty: nothing on this connection yet
};

} // namespace axiscal
