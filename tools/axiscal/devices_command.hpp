#pragma once
// `axiscal devices`: the instruments of the station as axiscald knows them, and what the kernel
// knows of the devices that are plugged in.

#include "drivers/plugged/plugged.hpp"
#include "tools/axiscal/station_client.hpp"

#include <string>

namespace axiscal {

struct DevicesRequest {
    std::string station_file = "/etc/axiscal/station.toml";
    std::string driver; ///< show only what could be of this driver; empty: all
    KernelPlaces places;
};

/// Works without axiscald and without a station file: what is missing is said. Exit 2 for a driver
/// that there is not.
int command_devices(const StationClient& client, const DevicesRequest& request, bool json);
/// Of a station on another PC, whose sockets cannot be seen from here.
int command_far_devices(const StationClient& client, bool json);
/// The registered drivers by name and summary; needs no daemon.
int command_list_drivers(bool json);

} // namespace axiscal
