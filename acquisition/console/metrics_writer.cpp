#include "acquisition/console/metrics_writer.hpp"

#include "analysis/quantity/valid_text.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace axiscal {
namespace {

/// Backslash and quotation mark are escaped; a line feed is a space by then. One value that is no
/// UTF-8 would cost Prometheus every other one of the scrape.
void append_label_value(std::string& text, std::string_view value) {
    for (const char letter : valid_text(value)) {
        if (letter == '\\' || letter == '"') text += '\\';
        text += letter;
    }
}

/// The shortest text that reads back as this double; whole numbers without an exponent.
void append_number(std::string& text, double value) {
    constexpr double exact = 9007199254740992.0; // 2^53
    std::array<char, 32> room{};
    char* const end = room.data() + room.size();
    const bool whole = std::abs(value) <= exact && std::trunc(value) == value;
    const auto written = whole ? std::to_chars(room.data(), end, static_cast<std::int64_t>(value))
                               : std::to_chars(room.data(), end, value);
    text.append(room.data(), written.ptr);
}

} // namespace

void MetricsWriter::family(std::string_view name, MetricType type, std::string_view help) {
    name_ = name;
    help_ = help;
    type_ = type;
    begun_ = false;
}

void MetricsWriter::begin() {
    begun_ = true;
    text_.append("# HELP ").append(name_).append(" ").append(help_).append("\n# TYPE ");
    text_.append(name_).append(type_ == MetricType::counter ? " counter\n" : " gauge\n");
}

void MetricsWriter::sample(const MetricLabels& labels, std::optional<double> value) {
    if (!value || !std::isfinite(*value)) return;
    if (!begun_) begin();
    text_ += name_;
    char before = '{';
    for (const MetricLabel& label : labels) {
        text_ += before;
        text_.append(label.name).append("=\"");
        append_label_value(text_, label.value);
        text_ += '"';
        before = ',';
    }
    text_ += labels.empty() ? " " : "} ";
    append_number(text_, *value);
    text_ += '\n';
}

void MetricsWriter::states(const MetricLabels& labels,
                           std::string_view label,
                           std::span<const std::string_view> known,
                           std::string_view current) {
    MetricLabels whole = labels;
    whole.push_back({label, {}});
    for (const std::string_view state : known) {
        whole.back().value = state;
        sample(whole, state == current ? 1.0 : 0.0);
    }
}

} // namespace axiscal
