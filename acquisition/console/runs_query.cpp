#include "acquisition/console/runs_query.hpp"

#include "analysis/quantity/valid_text.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

namespace axiscal {
namespace {

constexpr std::size_t most_rows_asked = 100, longest_run_name = 200, longest_search = 200;

std::string_view behind_runs_path(std::string_view path) {
    if (!path.starts_with(runs_path)) return {};
    path.remove_prefix(runs_path.size());
    return path.starts_with('/') ? path.substr(1) : std::string_view{};
}

std::optional<unsigned char> escaped_byte(std::string_view digits) {
    unsigned char byte = 0;
    const char* end = digits.data() + digits.size();
    const auto [rest, error] = std::from_chars(digits.data(), end, byte, 16);
    if (digits.size() != 2 || error != std::errc{} || rest != end) return std::nullopt;
    return byte;
}

/// RFC 3986, 2.1; a plus is a blank, as forms of HTML send it.
std::optional<std::string> without_escapes(std::string_view text) {
    std::string plain;
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (text[at] != '%') {
            plain += text[at] == '+' ? ' ' : text[at];
            continue;
        }
        const auto byte = escaped_byte(text.substr(at + 1, 2));
        if (!byte) return std::nullopt;
        plain += static_cast<char>(*byte);
        at += 2;
    }
    return plain;
}

Result<void> take_limit(RunsAsked& asked, std::string_view value) {
    std::size_t rows = 0;
    const char* end = value.data() + value.size();
    const auto [rest, error] = std::from_chars(value.data(), end, rows);
    if (error != std::errc{} || rest != end || rows < 1 || rows > most_rows_asked)
        return refuse(Fault::bad_request, "limit", "is a whole number from 1 to 100");
    asked.limit = rows;
    return {};
}

Result<void> take_before(RunsAsked& asked, std::string_view value) {
    if (!value.empty() && !is_run_name(value))
        return refuse(Fault::bad_request, "before", "is the id of a run");
    asked.before = value;
    return {};
}

Result<void> take_search(RunsAsked& asked, std::string_view value) {
    const auto plain = without_escapes(value);
    if (!plain) return refuse(Fault::bad_request, "text", "has a % without two digits behind it");
    if (plain->size() > longest_search)
        return refuse(Fault::bad_request, "text", "is at most 200 bytes long");
    asked.text = valid_text(*plain);
    return {};
}

Result<void> take_runs_field(RunsAsked& asked, std::string_view field) {
    const std::size_t sign = std::min(field.find('='), field.size());
    const std::string_view key = field.substr(0, sign);
    const std::string_view value = field.substr(std::min(sign + 1, field.size()));
    if (key == "limit") return take_limit(asked, value);
    if (key == "before") return take_before(asked, value);
    if (key == "text") return take_search(asked, value);
    return refuse(Fault::bad_request, "query",
                  "is unknown; known is ?limit=20&before=ID&text=M-10442");
}

} // namespace

std::string_view runs_call_of(std::string_view path) {
    if (path == runs_path) return runs_path;
    const RunNamed named = run_named_in(path);
    if (named.id.empty()) return {};
    return named.paper.empty() ? one_run_path : run_paper_path;
}

RunNamed run_named_in(std::string_view path) {
    const std::string_view rest = behind_runs_path(path);
    const std::size_t slash = std::min(rest.find('/'), rest.size());
    const std::string_view id = rest.substr(0, slash);
    const std::string_view paper = rest.substr(std::min(slash + 1, rest.size()));
    if (!is_run_name(id) || (!paper.empty() && !is_run_name(paper))) return {};
    return {std::string{id}, std::string{paper}};
}

bool is_run_name(std::string_view name) {
    const auto plain = [](char letter) {
        return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
               (letter >= '0' && letter <= '9') || letter == '.' || letter == '_' || letter == '-';
    };
    return !name.empty() && name.size() <= longest_run_name && name.front() != '.' &&
           std::ranges::all_of(name, plain);
}

Result<RunsAsked> runs_asked_of(std::string_view target) {
    RunsAsked asked;
    std::string_view query = target.substr(std::min(target.find('?'), target.size()));
    if (!query.empty()) query.remove_prefix(1);
    while (!query.empty()) {
        const std::string_view field = query.substr(0, query.find('&'));
        query.remove_prefix(std::min(field.size() + 1, query.size()));
        if (field.empty()) continue;
        AXISCAL_CHECK(take_runs_field(asked, field));
    }
    return asked;
}

} // namespace axiscal
