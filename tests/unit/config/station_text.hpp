#pragma once
// Reads the text of a station file and collects every complaint about it.

#include "config/station_config.hpp"
#include "tests/support/source_dir.hpp"

#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace axiscal::test {

inline SettingsDocument document_of(const std::string& text) {
    auto document = SettingsDocument::parse(text, "station.toml");
    EXPECT_TRUE(document) << (document ? "" : document.error().detail);
    return std::move(document).value();
}

/// All refusals, one a line, as the technician sees them.
inline std::string told(SettingsDocument& document) {
    std::string lines;
    for (const Refusal& refusal : document.finish())
        lines += refusal.describe() + "\n";
    return lines;
}

struct StationReading {
    StationConfig config;
    std::vector<std::string> asked; ///< keys, "table.key"
    std::string told;               ///< refusals, one a line; empty: accepted
};

/// Reads `text`; the keys of drivers and of single kinds of test are none of these tests' business.
inline StationReading read_text(const std::string& text) {
    auto document = document_of(text);
    StationReading reading;
    reading.config = read_station(document);
    for (Settings& options : reading.config.instrument_options)
        options.accept_rest();
    for (KindSection& section : reading.config.kind_sections)
        section.table.accept_rest();
    reading.told = told(document);
    reading.asked = document.asked_keys();
    return reading;
}

/// `name`: "station" or "rotary", the examples of config/.
inline std::string example_text(const std::string& name = "station") {
    std::ifstream file{source_dir() + "/config/" + name + ".example.toml"};
    std::ostringstream text;
    text << file.rdbuf();
    EXPECT_FALSE(text.str().empty()) << name;
    return text.str();
}

/// The example with one piece of its text exchanged.
inline StationReading read_changed(const std::string& from, const std::string& to) {
    std::string text = example_text();
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    if (at != std::string::npos) text.replace(at, from.size(), to);
    return read_text(text);
}

inline int count_lines(const std::string& text) {
    return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

inline void expect_refused_once(const StationReading& reading, const std::string& part) {
    EXPECT_NE(reading.told.find(part), std::string::npos) << part << "\n" << reading.told;
    EXPECT_EQ(count_lines(reading.told), 1) << reading.told;
}

/// "table.key" for every assignment in the file, also in a comment ("# key = ...").
inline std::set<std::string> explained_keys(const std::string& text) {
    static const std::regex header{R"(^(?:# )?\[+([a-z_.]+)\]+$)"},
        key{R"(^(?:# )?([A-Za-z_0-9]+) = .*)"};
    std::set<std::string> keys;
    std::istringstream lines{text};
    std::string line, table;
    std::smatch found;
    while (std::getline(lines, line)) {
        if (std::regex_match(line, found, header)) {
            table = found[1];
            for (auto dot = table.find('.'); dot != std::string::npos;
                 dot = table.find('.', dot + 1))
                keys.insert(table.substr(0, dot));
            keys.insert(table);
        } else if (std::regex_match(line, found, key)) {
            keys.insert(table + "." + found[1].str());
        }
    }
    return keys;
}

} // namespace axiscal::test
