#pragma once
// A network address, or all that share its first bits: "192.168.10.20", "192.168.10.0/24",
// "fd00::/8". Pure.

#include "analysis/quantity/result.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace axiscal {

struct AddressRange {
    std::array<std::uint8_t, 16> address{}; ///< IPv6; IPv4 as ::ffff:a.b.c.d (RFC 4291, 2.5.5.2)
    int prefix_bits = 128;
    /// False for what is no address. IPv4 and its mapped form are the same.
    [[nodiscard]] bool covers(const std::string& other) const;
};

/// @errors Fault::bad_configuration naming what is wrong: no address, a prefix that is too long, or
/// bits set behind the prefix (a slip: "192.168.10.20/24").
Result<AddressRange> parse_address_range(const std::string& text);

/// Whether one of `ranges` covers `address`; of no ranges none does.
bool any_covers(const std::vector<AddressRange>& ranges, const std::string& address);

/// 127.0.0.0/8 and ::1.
bool is_loopback(const std::string& address);

} // namespace axiscal
