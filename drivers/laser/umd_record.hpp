#pragma once
// One line of a uMD counter, as printed: ASCII decimal integers. Pure.
// Field numbers: see laser_umd.cpp for the document they cite.

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace axiscal {

struct UmdAxisFields {
    std::int64_t measurement = 0;  ///< field 1, 8, 12: counts in this sample period
    std::int64_t displacement = 0; ///< field 2, 9, 13: accumulated counts
    std::int64_t phase = 0;        ///< field 4, 11, 15: to be subtracted, or an error mask
};

struct UmdRecord {
    std::int64_t reference = 0; ///< field 0
    std::array<UmdAxisFields, 3> axes{};
    int axis_count = 1;        ///< 1 in a record of 8 fields, 3 in one of 16
    std::int64_t sequence = 0; ///< field 5
    std::int64_t low_speed_code = 0, low_speed_data = 0; ///< fields 6, 7
};

/// Strict: 8 or 16 whole numbers, one space between, nothing else; otherwise empty.
/// The velocity fields are read over: some firmware prints other things there.
std::optional<UmdRecord> decode_umd_record(std::string_view line);

} // namespace axiscal
