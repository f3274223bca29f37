#include "tools/axiscal/imports/import_map.hpp"

#include "config/settings.hpp"
#include "tools/axiscal/imports/standstill_map.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace axiscal {
namespace {

constexpr double largest = 1e9;

std::string name_in(Settings& table, const char* key) {
    std::string name = table.text(key);
    if (name.empty() && !table.refused(key)) table.refuse(key, "must not be empty");
    return name;
}

TableMap table_map(Settings root) {
    TableMap map;
    map.sheet = root.text("sheet", "");
    Settings columns = root.table("columns");
    map.target = name_in(columns, "target");
    if (columns.has("forward")) {
        map.forward_columns = columns.texts("forward");
        map.backward_columns = columns.texts("backward", std::vector<std::string>{});
        if (map.forward_columns.empty()) columns.refuse("forward", "names no column");
        return map;
    }
    map.reading = name_in(columns, "reading");
    map.run = columns.text("run", "");
    map.direction = columns.text("direction", "");
    if (map.direction.empty()) return map;
    Settings words = root.table("direction");
    map.forward = words.texts("forward");
    map.backward = words.texts("backward", std::vector<std::string>{});
    return map;
}

void read_window(Settings& reading, StreamMap& map) {
    const bool mean = reading.choice("take", {"last", "mean"}) == "mean";
    if (!mean) return;
    constexpr Duration longest = std::chrono::hours{1};
    map.before = reading.duration("before", Duration{}, longest);
    map.after = reading.duration("after", Duration{}, longest, Duration{});
}

void read_targets(Settings target, AxisKind kind, const std::string& unit, StreamMap& map) {
    map.target = target.text("signal", "");
    if (!map.target.empty()) return;
    const Length low = mm(-largest), high = mm(largest);
    const auto places = kind == AxisKind::linear ? target.lengths("places", low, high)
                                                 : target.rotary_lengths("places", low, high);
    const double millimetres = millimetres_in(unit);
    for (const Length place : places)
        map.places.push_back(place.in(mm) / millimetres);
}

void read_capture(Settings capture, StreamMap& map) {
    map.capture = name_in(capture, "signal");
    map.digits = capture.text("digits", "");
    const auto is_meaning = [](char letter) {
        return std::string_view{"dcp-"}.find(letter) != std::string_view::npos;
    };
    if (!std::ranges::all_of(map.digits, is_meaning) || map.digits.size() > 9)
        capture.refuse("digits", "has a letter for each digit of the number: d direction, c cycle, "
                                 "p position, - nothing; \"dcpp\" of 1304");
    const bool numbers_places = map.digits.find('p') != std::string::npos;
    if (!map.places.empty() && !numbers_places)
        capture.refuse("digits", "must say where the position stands (p), because the targets are "
                                 "listed under places; or name the signal of the target");
    if (map.digits.find('d') == std::string::npos) return;
    map.forward = static_cast<int>(capture.integer("forward", 0, 9));
    map.backward = static_cast<int>(capture.integer("backward", 0, 9));
    if (map.forward == map.backward) capture.refuse("backward", "is the digit of forward as well");
}

StreamMap stream_map(Settings root) {
    StreamMap map;
    Settings reading = root.table("reading");
    map.reading = name_in(reading, "signal");
    map.scale = reading.number("scale", -largest, largest, 1.0);
    map.offset = reading.number("offset", -largest, largest, 0.0);
    if (map.scale == 0) reading.refuse("scale", "must not be 0");
    if (!root.has("standstill")) read_window(reading, map); // which has a window of its own
    return map;
}

enum class MapKind : std::uint8_t { table, stream, umd };

MapKind kind_in(Settings& root) {
    const std::string word = root.choice("kind", {"table", "stream", "umd"});
    if (word == "umd") return MapKind::umd;
    return word == "stream" ? MapKind::stream : MapKind::table;
}

/// Captures by a number that changes, or where the axis stands.
StreamMap whole_stream_map(Settings root, AxisKind kind, const std::string& unit) {
    StreamMap map = stream_map(root);
    if (root.has("standstill")) {
        map.stops = standstill_map(root.table("standstill"), kind);
        return map;
    }
    read_targets(root.table("target"), kind, unit, map);
    read_capture(root.table("capture"), map);
    return map;
}

/// What readings and targets are measured in.
void read_units(Settings& root, MapKind kind, ImportMap& map) {
    const bool linear = map.kind == AxisKind::linear;
    const std::vector<std::string> units = linear ? std::vector<std::string>{"mm", "um", "m"}
                                                  : std::vector<std::string>{"deg", "arcsec"};
    map.unit = root.choice("unit", units);
    map.positions = kind == MapKind::stream ||
                    root.choice("readings", {"positions", "deviations"}) == "positions";
    map.target_unit = root.choice("target_unit", units, map.unit);
    if (map.positions && map.target_unit != map.unit)
        root.refuse("target_unit", "is not that of the readings, which are positions");
}

} // namespace

double millimetres_in(const std::string& unit) {
    if (unit == "um") return 1e-3;
    if (unit == "m") return 1e3;
    return unit == "arcsec" ? 1.0 / 3600 : 1;
}

Result<ImportMap> import_map(std::string text, std::string name) {
    AXISCAL_TRY(SettingsDocument document,
                SettingsDocument::parse(std::move(text), std::move(name)));
    Settings root = document.root();
    ImportMap map;
    const MapKind kind = kind_in(root);
    map.axis = root.text("axis", "");
    const bool linear = root.choice("axis_kind", {"linear", "rotary"}, "linear") == "linear";
    map.kind = linear ? AxisKind::linear : AxisKind::rotary;
    if (kind != MapKind::umd) read_units(root, kind, map); // counts have none
    if (kind == MapKind::umd)
        map.of = umd_map(root, map.kind);
    else if (kind == MapKind::stream)
        map.of = whole_stream_map(root, map.kind, map.unit);
    else
        map.of = table_map(root);
    const auto refusals = document.finish();
    if (!refusals.empty()) return fail(Fault::bad_configuration, refusals.front().describe());
    return map;
}

} // namespace axiscal
