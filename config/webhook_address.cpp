#include "config/webhook_address.hpp"

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <charconv>
#include <cstdint>
#include <optional>

namespace axiscal {
namespace {

constexpr std::size_t longest_url = 2000; // bytes; receivers take no longer ones
constexpr int last_port = 65'535;

bool is_plain_sign(char sign) {
    return sign > ' ' && sign < '\x7f' &&
           std::string_view{"\"\\<>^`{|}#"}.find(sign) == std::string_view::npos;
}

bool is_host_sign(char sign) {
    return (sign >= 'a' && sign <= 'z') || (sign >= 'A' && sign <= 'Z') ||
           (sign >= '0' && sign <= '9') || sign == '.' || sign == '-';
}

std::optional<int> port_of(std::string_view digits) {
    int port = 0;
    const auto [end, wrong] = std::from_chars(digits.data(), digits.data() + digits.size(), port);
    const bool whole = wrong == std::errc{} && end == digits.data() + digits.size();
    if (!whole || port < 1 || port > last_port) return std::nullopt;
    return port;
}

bool is_host(const std::string& host, bool in_brackets) {
    in6_addr unused{};
    if (in_brackets) return ::inet_pton(AF_INET6, host.c_str(), &unused) == 1;
    return !host.empty() && host.size() <= 253 && host.front() != '-' &&
           std::ranges::all_of(host, is_host_sign);
}

/// "host", "host:8443", "[fd00::2]:8443" into the parts of `address`.
Result<void> take_authority(std::string_view authority, WebhookAddress& address) {
    const bool in_brackets = authority.starts_with('[');
    const std::size_t closed = in_brackets ? authority.find(']') : 0;
    if (closed == std::string_view::npos)
        return fail(Fault::bad_request, "an IPv6 address stands between [ and ]");
    const std::size_t colon = authority.find(':', closed);
    const std::string_view host = authority.substr(0, colon);
    address.host = in_brackets ? host.substr(1, closed - 1) : host;
    if (!is_host(address.host, in_brackets) || (in_brackets && host.size() != closed + 1))
        return fail(Fault::bad_request, "names no server: write https://server/path");
    address.place = (address.encrypted ? "https://" : "http://") + std::string{host};
    if (colon == std::string_view::npos) return {};
    const auto port = port_of(authority.substr(colon + 1));
    if (!port) return fail(Fault::bad_request, "the port is a number from 1 to 65535");
    address.port = *port;
    address.place += ":" + std::to_string(*port);
    return {};
}

bool is_private_v4(const std::array<std::uint8_t, 4>& a) {
    return a[0] == 127 || a[0] == 10 || (a[0] == 172 && (a[1] & 0xF0) == 16) ||
           (a[0] == 192 && a[1] == 168) || (a[0] == 169 && a[1] == 254);
}

bool is_private_v6(const std::array<std::uint8_t, 16>& a) {
    std::array<std::uint8_t, 16> this_pc{};
    this_pc.back() = 1;
    return a == this_pc || (a[0] & 0xFE) == 0xFC || (a[0] == 0xFE && (a[1] & 0xC0) == 0x80);
}

} // namespace

bool is_private_host(const std::string& host) {
    std::array<std::uint8_t, 4> four{};
    if (::inet_pton(AF_INET, host.c_str(), four.data()) == 1) return is_private_v4(four);
    std::array<std::uint8_t, 16> six{};
    if (::inet_pton(AF_INET6, host.c_str(), six.data()) == 1) return is_private_v6(six);
    return host == "localhost";
}

Result<WebhookAddress> parse_webhook_address(std::string_view url) {
    WebhookAddress address;
    address.encrypted = url.starts_with("https://");
    if (!address.encrypted && !url.starts_with("http://"))
        return fail(Fault::bad_request, "is no address of the web: begin it with https://");
    if (url.size() > longest_url || !std::ranges::all_of(url, is_plain_sign))
        return fail(Fault::bad_request, "an address has up to 2000 signs of ASCII, no blank and no "
                                        "#: write others as %20");
    if (!address.encrypted) address.port = 80;
    const std::string_view rest = url.substr(address.encrypted ? 8 : 7);
    const std::string_view authority = rest.substr(0, rest.find_first_of("/?"));
    if (authority.find('@') != std::string_view::npos)
        return fail(Fault::bad_request,
                    "an account has no place in an address: who sends is proved "
                    "by the signature of secret_file");
    AXISCAL_CHECK(take_authority(authority, address));
    if (!address.encrypted && !is_private_host(address.host))
        return fail(Fault::bad_request, "goes out of this shop in clear text: write https://, or "
                                        "http:// to localhost or a private address in digits");
    return address;
}

} // namespace axiscal
