#include "drivers/shared_wires.hpp"

#include "drivers/appearance.hpp"
#include "drivers/registry.hpp"

#include <filesystem>
#include <string_view>

namespace axiscal {
namespace {

constexpr std::string_view serial_prefix = "serial:";
constexpr std::string_view way_out =
    ": give each its own wire; axiscal devices lists what is plugged in";

/// /dev/ttyUSB0 has a second name below /dev/serial/by-id.
std::string node_of(const std::string& path) {
    std::error_code error;
    const auto node = std::filesystem::weakly_canonical(path, error);
    return error ? path : node.string();
}

/// What the instrument opens, the same for each name of a port; empty: nothing, or nothing known.
std::string wire_of(const InstrumentConfig& config, Settings& options) {
    const auto driver = find_driver(config.driver);
    if (!driver || !config.tape.empty()) return {};
    const Wire wire = (*driver)->shows->wire;
    const bool has_link = wire != Wire::counter && wire != Wire::one_wire && wire != Wire::can;
    if (!has_link || options.refused("link") || !options.has("link")) return {};
    const std::string link = options.text("link");
    if (!link.starts_with(serial_prefix)) return link;
    return std::string{serial_prefix} + node_of(link.substr(serial_prefix.size()));
}

/// Two kinds of USB device may each be "any"; two instruments may call at one TCP port only when
/// they speak one language.
bool both_have_it(const std::string& wire, const std::string& one, const std::string& other) {
    if (wire.starts_with(serial_prefix)) return one == other && one == "modbus";
    return wire.starts_with("tcp:") ? one == other : one != other;
}

} // namespace

void refuse_shared_wires(const std::vector<InstrumentConfig>& configs,
                         std::vector<Settings>& options,
                         const std::string& trigger_line) {
    std::vector<std::string> wires;
    for (std::size_t i = 0; i < configs.size(); ++i) {
        wires.push_back(wire_of(configs[i], options[i]));
        const std::string& wire = wires.back();
        if (wire.empty()) continue;
        if (!trigger_line.empty() && wire == std::string{serial_prefix} + node_of(trigger_line))
            options[i].refuse("link", "is the line of the CNC's triggers (trigger.serial_port) "
                                      "too" +
                                          std::string{way_out});
        for (std::size_t k = 0; k < i; ++k) {
            if (wires[k] != wire || both_have_it(wire, configs[k].driver, configs[i].driver))
                continue;
            options[i].refuse("link", "is the wire of the instrument \"" + configs[k].name +
                                          "\" in line " + std::to_string(configs[k].line) +
                                          " too, and " + configs[k].driver + " and " +
                                          configs[i].driver + " cannot share it" +
                                          std::string{way_out});
            break;
        }
    }
}

} // namespace axiscal
