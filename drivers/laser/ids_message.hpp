#pragma once
// Requests and replies of the attocube IDS3010: JSON-RPC 2.0, one object a line. Pure. Sections:
// see laser_ids.cpp.

#include "analysis/quantity/result.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace axiscal {

/// "com.attocube.ids.displacement.getAxisDisplacement" with whole numbers as parameters. "api":2
/// stands in each request: without it the layout of the result is another. Ends with LF, which the
/// instrument does not need and does not mind. [request]
std::string
ids_request(std::string_view method, const std::vector<int>& parameters, std::int64_t id);

using IdsValue = std::variant<bool, std::int64_t, double, std::string>;

struct IdsReply {
    std::int64_t id = 0;
    std::int64_t error_number = 0; ///< result[0]; 0: all is well
    std::vector<IdsValue> values;  ///< what follows it
};

/// One line without its end. [reply]
/// @errors Fault::bad_frame for text that is no reply (no JSON, no id, a result that is no list, or
/// does not begin with a whole number); Fault::refused with the instrument's words for a reply with
/// an "error" member (an unknown method).
Result<IdsReply> parse_ids_reply(std::string_view line);

/// The value at `place` as a number; empty for text, and where there is none.
std::optional<double> number_of(const IdsReply& reply, std::size_t place);
std::optional<std::int64_t> whole_number_of(const IdsReply& reply, std::size_t place);
/// Numbers as text, too: a serial number may come as either.
std::string text_of(const IdsReply& reply, std::size_t place);

/// What the instrument says of its own correction. [air]
struct IdsCompensation {
    std::int64_t mode = 0; ///< 0 environment unit, 1 from typed values, 2 typed index
    double index = 1;      ///< the refractive index by which it divides now
    bool unit_connected = false;
};

/// Empty when the instrument leaves the air to this program: it divides by an index of 1 and will
/// not change it by itself. Otherwise the sentence for the technician.
std::string correction_of_its_own(const IdsCompensation& found);

} // namespace axiscal
