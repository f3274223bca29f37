#include "config/settings_state.hpp"

#include "analysis/quantity/valid_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace axiscal {
namespace {

std::string assignment(std::string_view key, const std::string& value) {
    return std::string{key} + " = " + value;
}
std::string joined(const std::vector<std::string>& words) {
    std::string list;
    for (const std::string& word : words)
        list += (list.empty() ? "" : ", ") + in_quotes(word);
    return list;
}

/// As the file itself writes it above the table.
std::string header_of(const std::string& path) {
    const std::string plain = without_indices(path);
    return path.ends_with(']') ? "its [[" + plain + "]]" : "[" + plain + "]";
}
} // namespace

bool is_calendar_date(std::string_view text) {
    if (text.size() != 10 || text[4] != '-' || text[7] != '-') return false;
    const auto part = [&](std::size_t at, std::size_t length) {
        int value = -1;
        const char* const end = text.data() + at + length;
        const auto read = std::from_chars(text.data() + at, end, value);
        return read.ptr == end && text[at] != '-' ? value : -1;
    };
    const std::chrono::year_month_day date{
        std::chrono::year{part(0, 4)},
        std::chrono::month{static_cast<unsigned>(std::max(0, part(5, 2)))},
        std::chrono::day{static_cast<unsigned>(std::max(0, part(8, 2)))}};
    return part(0, 4) >= 0 && date.ok();
}

const TomlNode* Settings::Impl::ask(std::string_view key) {
    state->asked[path].emplace(key);
    return node ? find_entry(*node, key) : nullptr;
}

void Settings::Impl::refuse(std::string_view key, std::string reason) {
    const TomlNode* value = key.empty() ? nullptr : ask(key);
    state->refuse(joined_path(path, key), value ? value->line : line, std::move(reason));
}

void Settings::Impl::refuse_missing(std::string_view key, const std::string& example) {
    const std::string place = path.empty() ? "the file" : header_of(path);
    refuse(key, "is missing: add it to " + place + ", for example " + assignment(key, example));
}

void Settings::Impl::refuse_kind(std::string_view key,
                                 const TomlNode& value,
                                 std::string_view wanted,
                                 const std::string& example) {
    refuse(key, "is " + std::string{kind_of(value)} + ", but " + std::string{wanted} +
                    " is wanted, for example " + assignment(key, example));
}

Settings::Settings(std::shared_ptr<Impl> impl)
    : impl_{std::move(impl)} {}

std::string Settings::text(std::string_view key, const std::optional<std::string>& fallback) {
    const TomlNode* value = impl_->ask(key);
    if (!value && !fallback) impl_->refuse_missing(key, "\"...\"");
    if (!value) return fallback.value_or("");
    if (const auto* text = std::get_if<std::string>(&value->value)) return valid_text(*text);
    impl_->refuse_kind(key, *value, "a text", "\"...\"");
    return fallback.value_or("");
}

std::string Settings::choice(std::string_view key,
                             const std::vector<std::string>& allowed,
                             const std::optional<std::string>& fallback) {
    std::string first = fallback.value_or(allowed.empty() ? "" : allowed.front());
    const TomlNode* value = impl_->ask(key);
    if (!value && fallback) return *fallback;
    if (!value) return impl_->refuse(key, "is missing: say one of " + joined(allowed)), first;
    const auto* text = std::get_if<std::string>(&value->value);
    if (!text) return impl_->refuse_kind(key, *value, "a text", in_quotes(first)), first;
    if (std::find(allowed.begin(), allowed.end(), *text) != allowed.end()) return *text;
    const std::string near = nearest_word(*text, allowed);
    impl_->refuse(key, in_quotes(*text) + " is not one of " + joined(allowed) +
                           (near.empty() ? "" : "; did you mean " + in_quotes(near) + "?"));
    return near.empty() ? first : near; // what follows from it is judged by what was meant
}

std::int64_t Settings::integer(std::string_view key,
                               std::int64_t low,
                               std::int64_t high,
                               std::optional<std::int64_t> fallback) {
    const std::string range = "from " + std::to_string(low) + " to " + std::to_string(high);
    const TomlNode* value = impl_->ask(key);
    if (!value && fallback) return *fallback;
    if (!value)
        return impl_->refuse(key, "is missing: a whole number " + range + " is wanted"), low;
    const auto* whole = std::get_if<std::int64_t>(&value->value);
    if (!whole)
        return impl_->refuse_kind(key, *value, "a whole number " + range,
                                  std::to_string(fallback.value_or(low))),
               low;
    if (*whole >= low && *whole <= high) return *whole;
    impl_->refuse(key, std::to_string(*whole) + " is out of range: " + range);
    return low;
}

