#pragma once
// `axiscal align`: the beam's strength and reading along the travel, live, and what is kept of it.

#include "tools/axiscal/station_client.hpp"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>

namespace axiscal {

struct AlignOrder {
    /// "live": begin, show until a line comes from standard input, then keep (or drop on "q");
    /// "begin", "show", "keep", "drop": that alone, for scripts.
    std::string action = "live";
    std::optional<double> spot_offset_mm;
};
int command_align(const StationClient& client, const AlignOrder& order, bool json);

/// The body of GET /v1/alignment for people. Pure.
std::string alignment_text(const nlohmann::ordered_json& alignment);

} // namespace axiscal
