#pragma once
// An attocube IDS3010 as its public API describes it: JSON-RPC 2.0, one reply a line ended CR LF,
// result[0] the error number, lengths in picometres. Pure.

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace axiscal::simulate {

/// What the instrument would measure now.
struct IdsReading {
    std::array<double, 3> vacuum_mm{}; ///< displacement if there were no air
    double temperature_degC = 20, pressure_hPa = 1013.25, humidity_percent = 50;
    double index = 1; ///< of that air
    double contrast_percent = 85;
};

class IdsDevice {
public:
    std::string mode = "measurement running", serial = "L01-0049-123", firmware = "1.9.0";
    int compensation_mode = 2; ///< 0 environment unit, 1 typed values, 2 typed index
    double typed_index = 1;
    bool unit_connected = true, beam = true;

    /// The reply to one request, CR LF included.
    [[nodiscard]] std::string answer(const std::string& request, const IdsReading& now);

private:
    nlohmann::json
    result_of(const std::string& method, const nlohmann::json& parameters, const IdsReading& now);
    [[nodiscard]] nlohmann::json displacement(const nlohmann::json& parameters,
                                              const IdsReading& now) const;
    [[nodiscard]] double index_used(const IdsReading& now) const;
};

/// Takes whole JSON objects from the front of `pending`: requests need no terminator.
std::vector<std::string> take_requests(std::string& pending);

} // namespace axiscal::simulate
