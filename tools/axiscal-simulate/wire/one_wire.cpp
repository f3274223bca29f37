// Source: Maxim DS18B20 data sheet 19-7487 (ROM and function commands, memory map, power-on value,
// configuration register) and application note 27 (CRC).
#include "wire/one_wire.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace axiscal::simulate {

namespace {

constexpr std::uint8_t ds18b20_family = 0x28;
enum RomCommand : std::uint8_t { match_rom = 0x55, skip_rom = 0xCC };
enum Command : std::uint8_t { convert_t = 0x44, write_scratchpad = 0x4E, read_scratchpad = 0xBE };
constexpr std::uint8_t silent = 0xFF;                         // nobody pulls the wire down
constexpr std::size_t first_writable = 2, after_writable = 5; // TH, TL, configuration
constexpr double sixteenths = 16;

} // namespace

std::uint8_t one_wire_crc8(const std::uint8_t* bytes, std::size_t count) {
    unsigned crc = 0;
    for (std::size_t i = 0; i < count; ++i) {
        crc ^= bytes[i];
        for (int bit = 0; bit < 8; ++bit)
            crc = (crc & 1U) != 0 ? (crc >> 1) ^ 0x8CU : crc >> 1;
    }
    return static_cast<std::uint8_t>(crc);
}

OneWireRom one_wire_rom(std::uint8_t family, std::uint64_t serial) {
    OneWireRom rom{family};
    for (std::size_t i = 0; i < 6; ++i)
        rom[1 + i] = static_cast<std::uint8_t>(serial >> (8 * i) & 0xFF);
    rom[7] = one_wire_crc8(rom.data(), 7);
    return rom;
}

Ds18b20Chip::Ds18b20Chip(std::uint64_t serial, int bits, std::function<double()> celsius)
    : rom_{one_wire_rom(ds18b20_family, serial)}
    , configuration_{static_cast<std::uint8_t>((bits - 9) << 5 | 0x1F)}
    , celsius_{std::move(celsius)} {
    power_on();
}

/// 85 degC, alarms and configuration from EEPROM, the reserved bytes as every chip shows them.
void Ds18b20Chip::power_on() {
    scratchpad_ = {0x50, 0x05, 0x4B, 0x46, configuration_, 0xFF, 0x0C, 0x10, 0};
    close_scratchpad();
}

void Ds18b20Chip::close_scratchpad() {
    scratchpad_[8] = one_wire_crc8(scratchpad_.data(), 8);
}

/// Bits below the resolution stay 0. Done at once: the master waits its time all the same.
void Ds18b20Chip::convert() {
    if (trouble_ == OneWireTrouble::power_lost) return power_on();
    const long raw = std::lround(std::clamp(celsius_(), -55.0, 125.0) * sixteenths);
    const int unused = 3 - (scratchpad_[4] >> 5);
    const auto word = static_cast<std::uint16_t>((raw >> unused) * (1L << unused));
    scratchpad_[0] = static_cast<std::uint8_t>(word & 0xFF);
    scratchpad_[1] = static_cast<std::uint8_t>(word >> 8);
    close_scratchpad();
}

void Ds18b20Chip::reset() {
    step_ = Step::rom_command;
    at_ = 0;
}

void Ds18b20Chip::obey(std::uint8_t command) {
    at_ = 0;
    step_ = Step::deaf;
    switch (command) {
    case convert_t: return convert();
    case read_scratchpad: step_ = Step::read; return;
    case write_scratchpad:
        step_ = Step::write;
        at_ = first_writable;
        return;
    default: return; // supply: answered by a time slot; copy, recall: the EEPROM holds it already
    }
}

std::uint8_t Ds18b20Chip::next_of_scratchpad() {
    if (at_ >= scratchpad_.size()) return silent;
    const std::uint8_t byte = scratchpad_[at_++];
    const bool spoiled = trouble_ == OneWireTrouble::wrong_crc && at_ == 1;
    return spoiled ? static_cast<std::uint8_t>(byte ^ 0x08U) : byte;
}

std::uint8_t Ds18b20Chip::byte(std::uint8_t written) {
    if (trouble_ == OneWireTrouble::broken) return silent;
    switch (step_) {
    case Step::rom_command:
        step_ = written == match_rom  ? Step::match
                : written == skip_rom ? Step::command
                                      : Step::deaf; // a search is the adapter's own
        return silent;
    case Step::match:
        if (written != rom_[at_++])
            step_ = Step::deaf;
        else if (at_ == rom_.size())
            step_ = Step::command;
        return silent;
    case Step::command: obey(written); return silent;
    case Step::read: return next_of_scratchpad();
    case Step::write:
        scratchpad_[at_++] = written;
        if (at_ == after_writable) step_ = Step::deaf;
        close_scratchpad();
        return silent;
    case Step::deaf: break;
    }
    return silent;
}

void OneWireBus::reset() {
    for (const auto& chip : chips_)
        chip->reset();
}

std::uint8_t OneWireBus::byte(std::uint8_t written) {
    std::uint8_t seen = written;
    for (const auto& chip : chips_)
        seen = static_cast<std::uint8_t>(seen & chip->byte(written));
    return shorted_ ? std::uint8_t{0} : seen;
}

std::vector<OneWireRom> OneWireBus::search() const {
    std::vector<OneWireRom> found;
    if (shorted_) return found;
    for (const auto& chip : chips_)
        if (chip->trouble() != OneWireTrouble::broken) found.push_back(chip->rom());
    return found;
}

Result<void> OneWireBus::suffer(const std::string& word) {
    if (word == "shorted" || word == "mended") return shorted_ = word == "shorted", Result<void>{};
    constexpr std::array troubles{std::pair{"mended", OneWireTrouble::none},
                                  std::pair{"power-lost", OneWireTrouble::power_lost},
                                  std::pair{"wrong-crc", OneWireTrouble::wrong_crc},
                                  std::pair{"broken", OneWireTrouble::broken}};
    const auto colon = word.find(':');
    const std::string name = word.substr(0, colon);
    const auto found =
        std::ranges::find_if(troubles, [&](const auto& row) { return name == row.first; });
    const long number =
        colon == std::string::npos ? 0 : std::strtol(word.c_str() + colon + 1, nullptr, 10);
    if (found == troubles.end() || number < 1 || number > static_cast<long>(chips_.size()))
        return fail(Fault::bad_request,
                    "\"" + word +
                        "\" is none of shorted, mended, mended:N, power-lost:N, "
                        "wrong-crc:N, broken:N with the number of a sensor");
    chips_[static_cast<std::size_t>(number - 1)]->suffer(found->second);
    return {};
}

} // namespace axiscal::simulate
