#pragma once
// A 1-Wire cable with DS18B20 thermometers, byte by byte as its master sees it. Pure but for the
// troubles, which another thread may set.

#include "analysis/quantity/result.hpp"

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace axiscal::simulate {

/// power_lost: it starts anew at each conversion and shows its power-on value, 85 degC. wrong_crc:
/// one bit of the scratchpad is read wrongly. broken: its wire, nobody answers.
enum class OneWireTrouble : std::uint8_t { none, power_lost, wrong_crc, broken };

/// Maxim application note 27: x^8 + x^5 + x^4 + 1, reflected, initial value 0.
std::uint8_t one_wire_crc8(const std::uint8_t* bytes, std::size_t count);

/// Family, serial number with its low byte first, CRC.
using OneWireRom = std::array<std::uint8_t, 8>;
OneWireRom one_wire_rom(std::uint8_t family, std::uint64_t serial);

class Ds18b20Chip {
public:
    /// @param serial  48 bits; bits: 9 to 12, the resolution as it stands in its EEPROM.
    Ds18b20Chip(std::uint64_t serial, int bits, std::function<double()> celsius);

    [[nodiscard]] const OneWireRom& rom() const { return rom_; }
    void reset();
    /// What the wire carries while the master writes this byte: the chip can only pull it down.
    std::uint8_t byte(std::uint8_t written);
    void suffer(OneWireTrouble trouble) { trouble_ = trouble; }
    [[nodiscard]] OneWireTrouble trouble() const { return trouble_; }

private:
    enum class Step : std::uint8_t { deaf, rom_command, match, command, read, write };
    void obey(std::uint8_t command);
    void power_on();
    void convert();
    void close_scratchpad();
    std::uint8_t next_of_scratchpad();

    OneWireRom rom_;
    std::array<std::uint8_t, 9> scratchpad_{};
    std::uint8_t configuration_;
    std::function<double()> celsius_;
    std::atomic<OneWireTrouble> trouble_{OneWireTrouble::none};
    Step step_ = Step::deaf;
    std::size_t at_ = 0; ///< in the ROM code or the scratchpad
};

/// Wired-AND of all chips. One thread, but for trouble().
class OneWireBus {
public:
    void add(std::unique_ptr<Ds18b20Chip> chip) { chips_.push_back(std::move(chip)); }
    void reset();
    std::uint8_t byte(std::uint8_t written);
    /// One time slot: supplied by a wire of their own, the chips leave it alone.
    [[nodiscard]] bool bit(bool written) const { return written && !shorted_; }
    /// ROM codes that a search finds, in its order.
    [[nodiscard]] std::vector<OneWireRom> search() const;
    [[nodiscard]] bool shorted() const { return shorted_; }
    /// "power-lost:2", "wrong-crc:1", "broken:1", "mended:2" (the chip's number, from 1); "shorted"
    /// and "mended" are of the whole cable. @errors bad_request.
    Result<void> suffer(const std::string& word);

private:
    std::vector<std::unique_ptr<Ds18b20Chip>> chips_;
    std::atomic<bool> shorted_{false};
};

} // namespace axiscal::simulate
