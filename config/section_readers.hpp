#pragma once
// What the reader of a table of the station file works with, also that of a table that only one
// kind of test has (StationConfig::kind_sections). Pure.

#include "config/station_config.hpp"

#include <any>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

/// Coordinates in the axis's own unit: mm on a linear axis, deg on a rotary one, where 1 mm stands
/// for 1 degree (RunPlan).
class AxisUnits {
public:
    explicit AxisUnits(AxisKind kind)
        : rotary_{kind == AxisKind::rotary} {}
    Length coordinate(Settings& table,
                      std::string_view key,
                      Length low,
                      Length high,
                      std::optional<Length> fallback = {}) const;
    std::optional<Length>
    optional_coordinate(Settings& table, std::string_view key, Length low, Length high) const;
    std::vector<Length>
    coordinates(Settings& table, std::string_view key, Length low, Length high) const;
    Speed speed(Settings& table,
                std::string_view key,
                Speed low,
                Speed high,
                std::optional<Speed> fallback = {}) const;
    /// "1000 mm/min" | "360 deg/min"
    [[nodiscard]] std::string write_speed(Speed speed) const;
    /// "0.7 mm" | "0.7 deg"
    [[nodiscard]] std::string write_coordinate(Length coordinate) const;

private:
    bool rotary_;
};

/// Beyond any axis: 100 m, or 100 000 degrees.
inline constexpr Length farthest = metre(100);

/// Which certificate an instrument, a channel or an artefact has and from when to when it holds;
/// refuses one that ends before it begins. `Certified`: certificate_number, calibrated_on, due_on.
template <class Certified> void read_certificate_dates(Settings& table, Certified& stated) {
    stated.certificate_number = table.text("certificate_number", "");
    stated.calibrated_on = table.date("calibrated_on", "");
    stated.due_on = table.date("due_on", "");
    if (!stated.due_on.empty() && stated.due_on < stated.calibrated_on)
        table.refuse("due_on", "is before calibrated_on: exchange or correct the dates");
}

/// Two keys that say one thing: refuses the second where both are stated.
void refuse_beside(Settings& table, std::string_view first, std::string_view second);

/// The channel named by `key` ("instrument/channel"), checked against [[instrument]].
RoleConfig read_role(Settings& table, std::string_view key, const StationConfig& config);

/// What a kind of test read of its own table. Null: the station file has no such table.
/// @tparam Config  what MeasurementKind::read of this kind returns
template <class Config> const Config* config_of(TestKind kind, const StationConfig& station) {
    for (const KindSection& section : station.kind_sections)
        if (section.kind == kind) return std::any_cast<Config>(&section.config);
    return nullptr;
}

} // namespace axiscal
