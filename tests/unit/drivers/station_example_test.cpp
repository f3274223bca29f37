// The example station file against the drivers that it names.
#include "config/station_config.hpp"
#include "drivers/registry.hpp"
#include "tests/support/source_dir.hpp"

#include <cstdlib>
#include <gtest/gtest.h>
#include <sstream>
#include <string>
#include <vector>

namespace axiscal::station_example_test {
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
                               text.find("[[" + key + "]]") != std::string::npos;
        EXPECT_TRUE(explained) << key;
    }
}

} // namespace
} // namespace axiscal::station_example_test
