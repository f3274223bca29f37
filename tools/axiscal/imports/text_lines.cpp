#include "tools/axiscal/imports/text_lines.hpp"

#include "tools/axiscal/case_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace axiscal {

std::string_view without_blanks(std::string_view text) {
    constexpr std::string_view blanks = " \t\r";
    const auto begin = text.find_first_not_of(blanks);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::vector<TextLine> lines_of(std::string_view text) {
    std::vector<TextLine> lines;
    while (!text.empty()) {
        const auto end = std::min(text.find('\n'), text.size());
        lines.push_back({lines.size() + 1, without_blanks(text.substr(0, end))});
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

std::vector<std::string_view> words_of(std::string_view text) {
    std::vector<std::string_view> words;
    while (!(text = without_blanks(text)).empty()) {
        const auto end = std::min(text.find_first_of(" \t"), text.size());
        words.push_back(text.substr(0, end));
        text.remove_prefix(end);
    }
    return words;
}

tl::unexpected<Error> refuse_line(std::size_t line, std::string reason) {
    return refuse(Fault::bad_case, "line " + std::to_string(line), std::move(reason));
}

Result<double> number_of(std::string_view word, std::size_t line) {
    std::string text{word.starts_with('+') ? word.substr(1) : word};
    if (text.find('.') == std::string::npos) std::ranges::replace(text, ',', '.');
    double value = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    constexpr double largest = 1e9;
    if (fault != std::errc{} || end != text.data() + text.size() || !(std::fabs(value) <= largest))
        return refuse_line(line, "\"" + printable(word) + "\" is no number");
    return value;
}

} // namespace axiscal
