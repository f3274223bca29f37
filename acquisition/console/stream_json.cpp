#include "acquisition/console/stream_json.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

constexpr double mm_per_m = 1e3;
constexpr std::size_t usual_points = 1000, most_points = 4096;

} // namespace

nlohmann::ordered_json to_json(const std::optional<StreamView>& view) {
    if (!view) return nullptr;
    Json low = Json::array(), high = Json::array();
    for (const MinMax& stretch : view->stretches) {
        low.push_back(stretch.low * mm_per_m);
        high.push_back(stretch.high * mm_per_m);
    }
    return {{"run", view->run_id},
            {"recording", view->recording},
            {"channel", view->channel},
            {"rate_hz", view->rate_hz > 0 ? Json(view->rate_hz) : Json(nullptr)},
            {"samples", view->samples},
            {"samples_a_stretch", view->samples_a_stretch},
            {"gaps", view->gaps},
            {"missing", view->missing},
            {"unit", "mm"},
            {"low", std::move(low)},
            {"high", std::move(high)}};
}

Result<std::size_t> stream_points_of(std::string_view target) {
    const std::string_view query = target.substr(std::min(target.size(), stream_path.size()));
    if (query.empty()) return usual_points;
    constexpr std::string_view key = "?points=";
    if (!query.starts_with(key))
        return refuse(Fault::bad_request, "query", "is unknown; known is ?points=1000");
    const std::string_view digits = query.substr(key.size());
    std::size_t points = 0;
    const char* end = digits.data() + digits.size();
    const auto [rest, error] = std::from_chars(digits.data(), end, points);
    if (error != std::errc{} || rest != end || points < 1 || points > most_points)
        return refuse(Fault::bad_request, "points", "is a whole number from 1 to 4096");
    return points;
}

} // namespace axiscal
