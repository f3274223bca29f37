// The pages in docs/instruments against the drivers: what a technician copies must be right.
#include "config/station_config.hpp"
#include "drivers/registry.hpp"
#include "tests/support/source_dir.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

namespace axiscal::instrument_pages_test {
namespace {

std::string text_of(const std::filesystem::path& path) {
    std::ifstream file{path};
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

/// What stands between ```toml and ``` and begins with an instrument.
std::vector<std::string> instrument_blocks(const std::string& page) {
    const std::string begin = "```toml\n[[instrument]]\n";
    std::vector<std::string> blocks;
    for (auto at = page.find(begin); at != std::string::npos; at = page.find(begin, at + 1)) {
        const auto text = at + std::string{"```toml\n"}.size();
        blocks.push_back(page.substr(text, page.find("```", text) - text));
    }
    return blocks;
}

void check_block(const std::string& block, const std::string& page, const std::string& name) {
    auto document = SettingsDocument::parse(block, name);
    ASSERT_TRUE(document) << document.error().detail;
    StationConfig config;
    std::vector<Settings> options;
    for (Settings& table : document->root().tables("instrument")) {
        InstrumentConfig instrument;
        for (const char* key : {"name", "serial", "certificate_number"})
            table.text(key, "");
        for (const char* key : {"calibrated_on", "due_on"})
            table.date(key, "");
        instrument.driver = table.text("driver");
        config.instruments.push_back(std::move(instrument));
        options.push_back(table);
    }
    for (const auto& made : make_instruments(config.instruments, options))
        EXPECT_NE(made, nullptr) << name;
    for (const Refusal& refusal : document->finish())
        if (refusal.key.find(".channel") == std::string::npos) // the station's, not the driver's
            ADD_FAILURE() << refusal.describe();
    for (const std::string& key : document->asked_keys()) {
        if (!key.starts_with("instrument.")) continue;
        const std::string word = key.substr(key.rfind('.') + 1);
        const bool told = page.find("`" + word + "`") != std::string::npos ||
                          block.find("\n" + word + " = ") != std::string::npos;
        EXPECT_TRUE(told || word == "serial" || word == "certificate_number" ||
                    word == "calibrated_on" || word == "due_on")
            << name << " does not tell of the key " << word;
    }
}

TEST(InstrumentPages, ShowBlocksThatTheDriversAcceptAndTellEveryKey) {
    setenv("AXISCAL_PROFILE_PATH", (test::source_dir() + "/config/profiles").c_str(), 1);
    int blocks = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator{test::source_dir() + "/docs/instruments"}) {
        const std::string page = text_of(entry.path());
        for (const std::string& block : instrument_blocks(page)) {
            check_block(block, page, entry.path().filename().string());
            ++blocks;
        }
    }
    EXPECT_GE(blocks, 5);
}

/// The cell beside `title` in the table under "Checked"; empty: no such row.
std::string checked_cell(const std::string& page, const std::string& title) {
    const auto table = page.find("\n## Checked\n\n| | |\n|---|---|\n");
    if (table == std::string::npos) return {};
    const std::string begin = "\n| " + title + " | ", end = " |\n";
    const auto row = page.find(begin, table);
    if (row == std::string::npos) return {};
    const auto text = row + begin.size();
    return page.substr(text, page.find(end, text) - text);
}

/// A page that says "seen" must be changed here, too, with the tape of the device beside it.
TEST(InstrumentPages, SayWhatWasCheckedAgainstWhatAndThatNoDeviceWasSeen) {
    int pages = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator{test::source_dir() + "/docs/instruments"}) {
        const std::string name = entry.path().filename().string();
        if (name == "README.md") continue;
        const std::string page = text_of(entry.path());
        for (const char* title : {"bytes checked against", "kernel path checked"})
            EXPECT_GT(checked_cell(page, title).size(), 10U) << name << ": " << title;
        EXPECT_EQ(checked_cell(page, "seen on a real device"), "never") << name;
        ++pages;
    }
    EXPECT_GE(pages, 14);
}

TEST(InstrumentPages, RowThatIsMissingOrStandsElsewhereIsNotFound) {
    const std::string row = "| seen on a real device | never |\n";
    const std::string table = "\n## Checked\n\n| | |\n|---|---|\n";
    EXPECT_EQ(checked_cell(table + row, "seen on a real device"), "never");
    EXPECT_EQ(checked_cell(table, "seen on a real device"), "");
    EXPECT_EQ(checked_cell("\n" + row, "seen on a real device"), "");
    EXPECT_EQ(checked_cell(table + row, "kernel path checked"), "");
}

} // namespace
} // namespace axiscal::instrument_pages_test
