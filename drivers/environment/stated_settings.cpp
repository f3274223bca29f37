#include "drivers/environment/stated_settings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace axiscal {
namespace {

std::string number_text(double number) {
    constexpr double exact = 1e15; // a float in the registers may be beyond any whole number
    const bool whole = std::abs(number) < exact && number == std::floor(number);
    return whole ? std::to_string(static_cast<long long>(number)) : std::to_string(number);
}

/// "coil 0x010A": as the profile counts, without the station's address_offset.
std::string place_of(const ModbusField& field) {
    constexpr std::array kinds{"coil", "discrete input", "holding register", "input register"};
    std::array<char, 16> address{};
    std::snprintf(address.data(), address.size(), " 0x%04X", static_cast<unsigned>(field.address));
    return kinds.at(static_cast<std::size_t>(field.function - 1)) + std::string{address.data()};
}

} // namespace

StatedSettings::StatedSettings(const ModbusProfile& profile)
    : model_{profile.model}
    , settings_{profile.settings}
    , blocks_{register_blocks(setting_fields(profile))}
    , seen_(profile.settings.size()) {
    for (const ModbusChannel& channel : profile.channels)
        channels_.push_back(channel.channel.name);
}

void StatedSettings::forget() {
    seen_.assign(settings_.size(), Seen{});
}

std::string StatedSettings::full_name_of(const ModbusSetting& setting) const {
    return model_ + ": " + setting.name + " (" + place_of(setting.field) + ")";
}

std::string StatedSettings::complaint(const ModbusSetting& setting, const std::string& is) const {
    std::string spoilt;
    for (const std::size_t channel : setting.channels)
        spoilt += (spoilt.empty() ? "" : ", ") + channels_.at(channel);
    return full_name_of(setting) + " is " + is + " and must be " + number_text(setting.must_be) +
           ": no value of " + spoilt +
           " meanwhile. Set it there; if the instrument was calibrated with it, state it as "
           "must_be in a copy of the profile";
}

std::vector<std::string> StatedSettings::take(const RegisterBlock& block,
                                              std::span<const std::uint16_t> words) {
    std::vector<std::string> complaints;
    for (const std::size_t place : block.places) {
        const ModbusSetting& setting = settings_.at(place);
        Seen& seen = seen_.at(place);
        const auto number = decode_words(words_of(block, words, setting.field), setting.field);
        if (number == setting.must_be) {
            seen = {State::right, {}};
            continue;
        }
        const bool known = seen.state == State::wrong && seen.number == number;
        seen = {State::wrong, number};
        if (!known)
            complaints.push_back(complaint(setting, number ? number_text(*number) : "no number"));
    }
    return complaints;
}

std::vector<std::string> StatedSettings::refuse(const RegisterBlock& block,
                                                const std::string& reason) {
    std::vector<std::string> complaints;
    for (const std::size_t place : block.places) {
        const ModbusSetting& setting = settings_.at(place);
        Seen& seen = seen_.at(place);
        if (seen.state == State::hidden || (seen.state == State::wrong && !seen.number)) continue;
        const bool never_shown = seen.state == State::unread;
        seen = {never_shown ? State::hidden : State::wrong, {}};
        complaints.push_back(
            never_shown ? full_name_of(setting) +
                              " cannot be read, and is taken as the profile states it: " + reason
                        : complaint(setting, "hidden"));
    }
    return complaints;
}

bool StatedSettings::spoils(std::size_t channel) const {
    for (std::size_t i = 0; i < settings_.size(); ++i) {
        const bool counts = seen_[i].state == State::right || seen_[i].state == State::hidden;
        if (!counts &&
            std::ranges::find(settings_[i].channels, channel) != settings_[i].channels.end())
            return true;
    }
    return false;
}

} // namespace axiscal
