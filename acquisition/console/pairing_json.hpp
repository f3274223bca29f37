#pragma once
// Pairing as the JSON of docs/api.md. Pure.

#include "acquisition/console/pairing.hpp"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <vector>

namespace axiscal {

/// {"name": "tablet 2"}; without it empty. @errors Fault::bad_request naming the field.
Result<std::string> pair_request_from_json(const std::string& body);
/// {"code": "12345678"}, also as it is shown, "1234 5678": the eight digits.
/// @errors Fault::bad_request naming the field; such a code counts as no try.
Result<std::string> session_request_from_json(const std::string& body);

struct EndOrder {
    std::optional<std::string> name; ///< absent: all
};
/// {"name": "tablet 2"} or {"all": true}. @errors Fault::bad_request naming the field.
Result<EndOrder> end_request_from_json(const std::string& body);

/// @param page  address of the station's pages; empty: no door is open for browsers
/// @param sentence  what keeps a browser from getting there; empty: nothing known
nlohmann::ordered_json
offer_json(const PairingCode& code, const std::string& page, const std::string& sentence);
nlohmann::ordered_json paired_json(const std::vector<PairedBrowser>& paired);
/// Null: not paired.
nlohmann::ordered_json session_json(const PairedBrowser* browser);

} // namespace axiscal
