#pragma once
// What a receipt of the publisher (share.hpp) says of a run: the anchor to which its file is held.
// Reads only.

#include "acquisition/runfile/run_signature.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace axiscal {

/// Member "closing" of a receipt; null where there is no run file.
nlohmann::ordered_json closing_json(const std::optional<ClosingMark>& mark);

/// @param file_sha256 of the run file: by it a receipt without "closing" is judged, as an older
/// version wrote them
/// @errors Fault::not_found; Fault::bad_case for what is no receipt.
Result<AnchorReport> compare_with_receipt(const std::string& run_file,
                                          const std::string& file_sha256,
                                          const std::string& receipt);

} // namespace axiscal
