#include "tools/axiscal/tape/tape_header.hpp"

#include "drivers/registry.hpp"

#include <algorithm>
#include <array>
#include <iomanip>
#include <sstream>

namespace axiscal {
namespace {

constexpr std::string_view key_prefix = "key.";
constexpr std::array<std::string_view, 7> of_the_station{
    "name", "driver", "serial", "certificate_number", "calibrated_on", "due_on", "tape"};

std::string trimmed(const std::string& text) {
    const auto begin = text.find_first_not_of(" \t\r");
    if (begin == std::string::npos) return {};
    return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

/// "fold", "\"corner cube\"   # or ..." of one line; an empty key for what is no assignment.
std::pair<std::string, std::string> assignment(const std::string& line) {
    const auto equals = line.find('=');
    const std::string key = trimmed(line.substr(0, equals));
    if (equals == std::string::npos || key.empty() || key.front() == '#') return {};
    return {key, trimmed(line.substr(equals + 1))};
}

/// The assignments of each [[instrument]], its sub-tables left out.
std::vector<HeaderLines> instrument_blocks(const std::string& text) {
    std::vector<HeaderLines> blocks;
    bool inside = false;
    std::istringstream lines{text};
    for (std::string line; std::getline(lines, line);) {
        const std::string word = trimmed(line);
        if (word.starts_with("[")) {
            inside = word.starts_with("[[instrument]]");
            if (inside) blocks.emplace_back();
        } else if (inside) {
            if (auto found = assignment(word); !found.first.empty())
                blocks.back().push_back(std::move(found));
        }
    }
    return blocks;
}

bool is_called(const HeaderLines& block, const std::string& name) {
    return std::ranges::any_of(block, [&](const auto& line) {
        return line.first == "name" && line.second.starts_with("\"" + name + "\"");
    });
}

} // namespace

HeaderLines driver_keys(const std::string& station_text, const std::string& name) {
    HeaderLines keys;
    for (const HeaderLines& block : instrument_blocks(station_text)) {
        if (!is_called(block, name)) continue;
        for (const auto& [key, value] : block)
            if (std::ranges::find(of_the_station, key) == of_the_station.end())
                keys.emplace_back(std::string{key_prefix} + key, value);
    }
    return keys;
}

std::string header_text(const HeaderLines& lines) {
    std::string text;
    for (const auto& [key, value] : lines) {
        std::string line = value;
        std::ranges::replace_if(
            line, [](char letter) { return letter == '\n' || letter == '\r'; }, ' ');
        text.append(key).append(" = ").append(line).append("\n");
    }
    return text;
}

Result<std::unique_ptr<Instrument>> instrument_of(const Tape& tape) {
    const auto driver = tape.header.find("driver");
    if (driver == tape.header.end())
        return fail(
            Fault::bad_request,
            "the tape names no driver: write \"driver = NAME\" and its keys as \"key.fold = "
            "...\" into its header");
    std::string keys;
    for (const auto& [key, value] : tape.header)
        if (key.starts_with(key_prefix))
            keys += key.substr(key_prefix.size()) + " = " + value + "\n";
    AXISCAL_TRY(auto document, SettingsDocument::parse(keys, "the tape's keys"));
    InstrumentConfig config;
    config.name = "tape";
    config.driver = driver->second;
    std::vector<Settings> options{document.root()};
    auto made = make_instruments({config}, options);
    std::string refusals;
    for (const Refusal& refusal : document.finish())
        refusals += (refusals.empty() ? "" : "; ") + refusal.key + ": " + refusal.reason;
    if (!refusals.empty() || !made.front()) return fail(Fault::bad_request, refusals);
    return std::move(made.front());
}

Result<std::string>
block_text(const Tape& tape, const std::string& name, const std::string& full_path) {
    if (const auto named = tape.header.find("driver"); named != tape.header.end()) {
        AXISCAL_TRY(const InstrumentDriver* const driver, find_driver(named->second));
        if (!driver->no_tape.empty()) return fail(Fault::bad_request, std::string{driver->no_tape});
    }
    AXISCAL_CHECK(instrument_of(tape)); // it tells its driver, and the keys are right
    std::ostringstream block;
    block << "\n[[instrument]]\nname = " << std::quoted(name)
          << "\ndriver = " << std::quoted(tape.header.at("driver"))
          << "\ntape = " << std::quoted(full_path) << "   # no instrument: nothing is measured\n";
    for (const auto& [key, value] : tape.header)
        if (key.starts_with(key_prefix))
            block << key.substr(key_prefix.size()) << " = " << value << "\n";
    return block.str();
}

} // namespace axiscal
