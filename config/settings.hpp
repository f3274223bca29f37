#pragma once
// Typed, unit-aware reading of a TOML document. Every refusal is collected with file:line; every
// key that nobody read is refused at the end with its nearest known neighbour. Pure after loading.

#include "analysis/quantity/quantity.hpp"
#include "analysis/quantity/result.hpp"
#include "analysis/quantity/temperature.hpp"
#include "analysis/quantity/time.hpp"
#include "analysis/record/run_record.hpp"

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

struct Refusal {
    std::string file;
    int line = 0;
    std::string key;                            ///< `instrument "laser".wavelength`
    std::string reason;                         ///< what is wrong and what would be right
    [[nodiscard]] std::string describe() const; ///< "file:line: key: reason"
};

/// "2026-11-21", a day of the calendar.
bool is_calendar_date(std::string_view text);

class SettingsDocument;

/// "-0.05 K" as stored: amount in `stored_unit` (degC, Pa, %, ppm); unit empty when not stated.
struct ChannelCorrection {
    double amount = 0;
    std::string stored_unit;
};

/// The expanded uncertainty of a channel: in its stored unit (degC, Pa, %, ppm, m), or m for each
/// metre. Both empty when not stated.
struct ChannelUncertainty {
    std::optional<double> amount, per_metre;
    std::string stored_unit;
};

/// One table of the document. Copyable view; the document must outlive it.
/// Each reader takes an optional fallback: without it a missing key is refused.
/// Units stand in the value ("0.5 mm"); a bare number where a unit is needed is refused with the
/// list.
class Settings {
public:
    /// One line: an escaped control character becomes a space (valid_text).
    std::string text(std::string_view key, const std::optional<std::string>& fallback = {});
    /// One of `allowed`; a near match is offered.
    std::string choice(std::string_view key,
                       const std::vector<std::string>& allowed,
                       const std::optional<std::string>& fallback = {});
    std::int64_t integer(std::string_view key,
                         std::int64_t low,
                         std::int64_t high,
                         std::optional<std::int64_t> fallback = {});
    double
    number(std::string_view key, double low, double high, std::optional<double> fallback = {});
    bool flag(std::string_view key, std::optional<bool> fallback = {});
    Length
    length(std::string_view key, Length low, Length high, std::optional<Length> fallback = {});
    /// Of a rotary axis, where 1 mm stands for 1 degree: deg, arcmin, arcsec; deg/min, deg/s.
    Length rotary_length(std::string_view key,
                         Length low,
                         Length high,
                         std::optional<Length> fallback = {});
    std::vector<Length> rotary_lengths(std::string_view key,
                                       Length low,
                                       Length high,
                                       const std::optional<std::vector<Length>>& fallback = {});
    Speed
    rotary_speed(std::string_view key, Speed low, Speed high, std::optional<Speed> fallback = {});
    Speed speed(std::string_view key, Speed low, Speed high, std::optional<Speed> fallback = {});
    Duration duration(std::string_view key,
                      Duration low,
                      Duration high,
                      std::optional<Duration> fallback = {});
    Temperature temperature(std::string_view key,
                            Temperature low,
                            Temperature high,
                            std::optional<Temperature> fallback = {});
    TemperatureDifference
    temperature_difference(std::string_view key,
                           TemperatureDifference low,
                           TemperatureDifference high,
                           std::optional<TemperatureDifference> fallback = {});
    Pressure pressure(std::string_view key,
                      Pressure low,
                      Pressure high,
                      std::optional<Pressure> fallback = {});
    Ratio ratio(std::string_view key, Ratio low, Ratio high, std::optional<Ratio> fallback = {});
    Expansion expansion(std::string_view key,
                        Expansion low,
                        Expansion high,
                        std::optional<Expansion> fallback = {});
    Angle angle(std::string_view key, Angle low, Angle high, std::optional<Angle> fallback = {});
    /// "0.5 um", or "0.7 um/m" of the length; from 0 to 1 mm, or 1 mm/m. None when missing.
    DeviceLimit device_limit(std::string_view key);
    /// Additive correction of a channel, at most `limit` in stored units; none when missing.
    ChannelCorrection correction(std::string_view key, double limit);
    /// A value that a channel may show, in its stored unit: "15 degC", "1013 hPa", "45 %".
    ChannelCorrection channel_reading(std::string_view key);
    /// "0.05 K", "0.1 hPa", "0.3 um", "0.7 um/m"; not negative.
    ChannelUncertainty channel_uncertainty(std::string_view key);
    /// ISO date "2026-11-21"; a TOML local date is accepted too, and `or_word` where one is given.
    std::string date(std::string_view key,
                     const std::optional<std::string>& fallback = {},
                     std::string_view or_word = {});
    std::vector<std::string> texts(std::string_view key,
                                   const std::optional<std::vector<std::string>>& fallback = {});
    std::vector<Length> lengths(std::string_view key,
                                Length low,
                                Length high,
                                const std::optional<std::vector<Length>>& fallback = {});

    [[nodiscard]] bool has(std::string_view key) const;
    /// Sub-table; a missing one reads as empty (its required keys are then refused).
    Settings table(std::string_view key);
    /// Array of tables ([[instrument]]); empty when missing.
    std::vector<Settings> tables(std::string_view key);
    /// A refusal of one's own, placed at `key` (or at the table when empty).
    void refuse(std::string_view key, std::string reason);
    /// A refusal stands at this key: its value means nothing and needs no further check.
    [[nodiscard]] bool refused(std::string_view key) const;
    /// Keys that nobody read are no refusal in this table (its reader does not exist).
    void accept_rest();
    [[nodiscard]] int line() const;
    [[nodiscard]] int line_of(std::string_view key) const;
    [[nodiscard]] const std::string& path() const; ///< "instrument[1]", counted from 0

private:
    friend class SettingsDocument;
    struct Impl;
    explicit Settings(std::shared_ptr<Impl> impl);
    std::shared_ptr<Impl> impl_;
};

/// A parsed file and the refusals gathered while it is read.
class SettingsDocument {
public:
    /// @errors Fault::bad_configuration with file:line for unreadable or syntactically wrong files.
    static Result<SettingsDocument> load(const std::string& path);
    static Result<SettingsDocument> parse(std::string text, std::string name);

    [[nodiscard]] Settings root() const;
    [[nodiscard]] const std::string& source_text() const;
    [[nodiscard]] const std::string& name() const;
    /// Adds a refusal for every key nobody read, then hands over all of them, by line. Once more:
    /// those that came since.
    std::vector<Refusal> finish();
    /// Every key asked for so far, "cycle.overrun" (list indices left out), sorted, once each.
    [[nodiscard]] std::vector<std::string> asked_keys() const;

private:
    struct State;
    friend class Settings;
    explicit SettingsDocument(std::shared_ptr<State> state);
    std::shared_ptr<State> state_;
};

} // namespace axiscal
