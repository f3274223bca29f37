#include "drivers/environment/dracal_line.hpp"

#include "drivers/framing/checksum.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace axiscal {
namespace {

constexpr std::size_t checksum_digits = 4;

struct UnitRow {
    std::string_view unit;
    ChannelKind kind;
    double scale, offset; ///< stored = sent * scale + offset
    double lowest, highest;
};
/// Limits of the air inputs; beyond them a sensor is broken or not connected.
constexpr std::array unit_rows{
    UnitRow{"C", ChannelKind::temperature, 1, 0, -60, 150},
    UnitRow{"K", ChannelKind::temperature, 1, -273.15, -60, 150},
    UnitRow{"F", ChannelKind::temperature, 5.0 / 9, -160.0 / 9, -60, 150},
    UnitRow{"Pa", ChannelKind::pressure, 1, 0, 30e3, 120e3},
    UnitRow{"hPa", ChannelKind::pressure, 100, 0, 30e3, 120e3},
    UnitRow{"mBar", ChannelKind::pressure, 100, 0, 30e3, 120e3},
    UnitRow{"kPa", ChannelKind::pressure, 1000, 0, 30e3, 120e3},
    UnitRow{"%", ChannelKind::humidity, 1, 0, 0, 100},
    UnitRow{"ppm", ChannelKind::carbon_dioxide, 1, 0, 0, 100e3},
};

std::vector<std::string> fields_of(std::string_view text) {
    std::vector<std::string> fields;
    for (;;) {
        const auto comma = text.find(',');
        fields.emplace_back(text.substr(0, comma));
        if (comma == std::string_view::npos) return fields;
        text.remove_prefix(comma + 1);
    }
}

std::optional<double> number(std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = error == std::errc{} && end == text.data() + text.size();
    return whole && std::isfinite(value) ? std::optional{value} : std::nullopt;
}

} // namespace

Result<std::string_view> verify_dracal_line(std::string_view line) {
    const auto star = line.rfind('*');
    if (star == std::string_view::npos || line.size() - star - 1 != checksum_digits)
        return fail(Fault::bad_frame, "a Dracal line without checksum");
    unsigned stated = 0;
    const char* const digits = line.data() + star + 1;
    const auto [end, error] = std::from_chars(digits, digits + checksum_digits, stated, 16);
    if (error != std::errc{} || end != digits + checksum_digits)
        return fail(Fault::bad_frame, "a Dracal checksum that is no number");
    const auto body = line.substr(0, star);
    if (crc16_xmodem(body) != stated) return fail(Fault::checksum, "a damaged Dracal line");
    return body;
}

Result<DracalLine> parse_dracal_line(std::string_view verified) {
    const auto fields = fields_of(verified);
    const bool known = fields[0] == "D" || fields[0] == "I";
    if (!known || fields.size() < 4) return fail(Fault::bad_frame, "an unknown Dracal line");
    DracalLine line{fields[0].front(), fields[1], fields[2], fields[3], {}, {}};
    for (std::size_t at = 4; at + 1 < fields.size(); at += 2) {
        if (line.kind == 'I')
            line.labels.insert(line.labels.end(), {fields[at], fields[at + 1]});
        else
            line.pairs.push_back({number(fields[at]), fields[at + 1]});
    }
    return line;
}

std::optional<StoredReading> stored_reading(const DracalPair& pair) {
    for (const UnitRow& row : unit_rows) {
        if (row.unit != pair.unit) continue;
        if (!pair.value) return StoredReading{row.kind, std::nullopt};
        const double stored = *pair.value * row.scale + row.offset;
        const bool possible = stored >= row.lowest && stored <= row.highest;
        return StoredReading{row.kind, possible ? std::optional{stored} : std::nullopt};
    }
    return std::nullopt;
}

} // namespace axiscal
