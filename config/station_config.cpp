#include "analysis/record/run_attachments.hpp"
#include "config/share_address.hpp"
#include "config/station_readers.hpp"

#include <algorithm>
#include <arpa/inet.h>
#include <cstddef>
#include <utility>
#include <variant>

namespace axiscal {
namespace {

constexpr std::size_t longest_socket_path = 107; ///< bytes, sun_path without its end

/// What stands in the files is judged where TLS is spoken (acquisition/tls): most readers of a
/// station file may not read the key, and need not.
void read_certificate_and_key(Settings& console, ConsoleConfig& config) {
    const bool has_certificate = console.has("certificate"), has_key = console.has("key");
    if (has_certificate) config.certificate = read_absolute_path(console, "certificate");
    if (has_key) config.key = read_absolute_path(console, "key");
    if (has_certificate && !has_key)
        console.refuse("certificate", "needs its key, too: name the file as `key`");
    if (has_key && !has_certificate)
        console.refuse("key",
                       "is of no use without its certificate: name the file as `certificate`");
    config.certificate_line = console.line_of("certificate");
    config.key_line = console.line_of("key");
}

ConsoleConfig read_console(Settings console) {
    const ConsoleConfig usual;
    ConsoleConfig config;
    config.socket_path = read_absolute_path(console, "socket", usual.socket_path);
    if (config.socket_path.size() > longest_socket_path)
        console.refuse("socket", "is longer than the 107 bytes that a Unix socket can have");
    config.group = console.text("group", usual.group);
    config.host = read_address(console, "host", usual.host);
    config.port = static_cast<int>(console.integer("port", 0, 65535, usual.port));
    config.allowed_hosts = console.texts("allowed_hosts", usual.allowed_hosts);
    config.allowed_clients = read_allowed_clients(console);
    if (config.port != 0) refuse_open_door(console, config.host, config.allowed_clients);
    read_certificate_and_key(console, config);
    return config;
}

PublishConfig read_publish(Settings publish) {
    using namespace std::chrono_literals;
    PublishConfig config;
    config.destination = publish.text("destination", "");
    const bool on_server = is_share_address(config.destination);
    if (on_server) {
        if (const auto address = parse_share_address(config.destination); !address)
            publish.refuse("destination", address.error().detail);
    } else if (!config.destination.empty()) {
        config.destination = read_absolute_path(publish, "destination");
    }
    config.group = publish.text("group", "");
    if (on_server && !config.group.empty())
        publish.refuse("group", "belongs to a folder of this PC: who may read a share, its server "
                                "decides");
    if (publish.has("credentials")) config.credentials = read_absolute_path(publish, "credentials");
    config.require_encryption =
        publish.choice("encryption", {"required", "asked"}, "required") == "required";
    config.timeout = publish.duration("timeout", 1s, 60s, config.timeout);
    config.retry = publish.duration("retry", 100ms, 1h, config.retry);
    config.alarm_age = publish.duration("alarm_age", 1s, 24h, config.alarm_age);
    config.alarm_count =
        static_cast<int>(publish.integer("alarm_count", 1, 100000, config.alarm_count));
    return config;
}

void read_place(Settings station, StationConfig& config) {
    config.station = station.text("name", config.station);
    config.state_directory = read_absolute_path(station, "state_directory", config.state_directory);
}

} // namespace

Length AxisUnits::coordinate(Settings& table,
                             std::string_view key,
                             Length low,
                             Length high,
                             std::optional<Length> fallback) const {
    return rotary_ ? table.rotary_length(key, low, high, fallback)
                   : table.length(key, low, high, fallback);
}

std::optional<Length> AxisUnits::optional_coordinate(Settings& table,
                                                     std::string_view key,
                                                     Length low,
                                                     Length high) const {
    if (!table.has(key)) return std::nullopt;
    return coordinate(table, key, low, high);
}

std::vector<Length>
AxisUnits::coordinates(Settings& table, std::string_view key, Length low, Length high) const {
    return rotary_ ? table.rotary_lengths(key, low, high) : table.lengths(key, low, high);
}

Speed AxisUnits::speed(Settings& table,
                       std::string_view key,
                       Speed low,
                       Speed high,
                       std::optional<Speed> fallback) const {
    return rotary_ ? table.rotary_speed(key, low, high, fallback)
                   : table.speed(key, low, high, fallback);
}

std::string AxisUnits::write_speed(Speed speed) const {
    return write_number(speed.in(mm_per_minute)) + (rotary_ ? " deg/min" : " mm/min");
}

std::string AxisUnits::write_coordinate(Length coordinate) const {
    return write_number(coordinate.in(mm)) + (rotary_ ? " deg" : " mm");
}

std::string
read_address(Settings& table, std::string_view key, const std::optional<std::string>& fallback) {
    std::string host = table.text(key, fallback);
    in6_addr buffer{};
    const bool known = inet_pton(AF_INET, host.c_str(), &buffer) == 1 ||
                       inet_pton(AF_INET6, host.c_str(), &buffer) == 1;
    if (!known && !table.refused(key))
        table.refuse(key, "\"" + host +
                              "\" is no address: write \"127.0.0.1\" for this PC only, or the "
                              "address of one of its network cards");
    return host;
}

std::vector<AddressRange> read_allowed_clients(Settings& door) {
    std::vector<AddressRange> allowed;
    for (const std::string& client : door.texts("allowed_clients", std::vector<std::string>{})) {
        if (auto range = parse_address_range(client))
            allowed.push_back(*range);
        else
            door.refuse("allowed_clients", range.error().detail);
    }
    return allowed;
}

void refuse_open_door(Settings& door,
                      const std::string& host,
                      const std::vector<AddressRange>& allowed) {
    const bool judged = door.refused("host") || door.refused("allowed_clients");
    if (judged || is_loopback(host) || !allowed.empty()) return;
    door.refuse("host",
                "\"" + host +
                    "\" accepts connections from other computers: list those that may connect, "
                    "as in allowed_clients = [\"192.168.10.20\"]");
}

std::string read_absolute_path(Settings& table,
                               std::string_view key,
                               const std::optional<std::string>& fallback) {
    std::string path = table.text(key, fallback);
    if (!path.starts_with('/') && !table.refused(key))
        table.refuse(key, "\"" + path + "\" is no whole path: begin it with /");
    return path;
}

namespace {

AxisKind read_axis_kind(Settings axis) {
    const bool rotary = axis.choice("kind", {"linear", "rotary"}, "linear") == "rotary";
    return rotary ? AxisKind::rotary : AxisKind::linear;
}

/// Before a polygon no drift test is made, so that arming would wait for one for ever.
void refuse_drift_test_of_polygon(Settings uncertainty, const StationConfig& config) {
    const bool polygon =
        config.axis.angle && config.axis.angle->setup.method == AngleMethod::polygon;
    if (polygon && !config.eve_run.empty() && !uncertainty.refused("eve_run"))
        uncertainty.refuse("eve_run", "names a drift test, and before a polygon there is none: "
                                      "state eve = \"0.6 arcsec\" instead, the range of what the "
                                      "autocollimator shows of the standing axis");
}

/// Asked for also where the file has none, so that a misspelt one is told its right name.
template <class Setup> void keep_section_of(TestKind kind, Settings& root, StationConfig& config) {
    if constexpr (requires { Setup::section; }) {
        if (root.has(Setup::section))
            config.kind_sections.push_back(KindSection{kind, root.table(Setup::section), {}});
    }
}

template <std::size_t... kinds>
void keep_kind_sections(Settings root, StationConfig& config, std::index_sequence<kinds...>) {
    (keep_section_of<std::variant_alternative_t<kinds, TestSetup>>(all_test_kinds[kinds], root,
                                                                   config),
     ...);
}

} // namespace

StationConfig read_station(SettingsDocument& document) {
    Settings root = document.root();
    StationConfig config;
    config.file = document.name();
    config.text = document.source_text();
    read_place(root.table("station"), config);
    read_instruments(root, config);
    const bool circles_alone = !root.has("axis") && root.table("circular").has("radius");
    if (circles_alone)
        read_machine_of_circles(root.table("circular"), config);
    else
        config.cycle.axis_kind = read_axis_kind(root.table("axis"));
    const AxisUnits units{config.cycle.axis_kind};
    if (!circles_alone) read_axis(root.table("axis"), units, config);
    read_ballbar(root, config);
    read_circular(root, config);
    if (!circles_alone) {
        read_cycle(root.table("cycle"), units, config.cycle);
        read_capture(root.table("capture"), units, config.cycle, config.capture);
    }
    keep_kind_sections(root, config, std::make_index_sequence<all_test_kinds.size()>{});
    config.preflight = read_preflight(root.table("preflight"));
    config.environment = read_environment(root.table("environment"));
    read_trigger(root.table("trigger"), units, config.cycle, config.capture.timeout,
                 config.trigger);
    if (config.cycle.axis_kind == AxisKind::rotary && config.trigger.shape == TriggerShape::dwell)
        root.table("trigger").refuse("shape", "\"dwell\" cannot detect that the indexing table or "
                                              "the polygon is in position: a rotary axis needs a "
                                              "control that sends requests; choose another shape");
    config.console = read_console(root.table("console"));
    config.publish = read_publish(root.table("publish"));
    read_webhook(root, config);
    config.uncertainty = read_uncertainty(root, config.cycle.axis_kind, config.eve_run);
    refuse_drift_test_of_polygon(root.table("uncertainty"), config);
    read_tolerances(root, config);
    config.standards =
        root.table("certificate").texts("standards", std::optional{std::vector<std::string>{}});
    config.statements = read_statements(root.table("certificate"), units, config);
    if (config.axis.angle)
        config.axis.angle->setup.run_out = root.table("certificate").text("run_out", "");
    std::stable_sort(config.warnings.begin(), config.warnings.end(),
                     [](const Refusal& a, const Refusal& b) { return a.line < b.line; });
    return config;
}

} // namespace axiscal
