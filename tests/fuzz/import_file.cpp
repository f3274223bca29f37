// `axiscal import`: a file of another program, without a map and by each kind of map. It is refused
// with a reason, or becomes a case whose every reading is a number.

#include "tools/axiscal/imports/import_file.hpp"
#include "tests/fuzz/judge.hpp"
#include "tools/axiscal/imports/judged_report.hpp"

#include <array>

using namespace axiscal;

namespace {

constexpr const char* stream_map = R"(kind = "stream"
unit = "mm"
[reading]
signal = "R"
take = "mean"
before = "1 s"
[target]
signal = "T"
[capture]
signal = "C"
digits = "dcp"
forward = 1
backward = 2
)";

constexpr const char* table_map = R"(kind = "table"
readings = "deviations"
unit = "um"
target_unit = "mm"
[columns]
target = "Soll"
reading = "3"
direction = "Richtung"
[direction]
forward = ["auf"]
backward = ["ab"]
)";

/// 100 counts a millimetre.
constexpr const char* umd_map_text = R"(kind = "umd"
[counts]
per_metre = 100_000
rate_Hz = 10
[standstill]
targets = ["0 mm", "5 mm"]
cycle = "standard"
approaches = 1
bidirectional = true
overrun = "1 mm"
datum = "-2 mm"
window = "0.5 s"
spread_limit = "20 um"
minimum_samples = 3
)";

constexpr const char* standing_map = R"(kind = "stream"
unit = "mm"
[reading]
signal = "R"
[standstill]
targets = ["0 mm", "5 mm"]
cycle = "standard"
approaches = 1
bidirectional = false
overrun = "1 mm"
window = "0.5 s"
spread_limit = "20 um"
minimum_samples = 3
)";

void judge(std::string_view bytes, const std::optional<ImportMap>& map) {
    const auto file = import_file(bytes, map);
    if (!file) return fuzz::require(!file.error().detail.empty(), "a refusal has a reason");
    if (file->document.value("analysis", "") != "positioning" || !map) return;
    for (const auto& row : file->document.at("forward"))
        for (const auto& reading : row)
            fuzz::require(reading.is_number(), "a reading is a number");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::array<std::optional<ImportMap>, 5> maps{
        std::nullopt, import_map(stream_map, "stream.toml").value(),
        import_map(table_map, "table.toml").value(), import_map(umd_map_text, "umd.toml").value(),
        import_map(standing_map, "standing.toml").value()};
    const std::string_view bytes = fuzz::as_text(data, size);
    for (const auto& map : maps)
        judge(bytes, map);
    static const auto document = nlohmann::json::parse(
        R"({"analysis":"positioning","standard":"ISO 230-2:2014","axis":{"name":"X","kind":"linear"},"unit":"mm","readings":"deviations","targets":[0,9],"forward":[[0,1],[2,3]],"backward":[[1,1],[2,2]]})");
    const auto report = nlohmann::json::parse(bytes, nullptr, false);
    if (const auto answer = judge_report(document, report); !answer)
        fuzz::require(!answer.error().detail.empty(), "a refusal has a reason");
    (void)judge_report(report, report);
    return 0;
}
