#include "tools/axiscal/case_text.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <set>
#include <utility>
#include <vector>

namespace axiscal {
namespace {

using nlohmann::json;

constexpr std::size_t largest_text = std::size_t{64} << 20;
constexpr int deepest_nesting = 64; // a case needs 5
constexpr char marker = '\x01';     // cannot stand unescaped in a JSON string

bool is_token_character(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '+' || c == '-' || c == '.';
}

std::string lower_case(std::string text) {
    for (char& c : text)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

/// NaN and infinities in the spellings of common writers, and numbers that overflow a double.
bool is_not_finite(const std::string& token) {
    const std::size_t begin = token.front() == '+' || token.front() == '-' ? 1 : 0;
    const std::string word = lower_case(token.substr(begin));
    if (word == "nan" || word == "inf" || word == "infinity") return true;
    if (word.find('e') == std::string::npos && word.size() < 300) return false;
    char* end = nullptr;
    const double value = std::strtod(token.c_str(), &end);
    return *end == '\0' && std::isinf(value);
}

std::size_t end_of_string(std::string_view text, std::size_t begin) {
    std::size_t i = begin + 1;
    while (i < text.size() && text[i] != '"')
        i += text[i] == '\\' ? 2 : 1;
    return std::min(i + 1, text.size());
}

std::size_t end_of_token(std::string_view text, std::size_t begin) {
    std::size_t i = begin;
    while (i < text.size() && is_token_character(text[i]))
        ++i;
    return i;
}

/// Copies the text with its not-finite tokens turned into marked strings.
Result<std::string> mark_not_finite(std::string_view text) {
    std::string out;
    out.reserve(text.size() + 64);
    int depth = 0;
    for (std::size_t i = 0; i < text.size();) {
        const char c = text[i];
        depth += c == '[' || c == '{' ? 1 : c == ']' || c == '}' ? -1 : 0;
        if (depth > deepest_nesting)
            return refuse(Fault::bad_case, "json", "is nested deeper than 64 levels");
        std::size_t end = i + 1;
        if (c == '"') end = end_of_string(text, i);
        if (is_token_character(c)) end = end_of_token(text, i);
        const std::string piece{text.substr(i, end - i)};
        if (is_token_character(c) && is_not_finite(piece))
            out += "\"\\u0001" + piece + '"';
        else
            out += piece;
        i = end;
    }
    return out;
}

/// Follows the parser and notes keys that stand twice in one object. Pure.
class RepeatedKeys {
public:
    void see(int depth, json::parse_event_t event, const json& parsed) {
        switch (event) {
        case json::parse_event_t::array_start: in_array_ = in_array_ || depth == 0; break;
        case json::parse_event_t::object_start: open_.emplace_back(); break;
        case json::parse_event_t::key:
            if (!open_.back().insert(parsed.get<std::string>()).second)
                repeated_.try_emplace(element_, parsed.get<std::string>());
            break;
        case json::parse_event_t::object_end:
            open_.pop_back();
            count_element(depth);
            break;
        case json::parse_event_t::array_end:
        case json::parse_event_t::value: count_element(depth); break;
        }
    }
    [[nodiscard]] const std::map<std::size_t, std::string>& repeated() const { return repeated_; }

private:
    void count_element(int depth) {
        if (in_array_ && depth == 1) ++element_;
    }

    bool in_array_ = false;
    std::size_t element_ = 0;
    std::vector<std::set<std::string>> open_;
    std::map<std::size_t, std::string> repeated_;
};

/// "parse error at line 3, column 7: ..." without the library's own label.
std::string reason_of(const std::string& what) {
    const auto label_end = what.find("] ");
    return printable(label_end == std::string::npos ? what : what.substr(label_end + 2));
}

} // namespace

std::string printable(std::string_view text) {
    std::string out{text};
    for (char& c : out)
        if (c < ' ' || c > '~') c = '?';
    return out;
}

std::string not_finite_token(const json& value) {
    if (!value.is_string()) return {};
    const auto& text = value.get_ref<const std::string&>();
    return !text.empty() && text.front() == marker ? printable(text.substr(1)) : std::string{};
}

Result<CaseText> read_case_text(std::string_view text) {
    if (text.size() > largest_text) return refuse(Fault::bad_case, "json", "is larger than 64 MiB");
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    AXISCAL_TRY(const std::string marked, mark_not_finite(text));
    RepeatedKeys keys;
    const auto follow = [&keys](int depth, json::parse_event_t event, json& parsed) {
        keys.see(depth, event, parsed);
        return true;
    };
    try {
        json document = json::parse(marked, follow);
        return CaseText{std::move(document), keys.repeated()};
    } catch (const json::exception& error) {
        return refuse(Fault::bad_case, "json", reason_of(error.what()));
    }
}

} // namespace axiscal
