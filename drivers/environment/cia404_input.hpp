#pragma once
// One analogue input of a CiA 404 measuring device: where its value stands in a PDO and what the
// number means. Pure.

#include "drivers/canopen/pdo_layout.hpp"

#include <optional>
#include <vector>

namespace axiscal {

inline constexpr std::uint16_t cia404_profile = 404;
inline constexpr std::uint16_t cia404_unit_index = 0x6131, cia404_digits_index = 0x6132;

enum class Cia404Unit : std::uint8_t { in_celsius, in_kelvin, in_fahrenheit };
/// Of object 0x6131: prefix and SI numerator by CiA 303-2. Empty for what is no plain temperature.
std::optional<Cia404Unit> cia404_unit(std::uint32_t word);

struct Cia404Input {
    std::size_t layout = 0; ///< index of the PDO
    ObjectKey value;        ///< 0x6130 (float), 0x9130 (32 bits) or 0x7130 (16 bits)
    ObjectKey status;       ///< 0x6150, where the same PDO has it
    bool has_status = false;
    int digits = 0; ///< the whole number counts 10^-digits units; not of a float
    Cia404Unit unit = Cia404Unit::in_celsius;
    [[nodiscard]] bool is_float() const { return value.index == 0x6130; }
};

/// The PDO that carries input `channel` (sub-index, from 1). Unit and digits are still the caller's
/// to read.
/// @errors Fault::bad_configuration where none does.
Result<Cia404Input> find_cia404_input(const std::vector<PdoLayout>& layouts, int channel);

/// What one frame says of an input.
struct Cia404Reading {
    std::optional<double> celsius; ///< empty: no number, `why` tells
    enum class Why : std::uint8_t {
        none,
        short_frame,   ///< the value is not in it
        sensor_faulty, ///< status bit 0
        out_of_range,  ///< status bits 1 and 2, or what no thermometer can say
    } why = Why::none;
};
Cia404Reading
read_cia404_input(const Cia404Input& input, const PdoLayout& layout, const CanFrame& frame);

} // namespace axiscal
