#pragma once
// Whether an instrument is set as its profile states, where its registers tell. Pure.

#include "drivers/environment/modbus_profile.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace axiscal {

/// Each setting is read before each round of values. Until it is known to be right, and while it is
/// another, its channels have no value. An instrument that never shows a setting is taken as its
/// profile states it, and this is told.
class StatedSettings {
public:
    explicit StatedSettings(const ModbusProfile& profile);

    /// The instrument was opened anew: nothing is known, and everything is told again.
    void forget();
    [[nodiscard]] const std::vector<RegisterBlock>& blocks() const { return blocks_; }

    /// @param words of the whole `block`
    /// @returns what is to be told: each setting that became wrong, or wrong in another way
    std::vector<std::string> take(const RegisterBlock& block, std::span<const std::uint16_t> words);
    /// @param reason the instrument's, for not showing `block`
    std::vector<std::string> refuse(const RegisterBlock& block, const std::string& reason);

    /// Whether a value of this channel, a place in ModbusProfile::channels, counts as none.
    [[nodiscard]] bool spoils(std::size_t channel) const;

private:
    enum class State : std::uint8_t { unread, right, wrong, hidden };
    struct Seen {
        State state = State::unread;
        std::optional<double> number; ///< the last that was told as wrong
    };
    [[nodiscard]] std::string full_name_of(const ModbusSetting& setting) const;
    [[nodiscard]] std::string complaint(const ModbusSetting& setting, const std::string& is) const;

    std::string model_;
    std::vector<std::string> channels_;
    std::vector<ModbusSetting> settings_;
    std::vector<RegisterBlock> blocks_;
    std::vector<Seen> seen_;
};

} // namespace axiscal
