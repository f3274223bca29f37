#pragma once
// A Vaisala PTU300 that takes SEND, S, OPEN, CLOSE and FORM (user's guide, table of format
// modifiers): x.y digits and decimals of the quantities that follow, "text", P T RH, Un the unit in
// n places, CS2 CS4 CSX the checksum of the message so far, \r \n \t. It echoes what is typed.
// Pure.

#include <string>
#include <string_view>

namespace axiscal::simulate {

struct VaisalaAir {
    double pressure_hPa = 0, temperature_degC = 0, humidity_percent = 0;
};

/// The message that a format makes of this air.
std::string vaisala_message(std::string_view format, const VaisalaAir& air);

class VaisalaTransmitter {
public:
    /// What it sends back, echo and prompt included; takes whole commands from `typed`.
    std::string answer(std::string& typed, const VaisalaAir& air);

private:
    std::string obey(const std::string& command, const VaisalaAir& air);
    std::string format_ = R"(4.1 "P=" P " " U3 3.1 " T=" T " " U2 3.1 " RH=" RH " " U3 \r \n)";
};

} // namespace axiscal::simulate
