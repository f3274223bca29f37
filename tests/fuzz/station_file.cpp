// A station file as anybody may have written it: refused by name and line, or read.

#include "config/station_config.hpp"
#include "tests/fuzz/judge.hpp"

#include <cmath>

using namespace axiscal;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    auto document = SettingsDocument::parse(std::string{fuzz::as_text(data, size)}, "station.toml");
    if (!document) {
        fuzz::require(!document.error().detail.empty(), "a refused file has a reason");
        return 0;
    }
    StationConfig config = read_station(*document);
    for (Settings& options : config.instrument_options)
        options.accept_rest();
    for (KindSection& section : config.kind_sections)
        section.table.accept_rest();
    const auto refusals = document->finish();
    for (const auto& refusal : refusals)
        fuzz::require(!refusal.reason.empty(), "a refusal has a reason");
    if (!refusals.empty()) return 0;
    fuzz::require(config.cycle.approaches >= 1, "a cycle has an approach");
    fuzz::require(std::isfinite(config.cycle.travel_high.si()), "no NaN in the station");
    fuzz::require(config.instruments.size() == config.instrument_options.size(),
                  "each instrument has its options");
    return 0;
}
