#include "config/number_pattern.hpp"

#include <algorithm>

namespace axiscal {
namespace {

bool is_count(std::string_view token) {
    constexpr std::string_view padded = "count:";
    return token == "count" || (token.size() == padded.size() + 1 && token.starts_with(padded) &&
                                token.back() >= '1' && token.back() <= '9');
}

} // namespace

std::string mistake_in_number(std::string_view text) {
    constexpr std::size_t longest = 60;
    constexpr unsigned char first_printed = 0x20, deleted = 0x7f;
    const std::string example = "as in \"CAL-{year}-{count:4}\"";
    if (text.size() > longest) return "is longer than 60 bytes: it stands in the head of each page";
    if (std::ranges::any_of(text, [](char letter) {
            const auto byte = static_cast<unsigned char>(letter);
            return byte < first_printed || byte == deleted;
        }))
        return "holds a line break, a tab or another control character: write it in one line";
    int counts = 0;
    for (std::size_t at = text.find_first_of("{}"); at != std::string_view::npos;
         at = text.find_first_of("{}", at)) {
        const auto end = text.find('}', at);
        if (text[at] == '}' || end == std::string_view::npos)
            return "has a brace without its other half; tokens are {year}, {count} and {count:4}, " +
                   example;
        const std::string_view token = text.substr(at + 1, end - at - 1);
        if (token != "year" && !is_count(token))
            return "knows no {" + std::string{token} +
                   "}; tokens are {year}, {count} and, with digits to fill, {count:1} to {count:9}";
        counts += token == "year" ? 0 : 1;
        at = end + 1;
    }
    const bool pattern = text.find('{') != std::string_view::npos;
    if (pattern && counts != 1)
        return "needs {count} once, so that no two certificates bear one number, " + example;
    return {};
}

} // namespace axiscal
