#pragma once
// The stream of a circular test, thinned for viewing, as the JSON of docs/api.md. Pure.

#include "acquisition/live/station_interface.hpp"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string_view>

namespace axiscal {

/// null before the first test.
nlohmann::ordered_json to_json(const std::optional<StreamView>& view);

/// Of "/v1/stream" or "/v1/stream?points=300": how many stretches at most, 1000 unless told.
/// @errors Fault::bad_request for another query, or a number that is not 1 to 4096.
Result<std::size_t> stream_points_of(std::string_view target);

inline constexpr std::string_view stream_path = "/v1/stream";

} // namespace axiscal
