#include "config/settings_state.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <memory>

namespace axiscal {
namespace {

constexpr std::size_t largest_file = 4u << 20; ///< bytes; a station file has some ten thousand

/// At most one byte more than `largest_file`. Plain C calls: a stream throws on a folder.
Result<std::string> read_file(const std::string& path) {
    const auto unreadable = [&] {
        return fail(Fault::bad_configuration, path + ": the file cannot be read",
                    std::error_code{errno, std::generic_category()});
    };
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file{std::fopen(path.c_str(), "rb"),
                                                               &std::fclose};
    if (!file) return unreadable();
    std::string text;
    std::array<char, 16384> piece{}; // more than most files have; the limit is never set aside
    while (text.size() <= largest_file) {
        const std::size_t wanted = std::min(piece.size(), largest_file + 1 - text.size());
        const std::size_t came = std::fread(piece.data(), 1, wanted, file.get());
        text.append(piece.data(), came);
        if (came < wanted) break;
    }
    if (std::ferror(file.get()) != 0) return unreadable();
    return text;
}

std::string unread_reason(const std::string& key, const std::set<std::string>& known) {
    const std::string near = nearest_word(key, {known.begin(), known.end()});
    return near.empty() ? "is not a key of this table: remove it, or see the example station file"
                        : "is not a key of this table; did you mean \"" + near + "\"?";
}

} // namespace

std::string Refusal::describe() const {
    if (line == 0 && reason.starts_with(file)) return reason; // of the whole file; says its place
    return file + ":" + std::to_string(line) + ": " + (key.empty() ? "" : key + ": ") + reason;
}

std::string joined_path(std::string_view path, std::string_view key) {
    if (path.empty()) return std::string{key};
    if (key.empty()) return std::string{path};
    return std::string{path} + "." + std::string{key};
}

std::string without_indices(std::string_view path) {
    std::string plain;
    bool inside = false;
    for (const char letter : path) {
        if (letter == '[') inside = true;
        if (!inside) plain += letter;
        if (letter == ']') inside = false;
    }
    return plain;
}

void SettingsDocument::State::refuse(std::string key, int line, std::string reason) {
    refused.insert(key);
    refusals.push_back({name, line, shown_key(key), std::move(reason)});
}

void SettingsDocument::State::entitle(const std::string& path,
                                      std::string_view key,
                                      const TomlNode& node) {
    const TomlNode* said = find_entry(node, key == "channel" ? "channel" : "name");
    const auto* words = said ? std::get_if<std::string>(&said->value) : nullptr;
    if (words && !words->empty()) titles[path] = std::string{key} + " " + in_quotes(*words);
}

std::string SettingsDocument::State::shown_key(const std::string& key) const {
    std::string shown, replaced;               // the part of the key that `shown` stands for
    for (const auto& [path, title] : titles) { // "a[0]" comes before "a[0].b[1]"
        const bool holds = key == path || key.starts_with(path + ".");
        if (!holds || !path.starts_with(replaced)) continue;
        const auto last = path.rfind('.');
        const std::string before = last == std::string::npos ? "" : path.substr(0, last);
        const std::string above =
            replaced.empty() ? before
                             : shown + before.substr(std::min(replaced.size(), before.size()));
        shown = joined_path(above, title);
        replaced = path;
    }
    return shown + key.substr(replaced.size());
}

void SettingsDocument::State::refuse_unread(const TomlNode& table, const std::string& path) {
    const auto* entries = std::get_if<TomlTable>(&table.value);
    if (!entries) return;
    const auto& known = asked[path];
    for (const auto& [key, entry] : *entries) {
        const std::string below = joined_path(path, key);
        if (!known.contains(key)) {
            if (!accepted.contains(path) && !refused.contains(below)) // told by finish() before
                refuse(below, entry.line, unread_reason(key, known));
            continue;
        }
        if (asked.contains(below)) refuse_unread(entry, below);
        const auto* items = std::get_if<TomlArray>(&entry.value);
        for (std::size_t i = 0; items && i < items->size(); ++i) {
            const std::string item = below + "[" + std::to_string(i) + "]";
            if (asked.contains(item)) refuse_unread((*items)[i], item);
        }
    }
}

SettingsDocument::SettingsDocument(std::shared_ptr<State> state)
    : state_{std::move(state)} {}

Result<SettingsDocument> SettingsDocument::load(const std::string& path) {
    AXISCAL_TRY(std::string text, read_file(path));
    return parse(std::move(text), path);
}

Result<SettingsDocument> SettingsDocument::parse(std::string text, std::string name) {
    if (text.size() > largest_file)
        return fail(Fault::bad_configuration, name + ":1: larger than 4 MB: no station file");
    AXISCAL_TRY(TomlNode root, parse_toml(text, name));
    auto state = std::make_shared<State>();
    state->text = std::move(text);
    state->name = std::move(name);
    state->root = std::move(root);
    return SettingsDocument{std::move(state)};
}

Settings SettingsDocument::root() const {
    state_->asked.try_emplace("");
    return Settings{std::make_shared<Settings::Impl>(Settings::Impl{state_, &state_->root, "", 1})};
}

const std::string& SettingsDocument::source_text() const {
    return state_->text;
}

const std::string& SettingsDocument::name() const {
    return state_->name;
}

std::vector<Refusal> SettingsDocument::finish() {
    state_->refuse_unread(state_->root, "");
    auto refusals = std::exchange(state_->refusals, {});
    std::stable_sort(refusals.begin(), refusals.end(),
                     [](const Refusal& a, const Refusal& b) { return a.line < b.line; });
    return refusals;
}

std::vector<std::string> SettingsDocument::asked_keys() const {
    std::set<std::string> keys;
    for (const auto& [path, names] : state_->asked)
        for (const std::string& name : names)
            keys.insert(without_indices(joined_path(path, name)));
    return {keys.begin(), keys.end()};
}

} // namespace axiscal
