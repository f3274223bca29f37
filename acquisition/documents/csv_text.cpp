#include "acquisition/documents/csv_text.hpp"

#include "analysis/quantity/valid_text.hpp"

#include <array>
#include <charconv>

namespace axiscal {

std::string csv_number(double value) {
    std::array<char, 32> text{};
    const auto written = std::to_chars(text.data(), text.data() + text.size(), value);
    return {text.data(), written.ptr};
}

std::string csv_number(const std::optional<double>& value) {
    return value ? csv_number(*value) : std::string{};
}

std::string csv_field(std::string_view words) {
    std::string text;
    bool quote = false;
    for (const char c : valid_text(words)) {
        if (c == '"') text += '"';
        text += c;
        quote = quote || c == '"' || c == ',';
    }
    return quote ? '"' + text + '"' : text;
}

void append_csv_line(std::string& csv, std::initializer_list<std::string> fields) {
    constexpr std::string_view line_end = "\r\n";
    bool first = true;
    for (const std::string& text : fields) {
        if (!first) csv += ',';
        csv += text;
        first = false;
    }
    csv += line_end;
}

} // namespace axiscal
