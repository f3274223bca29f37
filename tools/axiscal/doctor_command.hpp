#pragma once
// `axiscal doctor`: runs every check of tools/axiscal/doctor and prints what it found.

#include "tools/axiscal/doctor/doctor.hpp"

#include <string>

namespace axiscal {

struct DoctorRequest {
    std::string station_file = "/etc/axiscal/station.toml";
    std::string socket; ///< empty: the station file's
    DoctorPlaces places;
};

/// Exit 0 when nothing is broken, else exit_unwell.
int command_doctor(const DoctorRequest& request, bool json);

} // namespace axiscal
