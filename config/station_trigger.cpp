#include "config/station_readers.hpp"

#include <initializer_list>

namespace axiscal {
namespace {

using namespace std::chrono_literals;
using Keys = std::initializer_list<const char*>;

TriggerShape read_shape(Settings& trigger) {
    const std::string shape =
        trigger.choice("shape", {"sequence-block", "single-register", "coil-and-index", "dwell"});
    if (shape == "single-register") return TriggerShape::single_register;
    if (shape == "coil-and-index") return TriggerShape::coil_and_index;
    return shape == "dwell" ? TriggerShape::dwell : TriggerShape::sequence_block;
}

TriggerTransport read_transport(Settings& trigger, TriggerShape shape) {
    const bool dwell = shape == TriggerShape::dwell;
    const std::string written =
        trigger.choice("transport", {"tcp", "tcp-mirrored", "rtu", "none"},
                       dwell ? std::optional<std::string>{"none"} : std::nullopt);
    if (trigger.refused("transport") || trigger.refused("shape"))
        return dwell ? TriggerTransport::none : TriggerTransport::tcp_server;
    if (dwell && written != "none")
        trigger.refuse("transport", "\"" + written +
                                        "\" does not go with shape \"dwell\", which watches the "
                                        "axis and has no wire: remove transport");
    if (!dwell && written == "none")
        trigger.refuse("transport",
                       "\"none\" goes with shape \"dwell\" only: say \"tcp\" or \"rtu\"");
    if (written == "tcp-mirrored" && shape != TriggerShape::sequence_block && !dwell)
        trigger.refuse("transport", "\"tcp-mirrored\" (the CNC is the server) exists for shape "
                                    "\"sequence-block\" only");
    if (written == "tcp-mirrored") return TriggerTransport::tcp_client;
    if (written == "rtu") return TriggerTransport::rtu_server;
    return written == "none" ? TriggerTransport::none : TriggerTransport::tcp_server;
}

/// Keys that say nothing here mislead the next reader of the file.
void refuse_unused(Settings& trigger, bool used, Keys keys, const std::string& owner) {
    for (const char* key : keys)
        if (trigger.has(key) && !used)
            trigger.refuse(key, "belongs to " + owner + " and says nothing here: remove it");
}

/// Modbus has no password: who may reach the door may write to it.
void read_allowed_clients(Settings& trigger, TriggerConfig& config) {
    for (const std::string& client : trigger.texts("allowed_clients", std::vector<std::string>{})) {
        if (auto range = parse_address_range(client))
            config.allowed_clients.push_back(*range);
        else
            trigger.refuse("allowed_clients", range.error().detail);
    }
    const bool judged = trigger.refused("host") || trigger.refused("allowed_clients");
    if (judged || is_loopback(config.host) || !config.allowed_clients.empty()) return;
    trigger.refuse("host", "\"" + config.host +
                               "\" is heard by other computers: name those that may connect, as in "
                               "allowed_clients = [\"192.168.10.20\"]");
}

void read_tcp(Settings& trigger, TriggerConfig& config) {
    const bool server = config.transport == TriggerTransport::tcp_server;
    const bool client = config.transport == TriggerTransport::tcp_client;
    refuse_unused(trigger, server || client, {"host", "port"}, "the transports over TCP");
    refuse_unused(trigger, server, {"client_limit", "allowed_clients"}, "transport \"tcp\"");
    refuse_unused(trigger, client, {"base_address", "poll_interval"}, "transport \"tcp-mirrored\"");
    if (server) {
        config.host = read_address(trigger, "host", config.host);
        config.client_limit =
            static_cast<int>(trigger.integer("client_limit", 1, 100, config.client_limit));
        read_allowed_clients(trigger, config);
    }
    if (client) {
        config.host = trigger.text("host");
        config.base_address = static_cast<int>(trigger.integer("base_address", 0, 65536 - 33, 0));
        config.poll_interval = trigger.duration("poll_interval", 20ms, 1s, config.poll_interval);
    }
    if (server || client) config.port = static_cast<int>(trigger.integer("port", 1, 65535));
}

void read_serial(Settings& trigger, TriggerConfig& config) {
    const bool rtu = config.transport == TriggerTransport::rtu_server;
    refuse_unused(trigger, rtu, {"serial_port", "baud", "parity", "stop_bits"},
                  "transport \"rtu\"");
    if (!rtu) return;
    config.serial_path = read_absolute_path(trigger, "serial_port");
    config.baud = static_cast<int>(trigger.integer("baud", 1200, 1'000'000, config.baud));
    const std::string parity = trigger.choice("parity", {"none", "even", "odd"}, "none");
    config.parity = parity == "even" ? 'E' : parity == "odd" ? 'O' : 'N';
    config.stop_bits = static_cast<int>(trigger.integer("stop_bits", 1, 2, config.stop_bits));
}

void read_shape_keys(Settings& trigger, TriggerConfig& config) {
    const bool block = config.shape == TriggerShape::sequence_block;
    const bool coil = config.shape == TriggerShape::coil_and_index;
    const bool wired = config.shape != TriggerShape::dwell;
    refuse_unused(trigger, wired, {"unit_id"}, "the Modbus shapes");
    refuse_unused(trigger, block, {"low_word_first", "watch_heartbeat"},
                  "shape \"sequence-block\"");
    refuse_unused(trigger, coil, {"index_grace"}, "shape \"coil-and-index\"");
    if (wired) config.unit_id = static_cast<int>(trigger.integer("unit_id", 1, 247, 1));
    if (block) {
        config.low_word_first = trigger.flag("low_word_first", config.low_word_first);
        config.watch_heartbeat = trigger.flag("watch_heartbeat", config.watch_heartbeat);
    }
    if (coil) config.index_grace = trigger.duration("index_grace", 1ms, 5s, config.index_grace);
}

/// A halt counts only after the axis was seen to leave the last one: a reversal within window and
/// hysteresis would give one point where two are awaited.
void refuse_unseen_overrun(Settings& trigger,
                           AxisUnits units,
                           const CycleConfig& cycle,
                           const TriggerConfig& config) {
    const Length reach = config.window + config.hysteresis;
    const bool known = cycle.overrun > Length{}; // else it is refused already
    if (!known || cycle.overrun > reach) return;
    trigger.refuse(
        "hysteresis",
        "and window together are " + units.write_coordinate(reach) +
            ", and the axis turns after cycle.overrun = " + units.write_coordinate(cycle.overrun) +
            ": it would not be seen to leave. Make the overrun larger than the two, or "
            "the two smaller");
}

void read_dwell(Settings& trigger,
                AxisUnits units,
                const CycleConfig& cycle,
                TriggerConfig& config) {
    const bool dwell = config.shape == TriggerShape::dwell;
    refuse_unused(trigger, dwell,
                  {"window", "stability_range", "stability_period", "hysteresis", "minimum_halt"},
                  "shape \"dwell\"");
    if (!dwell) return;
    config.window = units.coordinate(trigger, "window", um(1), mm(50));
    config.stability_range = units.coordinate(trigger, "stability_range", nm(1), mm(1));
    config.stability_period =
        trigger.duration("stability_period", 10ms, 60s, config.stability_period);
    config.hysteresis = units.coordinate(trigger, "hysteresis", um(1), mm(50));
    config.minimum_halt = trigger.duration("minimum_halt", 10ms, 10min, config.minimum_halt);
    if (!trigger.refused("window") && !trigger.refused("hysteresis"))
        refuse_unseen_overrun(trigger, units, cycle, config);
}

} // namespace

void read_trigger(Settings trigger,
                  AxisUnits units,
                  const CycleConfig& cycle,
                  TriggerConfig& config) {
    config.shape = read_shape(trigger);
    config.transport = read_transport(trigger, config.shape);
    if (trigger.refused("shape") || trigger.refused("transport")) {
        trigger.accept_rest(); // which keys belong here is told when these two are right
        return;
    }
    read_tcp(trigger, config);
    read_serial(trigger, config);
    read_shape_keys(trigger, config);
    read_dwell(trigger, units, cycle, config);
}

} // namespace axiscal
