#include "drivers/wire/link_settings.hpp"

#include "config/serial_port_name.hpp"

#include <charconv>

namespace axiscal {
namespace {

constexpr std::string_view serial_prefix = "serial:", tcp_prefix = "tcp:", usb_prefix = "usb:",
                           usb_port_prefix = "usb-port:", can_prefix = "can:";

constexpr std::string_view name_of_parity(char parity) {
    return parity == 'E' ? "even" : parity == 'O' ? "odd" : "none";
}

std::string_view without_brackets(std::string_view host) {
    const bool bracketed = host.size() > 2 && host.front() == '[' && host.back() == ']';
    return bracketed ? host.substr(1, host.size() - 2) : host;
}

Result<LinkSettings> parse_tcp(std::string_view place, LinkSettings settings) {
    const auto colon = place.rfind(':');
    const auto host = without_brackets(place.substr(0, colon));
    if (colon == std::string_view::npos || host.empty())
        return fail(Fault::bad_configuration, "write \"tcp:host:port\"");
    const auto port = place.substr(colon + 1);
    int number = 0;
    const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), number);
    if (error != std::errc{} || end != port.data() + port.size() || number < 1 || number > 65535)
        return fail(Fault::bad_configuration, "the port is a number from 1 to 65535");
    settings.kind = LinkSettings::Kind::tcp;
    settings.host = host;
    settings.port = number;
    return settings;
}

Result<void> check_serial_path(std::string_view path) {
    if (path.starts_with('/')) return {};
    return fail(Fault::bad_configuration, no_serial_port(path, serial_prefix));
}

} // namespace

std::string LinkSettings::describe() const {
    if (kind == Kind::tcp) return "tcp " + host + ":" + std::to_string(port);
    if (kind == Kind::usb || kind == Kind::hid) return usb.describe();
    if (kind == Kind::can) return "CAN " + path;
    if (kind == Kind::counter) return "counter " + path;
    if (kind == Kind::files) return "files below " + path;
    return "serial " + path + " " + std::to_string(baud) + " " + std::to_string(data_bits) +
           parity + std::to_string(stop_bits);
}

Result<LinkSettings> parse_link(std::string_view text, LinkSettings defaults) {
    if (text.starts_with(tcp_prefix))
        return parse_tcp(text.substr(tcp_prefix.size()), std::move(defaults));
    const bool serial = text.starts_with(serial_prefix);
    if (!serial || text.size() == serial_prefix.size())
        return fail(Fault::bad_configuration,
                    "write \"serial:/dev/serial/by-id/...\" or \"tcp:host:port\"");
    AXISCAL_CHECK(check_serial_path(text.substr(serial_prefix.size())));
    defaults.kind = LinkSettings::Kind::serial;
    defaults.path = text.substr(serial_prefix.size());
    return defaults;
}

LinkSettings read_link(Settings& options, const LinkSettings& defaults) {
    const bool stated = options.has("link");
    const auto parsed = parse_link(options.text("link"), defaults);
    if (!parsed && stated && !options.refused("link"))
        options.refuse("link", parsed.error().detail);
    if (parsed && parsed->kind == LinkSettings::Kind::tcp) return *parsed;
    LinkSettings settings = parsed ? *parsed : defaults; // the keys of a line are right beside it
    settings.baud = static_cast<int>(options.integer("baud", 1200, 3'000'000, defaults.baud));
    const auto parity = options.choice("parity", {"none", "even", "odd"},
                                       std::string{name_of_parity(defaults.parity)});
    settings.parity = parity == "even" ? 'E' : parity == "odd" ? 'O' : 'N';
    settings.data_bits = static_cast<int>(options.integer("data_bits", 5, 8, defaults.data_bits));
    settings.stop_bits = static_cast<int>(options.integer("stop_bits", 1, 2, defaults.stop_bits));
    return settings;
}

LinkSettings read_usb_link(Settings& options, const LinkSettings& defaults) {
    LinkSettings settings = defaults;
    const bool stated = options.has("link");
    const std::string text = options.text("link");
    const auto after = [&](std::string_view prefix) {
        return text.starts_with(prefix) ? text.substr(prefix.size()) : std::string{};
    };
    const std::string serial = after(usb_prefix);
    settings.usb.port = after(usb_port_prefix);
    if (serial.empty() && settings.usb.port.empty() && stated)
        options.refuse("link", "write \"usb:any\" for the only one that is plugged in, "
                               "\"usb:SERIAL\" with its serial number, or \"usb-port:1-2.4\" with "
                               "its socket as the kernel names it");
    settings.usb.serial = serial == "any" ? std::string{} : serial;
    return settings;
}

LinkSettings read_can_link(Settings& options) {
    LinkSettings settings;
    settings.kind = LinkSettings::Kind::can;
    const bool stated = options.has("link");
    const std::string text = options.text("link");
    settings.path = text.starts_with(can_prefix) ? text.substr(can_prefix.size()) : std::string{};
    constexpr std::size_t longest_name = 15; // IFNAMSIZ of the kernel, without its end
    const bool is_name = !settings.path.empty() && settings.path.size() <= longest_name &&
                         settings.path.find_first_of(" /\t\n") == std::string::npos;
    if (stated && !is_name)
        options.refuse("link", "write \"can:can0\", with the interface as `ip link` names it");
    return settings;
}

} // namespace axiscal
