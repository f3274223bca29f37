#pragma once
// What a tape holds, for somebody who was sent it, and what of it is private. Pure.

#include "drivers/recording/tape_link.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace axiscal {

/// Something that names a person, a computer or a network.
struct PrivateTrace {
    std::string where; ///< "header who", "from the instrument", "to the instrument"
    std::string what; ///< "e-mail address", "IP address", "hardware address", "home folder", "name"
    std::string text;
};
/// In the header's values and in the readable text of both directions.
std::vector<PrivateTrace> private_traces(const Tape& tape);

/// {"origin", "driver", "wire", "seconds", "openings", "from_instrument": {"transfers", "bytes",
/// "readable", "lines", "first_line"}, "to_instrument": the same, "missing": header keys that a
/// test needs, "private": [{"where", "what", "text"}]}. `readable`: share of printable ASCII, 0
/// to 1.
nlohmann::ordered_json look_into(const Tape& tape);
/// The same for people.
std::string text_of_look(const nlohmann::ordered_json& look);

} // namespace axiscal
