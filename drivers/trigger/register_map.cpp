#include "drivers/trigger/register_map.hpp"

#include "drivers/trigger/coil_and_index_map.hpp"
#include "drivers/trigger/sequence_block_map.hpp"
#include "drivers/trigger/single_register_map.hpp"

namespace axiscal {
namespace {

using namespace modbus_function;

constexpr auto heartbeat_period = std::chrono::milliseconds{100};

bool inside(int address, int count, int size) {
    return address + count <= size;
}

ModbusException in_table(int address, int count, int size) {
    if (size == 0) return ModbusException::illegal_function;
    return inside(address, count, size) ? ModbusException::none : ModbusException::illegal_address;
}

} // namespace

ModbusException AddressSpace::check(const ModbusRequest& request) const {
    const int read_from = request.read_address, read = request.read_count;
    const int write_to = request.write_address, written = static_cast<int>(request.values.size());
    switch (request.function) {
    case read_coils: return in_table(read_from, read, coils);
    case read_discrete_inputs: return in_table(read_from, read, discrete_inputs);
    case read_holding: return in_table(read_from, read, holding);
    case read_input: return in_table(read_from, read, input);
    case write_coil:
    case write_coils: return in_table(write_to, written, coils);
    case write_register:
    case write_registers: return in_table(write_to, written, writable_holding);
    case read_write_registers:
        if (!inside(read_from, read, holding)) return ModbusException::illegal_address;
        return in_table(write_to, written, writable_holding);
    default: return ModbusException::illegal_function;
    }
}

void RegisterImage::stamp(MonotonicTime now) {
    if (!beats) return;
    const auto beat = static_cast<std::uint16_t>(now.time_since_epoch() / heartbeat_period);
    holding[sequence_block::daemon_heartbeat] = beat;
    input[sequence_block::daemon_heartbeat] = beat;
}

std::unique_ptr<RegisterMap> make_register_map(const TriggerConfig& config) {
    switch (config.shape) {
    case TriggerShape::sequence_block:
        return std::make_unique<SequenceBlockMap>(config.low_word_first, config.watch_heartbeat);
    case TriggerShape::single_register: return std::make_unique<SingleRegisterMap>();
    case TriggerShape::coil_and_index: return std::make_unique<CoilAndIndexMap>(config.index_grace);
    case TriggerShape::dwell: return nullptr;
    }
    return nullptr;
}

} // namespace axiscal
