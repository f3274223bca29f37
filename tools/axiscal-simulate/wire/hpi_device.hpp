#pragma once
// A Lasertex HPI-3D as its wire shows it: frames of 16 bytes out, commands of 8 bytes in, written
// from the field list of the public reader. Exact positions in, bytes out. One thread.

#include <cstdint>
#include <string>

namespace axiscal::simulate {

/// AA, command, data, checksum: CRC-8 by polynomial 31 from FF over all before it. `data` has 12
/// bytes where the laser speaks, 4 where it hears.
std::string hpi_frame(int command, const std::string& data);

/// What its radio sensors show.
struct HpiAir {
    double temperature_degC = 20, humidity_percent = 50, pressure_Pa = 101325;
};

class HpiDevice {
public:
    /// Takes whole commands from what was sent to it; acknowledges each. Others it does not hear.
    std::string answer(std::string& typed);
    /// The distance of this moment; nothing while nobody has ordered it.
    std::string distance(double position_mm, double level_percent);
    /// Sensor 0 in the air; nothing unless ordered.
    [[nodiscard]] std::string air(const HpiAir& air) const;
    /// Sensor `number`, 1 and on, on the material.
    [[nodiscard]] std::string material(int number, double temperature_degC) const;
    /// Without a beam the count stands still and the flag of a weak signal stands until deleted.
    void set_beam(bool on) { beam_ = on; }
    /// Switched off and on: it sends nothing, and stands at zero where it is.
    void restart();

private:
    bool obey(int command);

    bool distance_on_ = false, meteo_on_ = false, beam_ = true, weak_ = false, zeroed_ = false;
    double offset_mm_ = 0, shown_mm_ = 0;
};

} // namespace axiscal::simulate
