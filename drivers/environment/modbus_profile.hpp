#pragma once
// A Modbus sensor as data: which registers hold what. Pure but for reading the profile's file.

#include "drivers/link/byte_link.hpp"
#include "drivers/sample.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace axiscal {

enum class WordType : std::uint8_t { s16, u16, s32, u32, f32, bcd };

struct ModbusField {
    int function = 3; ///< 3 holding, 4 input registers
    int address = 0;  ///< on the wire, from 0
    int count = 1;    ///< registers
    WordType type = WordType::s16;
    bool low_word_first = false;
};

struct ModbusChannel {
    Channel channel;
    ModbusField field;
    double scale = 1, offset = 0;               ///< of the number in the registers, in `unit`
    double stored_scale = 1, stored_offset = 0; ///< from `unit` to the stored unit
    std::vector<double> invalid;                ///< register numbers that mean "no value"
    std::optional<double> lowest, highest;      ///< possible values in `unit`
};

struct ModbusProfile {
    std::string maker, model;
    LinkSettings link; ///< defaults of a serial line
    int unit_id = 1;
    int address_offset = 0; ///< default of the station's key
    Duration poll_period{}, gap{}, timeout{};
    std::vector<ModbusChannel> channels;
    std::optional<ModbusField> serial_number; ///< BCD or whole number
};

/// The number in the registers, before scale; empty for a BCD digit above 9 or a float that is no
/// number.
std::optional<double> decode_words(std::span<const std::uint16_t> words, const ModbusField& field);

/// The channel's value in its stored unit; empty when invalid or impossible.
std::optional<double> channel_value(std::span<const std::uint16_t> words,
                                    const ModbusChannel& channel);

/// Registers that are read at once. `channels` are places in ModbusProfile::channels.
struct RegisterBlock {
    int function = 3, address = 0, count = 0;
    std::vector<std::size_t> channels;
};
/// Neighbouring registers of one function join into one block; gaps are never read across, since
/// instruments answer unknown addresses with an exception.
std::vector<RegisterBlock> register_blocks(const ModbusProfile& profile);

/// Reads a profile file. @errors Fault::bad_configuration with every refusal, or not found.
Result<ModbusProfile> load_profile(const std::string& path);

/// `name` with a '/' or ".toml" is a path; otherwise "<name>.toml" in one of `folders`.
/// @errors Fault::not_found naming the folders and the profiles that are there.
Result<std::string> find_profile(const std::string& name, const std::vector<std::string>& folders);

/// $AXISCAL_PROFILE_PATH (folders separated by ':'), then ../share/axiscal/profiles of the program.
std::vector<std::string> profile_folders();

} // namespace axiscal
