#include "config/serial_port_name.hpp"
#include "config/station_readers.hpp"

#include <initializer_list>

namespace axiscal {
namespace {

using namespace std::chrono_literals;
using Keys = std::initializer_list<const char*>;

/// Which other keys belong to the table. A word that is not known, or that contradicts the other
/// one, decides nothing.
struct TriggerWords {
    std::optional<TriggerShape> shape;
    std::optional<TriggerTransport> transport;
};

TriggerShape read_shape(Settings& trigger) {
    const std::string shape =
        trigger.choice("shape", {"sequence-block", "single-register", "coil-and-index", "dwell"});
    if (shape == "single-register") return TriggerShape::single_register;
    if (shape == "coil-and-index") return TriggerShape::coil_and_index;
    return shape == "dwell" ? TriggerShape::dwell : TriggerShape::sequence_block;
}

TriggerTransport transport_of(const std::string& word) {
    if (word == "tcp-mirrored") return TriggerTransport::tcp_client;
    if (word == "rtu") return TriggerTransport::rtu_server;
    return word == "none" ? TriggerTransport::none : TriggerTransport::tcp_server;
}

void refuse_contradiction(Settings& trigger, TriggerShape shape, const std::string& transport) {
    const bool dwell = shape == TriggerShape::dwell;
    if (dwell && transport != "none")
        trigger.refuse("transport", "\"" + transport +
                                        "\" does not go with shape \"dwell\", which watches the "
                                        "axis and has no wire: remove transport");
    if (!dwell && transport == "none")
        trigger.refuse("transport",
                       "\"none\" goes with shape \"dwell\" only: say \"tcp\" or \"rtu\"");
    if (transport == "tcp-mirrored" && shape != TriggerShape::sequence_block && !dwell)
        trigger.refuse("transport", "\"tcp-mirrored\" (the CNC is the server) exists for shape "
                                    "\"sequence-block\" only");
}

TriggerWords read_words(Settings& trigger, TriggerConfig& config) {
    TriggerWords words;
    config.shape = read_shape(trigger);
    if (!trigger.refused("shape")) words.shape = config.shape;
    // a shape that is not known is "dwell" at heart where a key stands that dwell alone needs
    const bool may_miss = words.shape ? words.shape == TriggerShape::dwell : trigger.has("window");
    const std::string transport =
        trigger.choice("transport", {"tcp", "tcp-mirrored", "rtu", "none"},
                       may_miss ? std::optional<std::string>{"none"} : std::nullopt);
    if (trigger.refused("transport")) return words;
    if (words.shape) refuse_contradiction(trigger, *words.shape, transport);
    if (trigger.refused("transport")) return {};
    config.transport = transport_of(transport);
    if (words.shape || transport != "none") words.transport = config.transport;
    return words;
}

/// Keys that say nothing here mislead the next reader of the file.
void refuse_unused(Settings& trigger, bool used, Keys keys, const std::string& owner) {
    for (const char* key : keys)
        if (trigger.has(key) && !used)
            trigger.refuse(key, "belongs to " + owner + " and has no effect here: remove it");
}

/// Of a CNC that is the server its own, which nobody can guess.
void read_port(Settings& trigger, TriggerConfig& config) {
    const bool ours = config.transport != TriggerTransport::tcp_client;
    config.port = static_cast<int>(trigger.integer(
        "port", 1, 65535, ours ? std::optional<std::int64_t>{config.port} : std::nullopt));
}

void read_clients(Settings& trigger, TriggerConfig& config) {
    config.client_limit =
        static_cast<int>(trigger.integer("client_limit", 1, 100, config.client_limit));
    config.allowed_clients = read_allowed_clients(trigger);
}

void read_polling(Settings& trigger, TriggerConfig& config) {
    config.base_address = static_cast<int>(trigger.integer("base_address", 0, 65536 - 33, 0));
    config.poll_interval = trigger.duration("poll_interval", 20ms, 1s, config.poll_interval);
}

void read_tcp(Settings& trigger, TriggerConfig& config) {
    const bool server = config.transport == TriggerTransport::tcp_server;
    const bool client = config.transport == TriggerTransport::tcp_client;
    refuse_unused(trigger, server || client, {"host", "port"}, "the transports over TCP");
    refuse_unused(trigger, server, {"client_limit", "allowed_clients"}, "transport \"tcp\"");
    refuse_unused(trigger, client, {"base_address", "poll_interval"}, "transport \"tcp-mirrored\"");
    if (server) {
        read_clients(trigger, config);
        // Whoever names clients wants them to be heard.
        const std::string usual = config.allowed_clients.empty() ? config.host : "0.0.0.0";
        config.host = read_address(trigger, "host", usual);
        refuse_open_door(trigger, config.host, config.allowed_clients); // Modbus has no password
    }
    if (client) {
        config.host = trigger.text("host");
        read_polling(trigger, config);
    }
    if (server || client) read_port(trigger, config);
}

std::string read_serial_port(Settings& trigger) {
    const std::string path = trigger.text("serial_port");
    if (is_windows_port(path)) trigger.refuse("serial_port", no_serial_port(path, ""));
    return trigger.refused("serial_port") ? path : read_absolute_path(trigger, "serial_port");
}

void read_line_form(Settings& trigger, TriggerConfig& config) {
    config.baud = static_cast<int>(trigger.integer("baud", 1200, 1'000'000, config.baud));
    const std::string parity = trigger.choice("parity", {"none", "even", "odd"}, "none");
    config.parity = parity == "even" ? 'E' : parity == "odd" ? 'O' : 'N';
    config.stop_bits = static_cast<int>(trigger.integer("stop_bits", 1, 2, config.stop_bits));
}

void read_serial(Settings& trigger, TriggerConfig& config) {
    const bool rtu = config.transport == TriggerTransport::rtu_server;
    refuse_unused(trigger, rtu, {"serial_port", "baud", "parity", "stop_bits"},
                  "transport \"rtu\"");
    if (!rtu) return;
    config.serial_path = read_serial_port(trigger);
    read_line_form(trigger, config);
}

/// What a key of the wire says is right or wrong whether or not it belongs here.
void judge_wire_keys(Settings& trigger) {
    TriggerConfig unused;
    if (trigger.has("host")) unused.host = trigger.text("host");
    if (trigger.has("port")) read_port(trigger, unused);
    if (trigger.has("serial_port")) unused.serial_path = read_serial_port(trigger);
    read_clients(trigger, unused);
    read_polling(trigger, unused);
    read_line_form(trigger, unused);
}

void read_unit_id(Settings& trigger, TriggerConfig& config) {
    config.unit_id = static_cast<int>(trigger.integer("unit_id", 1, 247, 1));
}

void read_block_flags(Settings& trigger, TriggerConfig& config) {
    config.low_word_first = trigger.flag("low_word_first", config.low_word_first);
    config.watch_heartbeat = trigger.flag("watch_heartbeat", config.watch_heartbeat);
}

void read_index_grace(Settings& trigger, TriggerConfig& config) {
    config.index_grace = trigger.duration("index_grace", 1ms, 5s, config.index_grace);
}

void read_shape_keys(Settings& trigger, TriggerConfig& config) {
    const bool block = config.shape == TriggerShape::sequence_block;
    const bool coil = config.shape == TriggerShape::coil_and_index;
    const bool wired = config.shape != TriggerShape::dwell;
    refuse_unused(trigger, wired, {"unit_id"}, "the Modbus shapes");
    refuse_unused(trigger, block, {"low_word_first", "watch_heartbeat"},
                  "shape \"sequence-block\"");
    refuse_unused(trigger, coil, {"index_grace"}, "shape \"coil-and-index\"");
    if (wired) read_unit_id(trigger, config);
    if (block) read_block_flags(trigger, config);
    if (coil) read_index_grace(trigger, config);
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
        "together with window it is " + units.write_coordinate(reach) +
            ", but the axis reverses after cycle.overrun = " +
            units.write_coordinate(cycle.overrun) +
            ": the station could not detect that the axis leaves the target. Make cycle.overrun "
            "larger than this sum, or make window and hysteresis smaller");
}

/// `all`: a length that is missing is refused; else it need not stand.
void read_halt(Settings& trigger, AxisUnits units, bool all, TriggerConfig& config) {
    const auto read = [&](const char* key, Length low, Length high, Length& into) {
        if (all || trigger.has(key)) into = units.coordinate(trigger, key, low, high);
    };
    read("window", um(1), mm(50), config.window);
    read("stability_range", nm(1), mm(1), config.stability_range);
    config.stability_period =
        trigger.duration("stability_period", 10ms, 60s, config.stability_period);
    read("hysteresis", um(1), mm(50), config.hysteresis);
    config.minimum_halt = trigger.duration("minimum_halt", 10ms, 10min, config.minimum_halt);
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
    read_halt(trigger, units, true, config);
    if (!trigger.refused("window") && !trigger.refused("hysteresis"))
        refuse_unseen_overrun(trigger, units, cycle, config);
}

/// A CNC that gives up first never hears why, and leaves before its point is durable.
void read_cnc_timeout(Settings& trigger, Duration capture_timeout, TriggerConfig& config) {
    config.cnc_timeout =
        trigger.duration("cnc_timeout", 1s, 1h, usual_cnc_timeout(capture_timeout));
    const Duration least = least_cnc_timeout(capture_timeout);
    if (trigger.refused("cnc_timeout") || config.cnc_timeout >= least) return;
    trigger.refuse("cnc_timeout",
                   "is shorter than the time that the station itself may need: with this "
                   "capture.timeout it must be at least " +
                       std::to_string(std::chrono::ceil<std::chrono::seconds>(least).count()) +
                       " s, so that the CNC's program receives the reason for a refused point");
}

/// As judge_wire_keys(), of the keys that belong to one shape or another.
void judge_shape_keys(Settings& trigger, AxisUnits units) {
    TriggerConfig unused;
    read_unit_id(trigger, unused);
    read_block_flags(trigger, unused);
    read_index_grace(trigger, unused);
    read_halt(trigger, units, false, unused);
}

} // namespace

void read_trigger(Settings trigger,
                  AxisUnits units,
                  const CycleConfig& cycle,
                  Duration capture_timeout,
                  TriggerConfig& config) {
    read_cnc_timeout(trigger, capture_timeout, config);
    const TriggerWords words = read_words(trigger, config);
    if (words.transport) {
        read_tcp(trigger, config);
        read_serial(trigger, config);
    } else {
        judge_wire_keys(trigger);
    }
    if (words.shape) {
        read_shape_keys(trigger, config);
        read_dwell(trigger, units, cycle, config);
    } else {
        judge_shape_keys(trigger, units);
    }
}

} // namespace axiscal
