#pragma once
// One line of a Dracal VCP sensor. Pure. Sections: see environment_dracal_vcp.cpp.

#include "analysis/record/run_record.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

/// What stands before the '*', when the checksum after it is right.
/// @errors Fault::bad_frame without a checksum field, Fault::checksum when it does not match.
Result<std::string_view> verify_dracal_line(std::string_view line);

/// A value with its unit, as sent. The value is empty when it is no number (sensor not connected).
struct DracalPair {
    std::optional<double> value;
    std::string unit;
};

struct DracalLine {
    char kind = 0; ///< 'D' data, 'I' information
    std::string product, serial, message;
    std::vector<std::string> labels; ///< 'I' with the INFO table: name, unit, name, unit ...
    std::vector<DracalPair> pairs;   ///< 'D' only
};

/// @errors Fault::bad_frame when there are too few fields or the kind is unknown.
Result<DracalLine> parse_dracal_line(std::string_view verified);

struct StoredReading {
    ChannelKind kind;
    std::optional<double> value; ///< in stored_unit_of(kind); empty when absent or impossible
};
/// Empty for units that no channel here has.
std::optional<StoredReading> stored_reading(const DracalPair& pair);

} // namespace axiscal
