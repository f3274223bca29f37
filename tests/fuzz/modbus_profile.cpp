// A profile of a Modbus sensor as anybody may have written it, then, behind a zero byte, the words
// that its registers hold.

#include "drivers/environment/modbus_profile.hpp"
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

void judge_blocks(const ModbusProfile& profile) {
    std::size_t channels = 0;
    for (const RegisterBlock& block : register_blocks(profile)) {
        fuzz::require(block.count >= 1 && block.count <= 125, "a reply holds a block");
        channels += block.channels.size();
        for (const std::size_t place : block.channels) {
            const ModbusField& field = profile.channels.at(place).field;
            fuzz::require(field.address >= block.address &&
                              field.address + field.count <= block.address + block.count,
                          "a channel lies in its block");
        }
    }
    fuzz::require(channels == profile.channels.size(), "each channel is read once");
}

void judge_values(const ModbusProfile& profile, std::string_view bytes) {
    std::vector<std::uint16_t> words(4);
    for (const ModbusChannel& channel : profile.channels) {
        const auto count = static_cast<std::size_t>(channel.field.count);
        for (std::size_t i = 0; i < count; ++i) {
            const unsigned high =
                bytes.size() > 2 * i ? static_cast<unsigned char>(bytes[2 * i]) : 0;
            const unsigned low =
                bytes.size() > 2 * i + 1 ? static_cast<unsigned char>(bytes[2 * i + 1]) : 0;
            words[i] = static_cast<std::uint16_t>(high << 8 | low);
        }
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
    judge_blocks(*profile);
    judge_values(*profile, end == std::string_view::npos ? "" : input.substr(end + 1));
    return 0;
}
