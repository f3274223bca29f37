// Source: CiA 404 V1.2 (measuring devices): 0x6130, 0x7130, 0x9130 process value, 0x6150 status,
// 0x6131 unit, 0x6132 digits; CiA 303-2 V1.4, codes of units (confirmed by the manual of esd's
// CAN-CBX-Pt100, whose 0x6131 holds 002D0000h for degrees Celsius).
#include "drivers/environment/cia404_input.hpp"

#include <array>
#include <bit>
#include <cmath>

namespace axiscal {
namespace {

constexpr std::array<std::uint16_t, 3> value_indices{0x6130, 0x9130, 0x7130};
constexpr std::uint16_t status_index = 0x6150;
constexpr unsigned sensor_faulty_bit = 1, range_bits = 6;
constexpr double absolute_zero_degC = -273.15;
constexpr double hottest_degC = 2000; ///< no contact sensor measures that

double celsius_of(double value, Cia404Unit unit) {
    if (unit == Cia404Unit::in_kelvin) return value + absolute_zero_degC;
    if (unit == Cia404Unit::in_fahrenheit) return (value - 32) / 1.8;
    return value;
}

} // namespace

std::optional<Cia404Unit> cia404_unit(std::uint32_t word) {
    switch (word) {
    case 0x002D0000: return Cia404Unit::in_celsius;
    case 0x00050000: return Cia404Unit::in_kelvin;
    case 0x00AC0000: return Cia404Unit::in_fahrenheit;
    default: return std::nullopt;
    }
}

Result<Cia404Input> find_cia404_input(const std::vector<PdoLayout>& layouts, int channel) {
    const auto sub = static_cast<std::uint8_t>(channel);
    for (const std::uint16_t index : value_indices) {
        const ObjectKey value{index, sub}, status{status_index, sub};
        for (std::size_t at = 0; at < layouts.size(); ++at) {
            const int bits = layouts[at].bits_of(value);
            if (bits == 0 || (index == value_indices.front() && bits != 32)) continue;
            return Cia404Input{
                at, value, status, layouts[at].bits_of(status) > 0, 0, Cia404Unit::in_celsius};
        }
    }
    return fail(Fault::bad_configuration,
                "no active TPDO of the device carries the value of input " +
                    std::to_string(channel) + " (0x9130, 0x7130 or 0x6130, sub-index " +
                    std::to_string(channel) + "): map it with the maker's program");
}

Cia404Reading
read_cia404_input(const Cia404Input& input, const PdoLayout& layout, const CanFrame& frame) {
    using Why = Cia404Reading::Why;
    const auto raw = layout.field(frame, input.value);
    if (!raw) return {std::nullopt, Why::short_frame};
    if (input.has_status) {
        const auto status = layout.field(frame, input.status);
        if (!status) return {std::nullopt, Why::short_frame};
        if ((*status & sensor_faulty_bit) != 0) return {std::nullopt, Why::sensor_faulty};
        if ((*status & range_bits) != 0) return {std::nullopt, Why::out_of_range};
    }
    double value = 0;
    if (input.is_float())
        value = static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(*raw)));
    else
        value = static_cast<double>(sign_extended(*raw, layout.bits_of(input.value))) /
                std::pow(10.0, input.digits);
    const double celsius = celsius_of(value, input.unit);
    const bool possible = celsius >= absolute_zero_degC && celsius <= hottest_degC;
    if (!possible) return {std::nullopt, Why::out_of_range}; // a NaN, too
    return {celsius, Why::none};
}

} // namespace axiscal
