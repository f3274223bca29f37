#include "wire/can/can_instruments.hpp"

#include <cmath>

namespace axiscal::simulate {

namespace {

/// Objects that every node has (CiA 301).
void put_identity(CanNode& node,
                  std::uint32_t device_type,
                  const std::string& name,
                  std::uint32_t maker,
                  std::uint32_t serial) {
    node.put_number(0x1000, 0, device_type, 4);
    node.put_number(0x1001, 0, 0, 1);
    node.put_text(0x1008, 0, name);
    node.put_number(0x1017, 0, 0, 2, true);
    node.put_number(0x1018, 0, 4, 1);
    node.put_number(0x1018, 1, maker, 4);
    node.put_number(0x1018, 2, 1, 4);
    node.put_number(0x1018, 3, 0x00010002, 4);
    node.put_number(0x1018, 4, serial, 4);
}

} // namespace

std::unique_ptr<CanNode> make_cantrans(int number, const CanTransWorld& world) {
    auto node = std::make_unique<CanNode>(number);
    const auto n = static_cast<std::uint32_t>(number);
    put_identity(*node, 0x00020194, "CANtrans T", 0x0000FFFF, 4711 + n);
    node->put_number(0x6131, 0, 1, 1);
    node->put_number(0x6131, 1, 0x002D0000, 4);
    node->put_number(0x6132, 0, 1, 1);
    node->put_number(0x6132, 1, 2, 1);
    node->put_measured(0x9130, 1, [celsius = world.celsius](double seconds) {
        return low_byte_first(std::lround(celsius(seconds) * 100), 4);
    });
    node->put_measured(0x6150, 1, [status = world.status](double seconds) {
        return low_byte_first(status(seconds), 1);
    });
    node->put_tpdo(1, 0x180 + n, 0xFF, 0, {0x91300120, 0x61500108});
    return node;
}

std::unique_ptr<CanNode> make_temposonics(int number, const TemposonicsWorld& world) {
    auto node = std::make_unique<CanNode>(number);
    const auto n = static_cast<std::uint32_t>(number);
    put_identity(*node, 0x00080196, "Temposonics E-series", 0x40, world.serial);
    node->put_number(0x6005, 0, 2, 1);
    node->put_number(0x6005, 1, world.step_nm, 4);
    node->put_number(0x6005, 2, 100, 4);
    node->put_number(0x6200, 0, 1, 2, true);
    node->put_number(0x6501, 0, world.step_nm, 4);
    node->put_number(0x6503, 0, 0, 2);
    auto steps = [world](double seconds) {
        return std::llround(world.metres(seconds) * 1e9 / world.step_nm);
    };
    node->put_measured(0x6020, 1,
                       [steps](double seconds) { return low_byte_first(steps(seconds), 4); });
    node->put_measured(0x6030, 1, [metres = world.metres](double seconds) {
        constexpr double look_s = 1e-3; // velocity in mm/s
        const double speed = (metres(seconds) - metres(seconds - look_s)) / look_s * 1e3;
        return low_byte_first(std::lround(speed), 2);
    });
    node->put_measured(0x6400, 1, [area = world.area](double seconds) {
        return low_byte_first(area(seconds), 1);
    });
    node->put_tpdo(1, 0x180 + n, 0xFE, 1, {0x60200120, 0x60300110, 0x64000108});
    return node;
}

} // namespace axiscal::simulate
