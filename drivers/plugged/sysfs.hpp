#pragma once
// Small steps through sysfs. What cannot be read is empty: devices vanish while one looks.

#include "drivers/wire/usb_place.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace axiscal::sysfs {

/// First line of a file.
std::string line_of(const std::filesystem::path& file);
/// Entries of a folder by name.
std::vector<std::filesystem::path> entries(const std::filesystem::path& folder);
/// Last part of what a symbolic link leads to ("ftdi_sio" of .../driver).
std::string target_name(const std::filesystem::path& link);
/// The USB device above a folder of /sys/class or /sys/bus, out of those that are plugged in.
std::optional<UsbEntry> usb_above(const std::filesystem::path& device,
                                  const std::vector<UsbEntry>& plugged);

} // namespace axiscal::sysfs
