#include "drivers/trigger/trigger_ports.hpp"

#include "drivers/trigger/dwell_trigger_port.hpp"
#include "drivers/trigger/mirrored_port.hpp"
#include "drivers/trigger/modbus_rtu_port.hpp"
#include "drivers/trigger/modbus_tcp_port.hpp"

namespace axiscal {

std::unique_ptr<TriggerPort> make_trigger_port(const TriggerConfig& config) {
    auto map = make_register_map(config);
    if (!map) return std::make_unique<DwellTriggerPort>(config);
    switch (config.transport) {
    case TriggerTransport::rtu_server:
        return std::make_unique<ModbusRtuPort>(std::move(map), config);
    case TriggerTransport::tcp_client:
        return std::make_unique<MirroredPort>(std::move(map), config);
    case TriggerTransport::tcp_server:
    case TriggerTransport::none: break;
    }
    return std::make_unique<ModbusTcpPort>(std::move(map), config, ClientPatience{});
}

} // namespace axiscal
