#pragma once
// Stored runs as the JSON of docs/api.md. Pure.

#include "acquisition/console/run_history.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace axiscal {

nlohmann::ordered_json to_json(const StoredRun& run);
nlohmann::ordered_json runs_json(const RunsPage& page);
/// The row, its papers, and the certificate as it lies on the disk, byte for byte.
std::string run_with_papers_text(const RunWithPapers& found);

} // namespace axiscal
