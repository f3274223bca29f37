#include "tools/axiscal/case_text.hpp"

#include "analysis/quantity/text_encoding.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

namespace axiscal {
namespace {

using nlohmann::json;

constexpr std::size_t deepest_nesting = 64; // a case needs 5
constexpr char marker = '\x01';             // cannot stand unescaped in a JSON string

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
        if (depth > static_cast<int>(deepest_nesting))
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

/// Builds the document while the text is read once, and notes keys that stand twice in one object.
// The json library's noexcept constructor of a null throws for other types only.
class Builder { // NOLINT(bugprone-exception-escape)
public:
    using number_integer_t = json::number_integer_t;
    using number_unsigned_t = json::number_unsigned_t;
    using number_float_t = json::number_float_t;
    using string_t = json::string_t;
    using binary_t = json::binary_t;

    bool null() { return add(nullptr); }
    bool boolean(bool value) { return add(value); }
    bool number_integer(number_integer_t value) { return add(value); }
    bool number_unsigned(number_unsigned_t value) { return add(value); }
    bool number_float(number_float_t value, const string_t&) { return add(value); }
    bool string(const string_t& value) { return add(value); }
    bool binary(const binary_t&) { return false; } // is none in a text
    bool start_object(std::size_t) { return open(json::value_t::object); }
    bool start_array(std::size_t) { return open(json::value_t::array); }
    bool end_object() { return close(); }
    bool end_array() { return close(); }
    bool key(const string_t& name) {
        const auto [member, is_new] = open_.back()->emplace(name, nullptr);
        if (!is_new) repeated_.try_emplace(place_in_top_array(), name);
        member_ = &*member;
        return true;
    }
    bool parse_error(std::size_t, const std::string&, const json::exception& error) {
        error_ = error.what();
        return false;
    }

    [[nodiscard]] const std::string& error() const { return error_; }
    CaseText take() { return {std::move(document_), std::move(repeated_)}; }

private:
    [[nodiscard]] std::size_t place_in_top_array() const {
        return document_.is_array() ? document_.size() - 1 : 0;
    }
    template <class Value> json* place(Value&& value) {
        if (open_.empty()) return &(document_ = std::forward<Value>(value));
        if (open_.back()->is_array())
            return &open_.back()->emplace_back(std::forward<Value>(value));
        return &(*member_ = std::forward<Value>(value));
    }
    template <class Value> bool add(Value&& value) {
        place(std::forward<Value>(value));
        return true;
    }
    bool open(json::value_t type) {
        if (open_.size() == deepest_nesting) return false;
        open_.push_back(place(type));
        return true;
    }
    bool close() {
        open_.pop_back();
        return true;
    }

    json document_;
    std::vector<json*> open_;
    json* member_ = nullptr;
    std::map<std::size_t, std::string> repeated_;
    std::string error_;
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
    if (text.size() > largest_case_bytes)
        return refuse(Fault::bad_case, "json", "is larger than 64 MiB");
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    Builder builder;
    if (json::sax_parse(text, &builder)) return builder.take();
    if (const auto wrong = wrong_encoding(text))
        return refuse(Fault::bad_case, "json",
                      "line " + std::to_string(wrong->line) + ": " + wrong->reason);
    // the second reading marks what is no JSON number and finds the reason of a refusal
    AXISCAL_TRY(const std::string marked, mark_not_finite(text));
    Builder again;
    if (json::sax_parse(marked, &again)) return again.take();
    return refuse(Fault::bad_case, "json", reason_of(again.error()));
}

} // namespace axiscal
