#pragma once
// Prometheus' text exposition format, version 0.0.4: families of samples, each with its HELP and
// its TYPE. Only writes: nothing of others is read here.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

/// What GET /metrics bears.
inline constexpr std::string_view metrics_content_type = "text/plain; version=0.0.4; charset=utf-8";

enum class MetricType : std::uint8_t { counter, gauge };

struct MetricLabel {
    std::string_view name; ///< [a-z_]+
    std::string value;     ///< any bytes
};
using MetricLabels = std::vector<MetricLabel>;

class MetricsWriter {
public:
    /// Begins a family; what follows belongs to it. Each name once. HELP and TYPE stand before its
    /// first sample, and a family without a sample leaves nothing.
    /// @param name, help  last until the next family: literals
    void family(std::string_view name, MetricType type, std::string_view help);
    /// A value that is empty or not finite has no line: it is never a number.
    void sample(const MetricLabels& labels, std::optional<double> value);
    void sample(std::optional<double> value) { sample({}, value); }
    /// One sample for each of `known`, 1 for the one that is `current`, else 0. A `current` that is
    /// not known makes all of them 0.
    void states(const MetricLabels& labels,
                std::string_view label,
                std::span<const std::string_view> known,
                std::string_view current);

    [[nodiscard]] const std::string& text() const { return text_; }

private:
    void begin();

    std::string text_;
    std::string_view name_, help_;
    MetricType type_ = MetricType::gauge;
    bool begun_ = false;
};

} // namespace axiscal
