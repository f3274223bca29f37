#pragma once
// The position of a CiA 406 linear transducer: where it stands in a PDO and what a step is. Pure.

#include "drivers/canopen/pdo_layout.hpp"

#include <optional>
#include <vector>

namespace axiscal {

inline constexpr std::uint16_t cia406_profile = 406;
/// Position step in nanometres: the first of a multi-sensor device, else the only one.
inline constexpr ObjectKey cia406_step_key{0x6005, 1}, cia406_single_step_key{0x6501, 0};

/// 0x1000: the high word tells the kind. Single-turn and multi-turn encoders are no transducers of
/// length.
bool is_rotary_encoder(std::uint32_t device_type);

struct Cia406Position {
    std::size_t layout = 0; ///< index of the PDO
    ObjectKey position;     ///< 0x6020:1 or 0x6004
    double metres_per_step = 0;
    bool heed_area = true; ///< 0x6400:1 outside of the work area: no number
};

/// The PDO that carries the position. The step is still the caller's to read.
/// @errors Fault::bad_configuration where none does.
Result<Cia406Position> find_cia406_position(const std::vector<PdoLayout>& layouts);

struct Cia406Reading {
    std::optional<double> metres; ///< empty: no number, `why` tells
    enum class Why : std::uint8_t { none, short_frame, outside } why = Why::none;
};
Cia406Reading
read_cia406_position(const Cia406Position& where, const PdoLayout& layout, const CanFrame& frame);

} // namespace axiscal
