#include "config/address_range.hpp"

#include <algorithm>
#include <arpa/inet.h>
#include <charconv>
#include <string_view>

namespace axiscal {
namespace {

constexpr int ipv4_offset_bits = 96, all_bits = 128;

struct Parsed {
    std::array<std::uint8_t, 16> bytes{};
    bool ipv4 = false;
};

std::optional<Parsed> parse_address(const std::string& text) {
    Parsed parsed;
    in_addr short_form{};
    if (inet_pton(AF_INET, text.c_str(), &short_form) == 1) {
        parsed.ipv4 = true;
        parsed.bytes[10] = parsed.bytes[11] = 0xff;
        const auto* first = reinterpret_cast<const std::uint8_t*>(&short_form);
        std::copy_n(first, 4, parsed.bytes.begin() + 12);
        return parsed;
    }
    if (inet_pton(AF_INET6, text.c_str(), parsed.bytes.data()) == 1) return parsed;
    return std::nullopt;
}

bool bit_of(const std::array<std::uint8_t, 16>& bytes, int place) {
    return (bytes[static_cast<std::size_t>(place / 8)] >> (7 - place % 8) & 1) != 0;
}

} // namespace

bool AddressRange::covers(const std::string& other) const {
    const auto parsed = parse_address(other);
    if (!parsed) return false;
    for (int place = 0; place < prefix_bits; ++place)
        if (bit_of(address, place) != bit_of(parsed->bytes, place)) return false;
    return true;
}

Result<AddressRange> parse_address_range(const std::string& text) {
    const auto slash = text.find('/');
    const auto parsed = parse_address(text.substr(0, slash));
    if (!parsed)
        return fail(Fault::bad_configuration,
                    "\"" + text +
                        "\" is no address: write \"192.168.10.20\" for one client, or "
                        "\"192.168.10.0/24\" for a network");
    AddressRange range{parsed->bytes, all_bits};
    if (slash == std::string::npos) return range;
    const int longest = parsed->ipv4 ? all_bits - ipv4_offset_bits : all_bits;
    int bits = -1;
    const std::string_view digits = std::string_view{text}.substr(slash + 1);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), bits);
    if (error != std::errc{} || end != digits.data() + digits.size() || bits < 0 || bits > longest)
        return fail(Fault::bad_configuration,
                    "\"" + text + "\": the part behind / is a number of bits from 0 to " +
                        std::to_string(longest));
    range.prefix_bits = all_bits - longest + bits;
    for (int place = range.prefix_bits; place < all_bits; ++place)
        if (bit_of(range.address, place))
            return fail(Fault::bad_configuration,
                        "\"" + text + "\" has bits behind its /" + std::to_string(bits) +
                            ": leave the / out for this one address, or set them to 0");
    return range;
}

bool any_covers(const std::vector<AddressRange>& ranges, const std::string& address) {
    return std::ranges::any_of(
        ranges, [&address](const AddressRange& range) { return range.covers(address); });
}

bool is_loopback(const std::string& address) {
    constexpr int first_byte = ipv4_offset_bits + 8;
    const auto parsed = parse_address(address);
    if (!parsed) return false;
    AddressRange home;
    home.address = parse_address("127.0.0.0")->bytes;
    home.prefix_bits = first_byte;
    return home.covers(address) || parsed->bytes == parse_address("::1")->bytes;
}

} // namespace axiscal
