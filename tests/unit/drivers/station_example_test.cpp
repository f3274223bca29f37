// The example station file against the drivers that it names.
#include "config/station_config.hpp"
#include "drivers/registry.hpp"
#include "tests/support/source_dir.hpp"

#include <cstdlib>
#include <gtest/gtest.h>
#include <sstream>
#include <string>
#include <vector>

namespace axiscal {
namespace {

const std::string folder = test::source_dir() + "/config";

TEST(StationExample, IsAcceptedByTheDriversItNames) {
    setenv("AXISCAL_PROFILE_PATH", (folder + "/profiles").c_str(), 1);
    auto document = SettingsDocument::load(folder + "/station.example.toml");
    ASSERT_TRUE(document) << document.error().detail;
    StationConfig config = read_station(*document);
    const auto instruments = make_instruments(config.instruments, config.instrument_options);
    for (const Refusal& refusal : document->finish())
        ADD_FAILURE() << refusal.describe();
    ASSERT_EQ(instruments.size(), 3U);
    for (const auto& instrument : instruments)
        EXPECT_NE(instrument, nullptr);
    // Each driver's key stands in the example with its name, as a value or behind one "#".
    for (const std::string& key : document->asked_keys()) {
        if (!key.starts_with("instrument.")) continue;
        const std::string name = key.substr(key.rfind('.') + 1);
        const std::string& text = document->source_text();
        const bool explained = text.find("\n" + name + " = ") != std::string::npos ||
                               text.find("\n# " + name + " = ") != std::string::npos ||
                               text.find("[[instrument." + name + "]]") != std::string::npos;
        EXPECT_TRUE(explained) << key;
    }
}

/// The example's instruments that stand behind "#", as they are once it is taken away.
std::string uncommented(const std::string& text) {
    std::istringstream lines{text.substr(text.find("# Other instruments."))};
    std::string toml;
    for (std::string line; std::getline(lines, line);) {
        const auto equals = line.find(" = ");
        const bool key = equals != std::string::npos && line.find(' ', 2) == equals;
        if (line.starts_with("# [[") || key) toml += line.substr(2) + "\n";
    }
    return toml;
}

TEST(StationExample, ShowsEveryKeyOfTheInstrumentsThatItLeavesOut) {
    const auto example = SettingsDocument::load(folder + "/station.example.toml");
    ASSERT_TRUE(example);
    const std::string toml = uncommented(example->source_text());
    auto document = SettingsDocument::parse(toml, "example");
    ASSERT_TRUE(document) << document.error().detail << "\n" << toml;
    std::vector<Settings> tables = document->root().tables("instrument");
    std::vector<InstrumentConfig> configs(tables.size());
    for (std::size_t i = 0; i < tables.size(); ++i) {
        configs[i].name = tables[i].text("name");
        configs[i].driver = tables[i].text("driver");
        for (Settings& channel : tables[i].tables("channel"))
            channel.accept_rest();
    }
    const auto instruments = make_instruments(configs, tables);
    for (const Refusal& refusal : document->finish())
        ADD_FAILURE() << refusal.describe();
    EXPECT_GE(instruments.size(), 3U);
    for (const std::string& key : document->asked_keys()) {
        const std::string name = key.substr(key.rfind('.') + 1);
        const bool table = name == "instrument" || name == "channel";
        EXPECT_TRUE(table || toml.find("\n" + name + " = ") != std::string::npos) << key;
    }
}

} // namespace
} // namespace axiscal
