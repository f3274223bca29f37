// Source: CiA 301 V4.2, 7.5.2.38: PDO mapping parameter record.
#include "drivers/canopen/pdo_layout.hpp"

#include <algorithm>

namespace axiscal {
namespace {

constexpr int most_bits = 64;

std::uint64_t mask_of(int bits) {
    return bits >= most_bits ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
}

} // namespace

Result<PdoEntry> decode_pdo_entry(std::uint32_t word) {
    PdoEntry entry;
    entry.object = {static_cast<std::uint16_t>(word >> 16U),
                    static_cast<std::uint8_t>(word >> 8U & 0xFFU)};
    entry.bits = static_cast<int>(word & 0xFFU);
    if (entry.bits < 1 || entry.bits > most_bits)
        return fail(Fault::bad_frame, "the mapping gives " + name_of(entry.object) + " " +
                                          std::to_string(entry.bits) + " bits");
    return entry;
}

Result<PdoLayout>
pdo_layout(int number, std::uint32_t id, const std::vector<std::uint32_t>& mapping) {
    PdoLayout layout{number, id, {}};
    int bits = 0;
    for (const std::uint32_t word : mapping) {
        AXISCAL_TRY(const PdoEntry entry, decode_pdo_entry(word));
        bits += entry.bits;
        layout.entries.push_back(entry);
    }
    if (bits > most_bits)
        return fail(Fault::bad_frame,
                    "the mapping of TPDO" + std::to_string(number) + " is longer than a frame");
    return layout;
}

int PdoLayout::bits_of(ObjectKey object) const {
    const auto found = std::ranges::find(entries, object, &PdoEntry::object);
    return found == entries.end() ? 0 : found->bits;
}

std::optional<std::uint64_t> PdoLayout::field(const CanFrame& frame, ObjectKey object) const {
    std::uint64_t all = 0;
    const auto bytes = frame.bytes();
    for (std::size_t at = 0; at < bytes.size(); ++at)
        all |= std::to_integer<std::uint64_t>(bytes[at]) << (8 * at);
    int begin = 0;
    for (const PdoEntry& entry : entries) {
        if (entry.object == object) {
            if (begin + entry.bits > 8 * static_cast<int>(bytes.size())) return std::nullopt;
            return all >> begin & mask_of(entry.bits);
        }
        begin += entry.bits;
    }
    return std::nullopt;
}

std::int64_t sign_extended(std::uint64_t raw, int bits) {
    const bool negative = (raw >> (bits - 1) & 1U) != 0;
    return static_cast<std::int64_t>(negative ? raw | ~mask_of(bits) : raw & mask_of(bits));
}

} // namespace axiscal
