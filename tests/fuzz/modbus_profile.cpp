// A profile of a Modbus sensor as anybody may have written it, then, behind a zero byte, the words
// that its registers hold: those of the channels, and the same bytes again as those of the
// settings.

#include "drivers/environment/modbus_profile.hpp"
#include "drivers/environment/stated_settings.hpp"
#include "tests/fuzz/judge.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <sys/mman.h>
#include <unistd.h>

using namespace axiscal;

namespace {

/// A file in memory, which a profile is read from by its path.
Result<ModbusProfile> profile_of(std::string_view text) {
    const int file = ::memfd_create("profile", MFD_CLOEXEC);
    fuzz::require(file >= 0 &&
                      ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size()),
                  "a file can be made");
    auto profile = load_profile("/proc/self/fd/" + std::to_string(file));
    ::close(file);
    return profile;
}

void judge_blocks(const std::vector<ModbusField>& fields) {
    std::size_t read = 0;
    for (const RegisterBlock& block : register_blocks(fields)) {
        fuzz::require(block.count >= 1 && block.count <= 125, "a reply holds a block");
        read += block.places.size();
        for (const std::size_t place : block.places) {
            const ModbusField& field = fields.at(place);
            fuzz::require(field.address >= block.address &&
                              field.address + field.count <= block.address + block.count,
                          "a field lies in its block");
        }
    }
    fuzz::require(read == fields.size(), "each field is read once");
}

std::uint16_t word_of(std::string_view bytes, std::size_t i) {
    const auto byte = [&](std::size_t at) {
        return at < bytes.size() ? static_cast<unsigned char>(bytes[at]) : 0U;
    };
    return static_cast<std::uint16_t>(byte(2 * i) << 8 | byte(2 * i + 1));
}

/// Whatever the settings are, a channel without one has its value.
void judge_settings(const ModbusProfile& profile, std::string_view bytes) {
    StatedSettings settings{profile};
    for (const RegisterBlock& block : settings.blocks()) {
        std::vector<std::uint16_t> words;
        for (int i = 0; i < block.count; ++i)
            words.push_back(word_of(bytes, static_cast<std::size_t>(i)));
        settings.take(block, words);
        fuzz::require(settings.take(block, words).empty(), "nothing is told twice");
    }
    for (std::size_t channel = 0; channel < profile.channels.size(); ++channel) {
        bool concerned = false;
        for (const ModbusSetting& setting : profile.settings)
            concerned |= std::ranges::find(setting.channels, channel) != setting.channels.end();
        fuzz::require(concerned || !settings.spoils(channel), "no channel is spoilt by none");
    }
}

void judge_values(const ModbusProfile& profile, std::string_view bytes) {
    std::vector<std::uint16_t> words(4);
    for (const ModbusChannel& channel : profile.channels) {
        const auto count = static_cast<std::size_t>(channel.field.count);
        for (std::size_t i = 0; i < count; ++i)
            words[i] = word_of(bytes, i);
        const auto value = channel_value(std::span{words}.first(count), channel);
        fuzz::require(!value || std::isfinite(*value), "no NaN leaves the decoder");
        bytes.remove_prefix(std::min(bytes.size(), 2 * count));
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto input = fuzz::as_text(data, size);
    const auto end = input.find('\0');
    const auto profile = profile_of(input.substr(0, end));
    if (!profile) {
        fuzz::require(!profile.error().detail.empty(), "a refused profile has a reason");
        return 0;
    }
    judge_blocks(channel_fields(*profile));
    judge_blocks(setting_fields(*profile));
    const auto bytes = end == std::string_view::npos ? std::string_view{} : input.substr(end + 1);
    judge_settings(*profile, bytes);
    judge_values(*profile, bytes);
    return 0;
}
