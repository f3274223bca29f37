#pragma once
// What a document and the views of its tables share. Internal to config/. Pure.

#include "config/measure.hpp"
#include "config/settings.hpp"
#include "config/toml_tree.hpp"

#include <map>
#include <set>

namespace axiscal {

struct SettingsDocument::State {
    std::string text, name;
    TomlNode root;
    std::vector<Refusal> refusals;
    std::map<std::string, std::set<std::string>> asked; ///< keys asked for, by path of the table
    std::map<std::string, std::string> titles; ///< of tables in lists, by path: instrument "air"
    std::set<std::string> refused;             ///< full keys
    std::set<std::string> accepted;            ///< tables whose unread keys are no refusal

    void refuse(std::string key, int line, std::string reason);
    /// Remembers what people call the table `node`, which is one of a list.
    void entitle(const std::string& path, std::string_view key, const TomlNode& node);
    /// The key with the title in the place of each number whose table has one.
    [[nodiscard]] std::string shown_key(const std::string& key) const;
    /// Refuses what nobody asked for in `table` and below.
    void refuse_unread(const TomlNode& table, const std::string& path);
};

/// "axis.material": a key below a path; the root has the empty path.
std::string joined_path(std::string_view path, std::string_view key);

/// "instrument[1].channel[0]" without the indices.
std::string without_indices(std::string_view path);

inline std::string in_quotes(std::string_view text) {
    return "\"" + std::string{text} + "\"";
}

/// A table as one reader sees it. `node` is null when the file has no such table: every key is
/// then missing.
struct Settings::Impl {
    std::shared_ptr<SettingsDocument::State> state;
    const TomlNode* node = nullptr;
    std::string path;
    int line = 1;

    /// The value at `key`, which counts as asked for from now on.
    const TomlNode* ask(std::string_view key);
    void refuse(std::string_view key, std::string reason);
    void refuse_missing(std::string_view key, const std::string& example);
    void refuse_kind(std::string_view key,
                     const TomlNode& node,
                     std::string_view wanted,
                     const std::string& example);

    struct Range {
        double low, high;
    };
    /// One measured value at `key` (an element of a list: "targets[3]"); `stand_in` when refused.
    double measure_node(const std::string& key,
                        const TomlNode& value,
                        const Measure& measure,
                        Range range,
                        double stand_in,
                        UnitName* unit = nullptr);
    double measured(std::string_view key,
                    const Measure& measure,
                    Range range,
                    std::optional<double> fallback,
                    UnitName* unit = nullptr);
    std::vector<Length> measured_list(std::string_view key,
                                      const Measure& measure,
                                      Range range,
                                      const std::optional<std::vector<Length>>& fallback);
};

} // namespace axiscal
