#pragma once
// What `axiscal devices` found, as JSON and as words. Pure but for the rights of device nodes.

#include "drivers/plugged/candidates.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace axiscal {

/// How "usb", "wire" and the rest are called stands in docs/install.md.
nlohmann::ordered_json
device_json(const PluggedDevice& device, const StationWires& station, const Account& service);
/// A paragraph for one device of device_json(). With `blocks` the lines to add are shown however
/// many drivers it could be; else only where there is one.
std::string device_text(const nlohmann::ordered_json& device, bool blocks);

} // namespace axiscal
