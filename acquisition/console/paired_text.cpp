#include "acquisition/console/paired_text.hpp"

#include "analysis/quantity/valid_text.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

namespace axiscal {
namespace {

constexpr std::string_view paired_first_line = "axiscal paired browsers 1";

/// Up to the next `end`, which goes with it; nothing where there is no `end`.
std::optional<std::string_view> cut_to(std::string_view& text, char end) {
    const std::size_t at = text.find(end);
    if (at == std::string_view::npos) return std::nullopt;
    const std::string_view part = text.substr(0, at);
    text.remove_prefix(at + 1);
    return part;
}

bool is_hash(std::string_view text) {
    constexpr std::size_t digits = 64;
    return text.size() == digits &&
           text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

/// From 1970 to 2096, so that what is counted on from it stays a number.
std::optional<std::int64_t> instant_of(std::string_view text) {
    constexpr std::int64_t most = 4'000'000'000'000'000'000;
    std::int64_t value = 0;
    const char* const end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, value);
    if (read.ec != std::errc{} || read.ptr != end || value < 0 || value > most) return std::nullopt;
    if (text != std::to_string(value)) return std::nullopt; // "007"
    return value;
}

bool is_name(std::string_view text) {
    constexpr std::size_t longest = 80;
    return !text.empty() && text.size() <= longest && valid_text(text) == text;
}

std::optional<PairedBrowser> browser_of(std::string_view line) {
    const auto hash = cut_to(line, ' '), since = cut_to(line, ' '), last = cut_to(line, ' ');
    if (!hash || !since || !last || !is_hash(*hash) || !is_name(line)) return std::nullopt;
    const auto begun = instant_of(*since);
    const auto ordered = instant_of(*last);
    if (!begun || (!ordered && *last != "-")) return std::nullopt;
    return PairedBrowser{std::string{*hash}, std::string{line}, *begun, ordered};
}

} // namespace

std::string paired_text(const std::vector<PairedBrowser>& paired) {
    std::string text{paired_first_line};
    text += "\n";
    for (const PairedBrowser& browser : paired) {
        const auto& last = browser.last_order_utc_ns;
        text += browser.token_hash + " " + std::to_string(browser.since_utc_ns) + " " +
                (last ? std::to_string(*last) : "-") + " " + browser.name + "\n";
    }
    return text;
}

Result<std::vector<PairedBrowser>> paired_of_text(std::string_view text) {
    if (cut_to(text, '\n') != paired_first_line)
        return fail(Fault::refused, "line 1 is not '" + std::string{paired_first_line} + "'");
    std::vector<PairedBrowser> paired;
    while (!text.empty()) {
        const std::string place = "line " + std::to_string(paired.size() + 2);
        if (paired.size() == most_paired)
            return fail(Fault::refused, place + " is one browser more than may be paired");
        const auto line = cut_to(text, '\n');
        auto browser = line ? browser_of(*line) : std::nullopt;
        if (!browser) return fail(Fault::refused, place + " names no browser");
        paired.push_back(*std::move(browser));
    }
    return paired;
}

} // namespace axiscal
