#pragma once
// What stands where in a process data object, as the device itself tells it. Pure.

#include "drivers/canopen/sdo.hpp"

#include <optional>

namespace axiscal {

struct PdoEntry {
    ObjectKey object;
    int bits = 0; ///< 1 .. 64
};

/// One transmit PDO.
struct PdoLayout {
    int number = 1;       ///< TPDO1 ..
    std::uint32_t id = 0; ///< of its frames
    std::vector<PdoEntry> entries;

    [[nodiscard]] int bits_of(ObjectKey object) const; ///< 0: not in this one
    /// The bits of this object, the low one first; empty where it is not mapped, or the frame is
    /// too short for it.
    [[nodiscard]] std::optional<std::uint64_t> field(const CanFrame& frame, ObjectKey object) const;
};

/// One word of 0x1A00 and following: index, sub-index, bits.
/// @errors Fault::bad_frame for a width that is none.
Result<PdoEntry> decode_pdo_entry(std::uint32_t word);

/// @param mapping  the words of 0x1A00 + number - 1, from sub-index 1 on.
/// @errors Fault::bad_frame for more than 64 bits in all.
Result<PdoLayout>
pdo_layout(int number, std::uint32_t id, const std::vector<std::uint32_t>& mapping);

/// Two's complement of `bits` (1 .. 64).
std::int64_t sign_extended(std::uint64_t raw, int bits);

} // namespace axiscal