double
Settings::number(std::string_view key, double low, double high, std::optional<double> fallback) {
    const std::string range = "from " + write_number(low) + " to " + write_number(high);
    const TomlNode* value = impl_->ask(key);
    if (!value && fallback) return *fallback;
    if (!value) return impl_->refuse(key, "is missing: a number " + range + " is wanted"), low;
    const auto* whole = std::get_if<std::int64_t>(&value->value);
    const auto* real = std::get_if<double>(&value->value);
    if (!whole && !real)
        return impl_->refuse_kind(key, *value, "a bare number " + range,
                                  write_number(fallback.value_or(low))),
               low;
    const double number = whole ? static_cast<double>(*whole) : *real;
    if (std::isfinite(number) && within(number, low, high)) return number;
    impl_->refuse(key, write_number(number) + " is out of range: " + range);
    return low;
}

bool Settings::flag(std::string_view key, std::optional<bool> fallback) {
    const TomlNode* value = impl_->ask(key);
    if (!value && !fallback) impl_->refuse_missing(key, "true");
    if (!value) return fallback.value_or(false);
    if (const auto* flag = std::get_if<bool>(&value->value)) return *flag;
    impl_->refuse_kind(key, *value, "true or false", "true");
    return fallback.value_or(false);
}

std::string Settings::date(std::string_view key,
                           const std::optional<std::string>& fallback,
                           std::string_view or_word) {
    const std::string example = "\"2026-11-21\"";
    const TomlNode* value = impl_->ask(key);
    if (!value && !fallback) impl_->refuse_missing(key, example);
    if (!value) return fallback.value_or("");
    if (const auto* date = std::get_if<TomlDate>(&value->value)) return date->iso;
    const auto* text = std::get_if<std::string>(&value->value);
    if (!text) return impl_->refuse_kind(key, *value, "a date", example), "";
    if (is_calendar_date(*text) || (text->empty() && fallback)) return *text;
    if (!or_word.empty() && *text == or_word) return *text;
    impl_->refuse(key, in_quotes(*text) + " is no date: write year-month-day, for example " +
                           example +
                           (or_word.empty() ? "" : ", or " + in_quotes(std::string{or_word})));
    return "";
}

std::vector<std::string> Settings::texts(std::string_view key,
                                         const std::optional<std::vector<std::string>>& fallback) {
    const std::string example = "[\"...\"]";
    const TomlNode* value = impl_->ask(key);
    if (!value && !fallback) impl_->refuse_missing(key, example);
    if (!value) return fallback.value_or(std::vector<std::string>{});
    const auto* items = std::get_if<TomlArray>(&value->value);
    std::vector<std::string> list;
    for (std::size_t i = 0; items && i < items->size(); ++i)
        if (const auto* text = std::get_if<std::string>(&(*items)[i].value))
            list.push_back(valid_text(*text));
    if (!items || list.size() != items->size())
        impl_->refuse_kind(key, *value, "a list of texts", example);
    return list;
}

bool Settings::has(std::string_view key) const {
    return impl_->ask(key) != nullptr;
}

Settings Settings::table(std::string_view key) {
    const TomlNode* value = impl_->ask(key);
    if (value && !std::holds_alternative<TomlTable>(value->value)) {
        impl_->refuse(key, "is " + std::string{kind_of(*value)} +
                               ", but a table is wanted: write [" + joined_path(impl_->path, key) +
                               "]");
        value = nullptr;
    }
    const std::string path = joined_path(impl_->path, key);
    impl_->state->asked.try_emplace(path);
    return Settings{
        std::make_shared<Impl>(Impl{impl_->state, value, path, value ? value->line : impl_->line})};
}

std::vector<Settings> Settings::tables(std::string_view key) {
    std::vector<Settings> tables;
    const TomlNode* value = impl_->ask(key);
    const auto* items = value ? std::get_if<TomlArray>(&value->value) : nullptr;
    bool sound = !value || items;
    for (std::size_t i = 0; items && i < items->size(); ++i) {
        const TomlNode& item = (*items)[i];
        sound = sound && std::holds_alternative<TomlTable>(item.value);
        const std::string path = joined_path(impl_->path, key) + "[" + std::to_string(i) + "]";
        impl_->state->asked.try_emplace(path);
        impl_->state->entitle(path, key, item);
        tables.push_back(
            Settings{std::make_shared<Impl>(Impl{impl_->state, &item, path, item.line})});
    }
    if (sound) return tables;
    impl_->refuse(key, "is " + std::string{kind_of(*value)} +
                           ", but a list of tables is wanted: write [[" +
                           joined_path(impl_->path, key) + "]] above each");
    return {};
}

void Settings::refuse(std::string_view key, std::string reason) {
    impl_->refuse(key, std::move(reason));
}
bool Settings::refused(std::string_view key) const {
    return impl_->state->refused.contains(joined_path(impl_->path, key));
}
void Settings::accept_rest() {
    impl_->state->accepted.insert(impl_->path);
}
int Settings::line() const {
    return impl_->line;
}
int Settings::line_of(std::string_view key) const {
    const TomlNode* value = impl_->node ? find_entry(*impl_->node, key) : nullptr;
    return value ? value->line : impl_->line;
}
const std::string& Settings::path() const {
    return impl_->path;
}

} // namespace axiscal
