#pragma once
// Which CANopen devices can be simulated, from their makers' tables.

#include "wire/can/can_node.hpp"

#include <memory>

namespace axiscal::simulate {

/// JUMO CANtrans T 902910 (operating instructions B 90.2910; CiA 404): TPDO1 with 0x9130 in
/// hundredths of a degree and 0x6150.
struct CanTransWorld {
    std::function<double(double seconds)> celsius;
    std::function<int(double seconds)> status; ///< 0x6150
};
std::unique_ptr<CanNode> make_cantrans(int node, const CanTransWorld& world);

/// MTS Temposonics E-series (operation manual CANopen, 5.6; CiA 406): TPDO1 each millisecond with
/// 0x6020:1, 0x6030:1 and 0x6400:1.
struct TemposonicsWorld {
    std::function<double(double seconds)> metres;
    std::function<int(double seconds)> area; ///< 0x6400:1
    std::uint32_t step_nm = 1000;
    std::uint32_t serial = 16040512;
};
std::unique_ptr<CanNode> make_temposonics(int node, const TemposonicsWorld& world);

} // namespace axiscal::simulate
