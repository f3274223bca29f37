// Source: Temposonics E-series CANopen operation manual, 5.6 (PDO mapping, table 17: 0x6005,
// 0x6501); CiA 406 V3.2 for 0x6004, 0x6020, 0x6400 and the kinds in 0x1000.
#include "drivers/ballbar/cia406_position.hpp"

#include <array>

namespace axiscal {
namespace {

constexpr std::array<ObjectKey, 2> position_keys{ObjectKey{0x6020, 1}, ObjectKey{0x6004, 0}};
constexpr ObjectKey area_key{0x6400, 1};
/// Out of range, above, below; the other bits are reserved.
constexpr unsigned area_bits = 7;

} // namespace

bool is_rotary_encoder(std::uint32_t device_type) {
    const std::uint32_t kind = device_type >> 16U;
    return kind == 1 || kind == 2;
}

Result<Cia406Position> find_cia406_position(const std::vector<PdoLayout>& layouts) {
    for (const ObjectKey& key : position_keys)
        for (std::size_t at = 0; at < layouts.size(); ++at)
            if (layouts[at].bits_of(key) >= 16) return Cia406Position{at, key, 0, true};
    return fail(Fault::bad_configuration,
                "no active TPDO of the device carries its position (0x6020:01 or 0x6004:00): map "
                "it with the maker's program");
}

Cia406Reading
read_cia406_position(const Cia406Position& where, const PdoLayout& layout, const CanFrame& frame) {
    using Why = Cia406Reading::Why;
    const auto raw = layout.field(frame, where.position);
    if (!raw) return {std::nullopt, Why::short_frame};
    // The manual shows frames with and without the status byte that its mapping names.
    const auto area = layout.field(frame, area_key);
    if (where.heed_area && area && (*area & area_bits) != 0) return {std::nullopt, Why::outside};
    const auto steps = static_cast<double>(sign_extended(*raw, layout.bits_of(where.position)));
    return {steps * where.metres_per_step, Why::none};
}

} // namespace axiscal
