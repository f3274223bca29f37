#include "config/settings_state.hpp"

#include <cmath>

namespace axiscal {
namespace {

std::optional<double> si_of(const auto& fallback) {
    return fallback ? std::optional<double>{fallback->si()} : std::nullopt;
}

} // namespace

double Settings::Impl::measure_node(const std::string& key,
                                    const TomlNode& value,
                                    const Measure& measure,
                                    Range range,
                                    double stand_in,
                                    UnitName* unit) {
    const std::string example = in_quotes(example_of(measure, range.low, range.high));
    const auto refuse_here = [&](std::string reason) {
        state->refuse(joined_path(path, key), value.line, std::move(reason));
        return stand_in;
    };
    const std::string way_out = "; units: " + list_units(measure) + "; for example " + example;
    if (std::holds_alternative<std::int64_t>(value.value) ||
        std::holds_alternative<double>(value.value))
        return refuse_here("is a bare number, but " + std::string{measure.what} +
                           " needs its unit in the value" + way_out);
    const auto* text = std::get_if<std::string>(&value.value);
    if (!text)
        return refuse_here("is " + std::string{kind_of(value)} + ", but " +
                           std::string{measure.what} + " is wanted" + way_out);
    const auto read = read_measure(*text, measure);
    if (!read) return refuse_here(read.error().detail + way_out);
    if (!within(read->si, range.low, range.high))
        return refuse_here(in_quotes(*text) + " is out of range: from " +
                           write_measure(range.low, read->unit) + " to " +
                           write_measure(range.high, read->unit));
    if (unit) *unit = read->unit;
    return read->si;
}

double Settings::Impl::measured(std::string_view key,
                                const Measure& measure,
                                Range range,
                                std::optional<double> fallback,
                                UnitName* unit) {
    const TomlNode* value = ask(key);
    const double stand_in = fallback.value_or(range.low);
    if (value) return measure_node(std::string{key}, *value, measure, range, stand_in, unit);
    if (!fallback) refuse_missing(key, in_quotes(example_of(measure, range.low, range.high)));
    return stand_in;
}

std::vector<Length>
Settings::Impl::measured_list(std::string_view key,
                              const Measure& measure,
                              Range range,
                              const std::optional<std::vector<Length>>& fallback) {
    const std::string example = "[" + in_quotes(example_of(measure, range.low, range.high)) + "]";
    const TomlNode* value = ask(key);
    if (!value && !fallback) refuse_missing(key, example);
    if (!value) return fallback.value_or(std::vector<Length>{});
    const auto* items = std::get_if<TomlArray>(&value->value);
    if (!items) return refuse_kind(key, *value, "a list", example), std::vector<Length>{};
    std::vector<Length> lengths;
    for (std::size_t i = 0; i < items->size(); ++i) {
        const std::string place = std::string{key} + "[" + std::to_string(i) + "]";
        lengths.push_back(
            Length::from_si(measure_node(place, (*items)[i], measure, range, range.low)));
        if (state->refused.contains(joined_path(path, place)))
            state->refused.insert(joined_path(path, key));
    }
    return lengths;
}

// Readers with a unit: one line each over Impl::measured.

Length Settings::length(std::string_view key, Length low, Length high, std::optional<Length> f) {
    return Length::from_si(impl_->measured(key, length_measure, {low.si(), high.si()}, si_of(f)));
}
Length
Settings::rotary_length(std::string_view key, Length low, Length high, std::optional<Length> f) {
    return Length::from_si(impl_->measured(key, rotary_measure, {low.si(), high.si()}, si_of(f)));
}
Speed Settings::speed(std::string_view key, Speed low, Speed high, std::optional<Speed> f) {
    return Speed::from_si(impl_->measured(key, speed_measure, {low.si(), high.si()}, si_of(f)));
}
Speed Settings::rotary_speed(std::string_view key, Speed low, Speed high, std::optional<Speed> f) {
    return Speed::from_si(
        impl_->measured(key, rotary_speed_measure, {low.si(), high.si()}, si_of(f)));
}
Duration
Settings::duration(std::string_view key, Duration low, Duration high, std::optional<Duration> f) {
    const double seconds =
        impl_->measured(key, duration_measure, {seconds_of(low), seconds_of(high)},
                        f ? std::optional<double>{seconds_of(*f)} : std::nullopt);
    return Duration{std::llround(seconds * 1e9)};
}
Temperature Settings::temperature(std::string_view key,
                                  Temperature low,
                                  Temperature high,
                                  std::optional<Temperature> f) {
    return Temperature::celsius(
        impl_->measured(key, temperature_measure, {low.in_celsius(), high.in_celsius()},
                        f ? std::optional<double>{f->in_celsius()} : std::nullopt));
}
TemperatureDifference Settings::temperature_difference(std::string_view key,
                                                       TemperatureDifference low,
                                                       TemperatureDifference high,
                                                       std::optional<TemperatureDifference> f) {
    return TemperatureDifference::from_si(
        impl_->measured(key, temperature_difference_measure, {low.si(), high.si()}, si_of(f)));
}
Pressure
Settings::pressure(std::string_view key, Pressure low, Pressure high, std::optional<Pressure> f) {
    return Pressure::from_si(
        impl_->measured(key, pressure_measure, {low.si(), high.si()}, si_of(f)));
}
Ratio Settings::ratio(std::string_view key, Ratio low, Ratio high, std::optional<Ratio> f) {
    return Ratio::from_si(impl_->measured(key, ratio_measure, {low.si(), high.si()}, si_of(f)));
}
Expansion Settings::expansion(std::string_view key,
                              Expansion low,
                              Expansion high,
                              std::optional<Expansion> f) {
    return Expansion::from_si(
        impl_->measured(key, expansion_measure, {low.si(), high.si()}, si_of(f)));
}
Angle Settings::angle(std::string_view key, Angle low, Angle high, std::optional<Angle> f) {
    return Angle::from_si(impl_->measured(key, angle_measure, {low.si(), high.si()}, si_of(f)));
}
std::vector<Length> Settings::lengths(std::string_view key,
                                      Length low,
                                      Length high,
                                      const std::optional<std::vector<Length>>& f) {
    return impl_->measured_list(key, length_measure, {low.si(), high.si()}, f);
}
std::vector<Length> Settings::rotary_lengths(std::string_view key,
                                             Length low,
                                             Length high,
                                             const std::optional<std::vector<Length>>& f) {
    return impl_->measured_list(key, rotary_measure, {low.si(), high.si()}, f);
}

DeviceLimit Settings::device_limit(std::string_view key) {
    constexpr double largest = 1e-3; // m, or m/m
    UnitName unit;
    const double amount = impl_->measured(key, device_limit_measure, {0, largest}, 0.0, &unit);
    if (unit.name.empty()) return {};
    if (unit.name == "ppm" || unit.name.ends_with("/m"))
        return {std::nullopt, Ratio::from_si(amount)};
    return {Length::from_si(amount), std::nullopt};
}

namespace {

/// Of temperatures, pressures, shares and lengths, as channels store them.
std::string stored_unit_named(std::string_view unit) {
    if (unit == "%" || unit == "ppm") return std::string{unit};
    if (unit.ends_with("m")) return "m";
    return unit.ends_with("a") || unit == "mbar" ? "Pa" : "degC";
}

} // namespace

ChannelCorrection Settings::correction(std::string_view key, double limit) {
    UnitName unit;
    const double amount = impl_->measured(key, correction_measure, {-limit, limit}, 0.0, &unit);
    if (unit.name.empty()) return {};
    return {amount, stored_unit_named(unit.name)};
}

ChannelCorrection Settings::channel_reading(std::string_view key) {
    constexpr double beyond_any = 1e7; // Pa, the largest numbers of all stored units
    UnitName unit;
    const double amount = impl_->measured(key, channel_reading_measure, {-beyond_any, beyond_any},
                                          std::nullopt, &unit);
    if (unit.name.empty()) return {};
    return {amount, stored_unit_named(unit.name)};
}

ChannelUncertainty Settings::channel_uncertainty(std::string_view key) {
    constexpr double largest = 5000; // as of corrections
    UnitName unit;
    const double amount =
        impl_->measured(key, channel_uncertainty_measure, {0, largest}, 0.0, &unit);
    if (unit.name.empty()) return {};
    if (unit.name.ends_with("/m")) return {std::nullopt, amount, "m"};
    return {amount, std::nullopt, stored_unit_named(unit.name)};
}

} // namespace axiscal
