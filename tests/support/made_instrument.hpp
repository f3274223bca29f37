#pragma once
// An instrument as the registry makes it from its lines in the station file.

#include "drivers/registry.hpp"

#include <gtest/gtest.h>

#include <string>

namespace axiscal::testing {

struct MadeInstrument {
    std::unique_ptr<Instrument> instrument;
    std::vector<Refusal> refusals;
};

inline MadeInstrument
make_instrument(const std::string& driver, const std::string& keys, InstrumentConfig config = {}) {
    auto document = SettingsDocument::parse(keys, "station.toml").value();
    std::vector<Settings> options{document.root()};
    config.driver = driver;
    MadeInstrument made;
    made.instrument = std::move(make_instruments({config}, options).front());
    made.refusals = document.finish();
    return made;
}

/// The station-file keys are right here: a refusal fails the test.
inline std::unique_ptr<Instrument> instrument(const std::string& driver, const std::string& keys) {
    auto made = make_instrument(driver, keys);
    for (const Refusal& refusal : made.refusals)
        ADD_FAILURE() << refusal.describe();
    return std::move(made.instrument);
}

} // namespace axiscal::testing
