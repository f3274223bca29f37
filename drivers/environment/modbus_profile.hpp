#pragma once
// A Modbus sensor as data: which registers hold what. Pure but for reading the profile's file.

#include "drivers/wire/byte_link.hpp"
#include "drivers/sample.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace axiscal {

enum class WordType : std::uint8_t { s16, u16, s32, u32, f32, bcd, bit };

struct ModbusField {
    int function =
        3; ///< 3 holding, 4 input registers; of a setting also 1 coils, 2 discrete inputs
    int address = 0;  ///< on the wire, from 0
    int count = 1;    ///< registers or bits
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

/// What the instrument can be switched to and must not be: a unit, an own correction, a fault.
struct ModbusSetting {
    std::string name;
    ModbusField field;
    double must_be = 0;                ///< the number in the registers
    std::vector<std::size_t> channels; ///< that have no value while it is another
};

struct ModbusProfile {
    std::string maker, model;
    LinkSettings link; ///< defaults of a serial line
    int unit_id = 1;
    int address_offset = 0; ///< default of the station's key
    Duration poll_period{}, gap{}, timeout{};
    std::vector<ModbusChannel> channels;
    std::vector<ModbusSetting> settings;
    std::optional<ModbusField> serial_number; ///< BCD or whole number
};

/// The number in the registers, before scale; empty for a BCD digit above 9 or a float that is no
/// number.
std::optional<double> decode_words(std::span<const std::uint16_t> words, const ModbusField& field);

/// The channel's value in its stored unit; empty when invalid or impossible.
std::optional<double> channel_value(std::span<const std::uint16_t> words,
                                    const ModbusChannel& channel);

/// Registers that are read at once. `places` are those of the fields that it holds.
struct RegisterBlock {
    int function = 3, address = 0, count = 0;
    std::vector<std::size_t> places;
};
/// Neighbouring registers of one function join into one block; gaps are never read across, since
/// instruments answer unknown addresses with an exception.
std::vector<RegisterBlock> register_blocks(const std::vector<ModbusField>& fields);

std::vector<ModbusField> channel_fields(const ModbusProfile& profile);
std::vector<ModbusField> setting_fields(const ModbusProfile& profile);

/// The words of one field among those of its block.
std::span<const std::uint16_t> words_of(const RegisterBlock& block,
                                        std::span<const std::uint16_t> words,
                                        const ModbusField& field);

/// Reads a profile file. @errors Fault::bad_configuration with every refusal, or not found.
Result<ModbusProfile> load_profile(const std::string& path);

/// `name` with a '/' or ".toml" is a path; otherwise "<name>.toml" in one of `folders`.
/// @errors Fault::not_found naming the folders and the profiles that are there.
Result<std::string> find_profile(const std::string& name, const std::vector<std::string>& folders);

/// $AXISCAL_PROFILE_PATH (folders separated by ':'), then ../share/axiscal/profiles of the program.
std::vector<std::string> profile_folders();

} // namespace axiscal
