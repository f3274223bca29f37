#pragma once
#include <string>
#include <string_view>

namespace axiscal {

/// "COM3", as Windows names a serial port.
inline bool is_windows_port(std::string_view path) {
    return path.size() > 3 && (path.starts_with("COM") || path.starts_with("com")) &&
           path.find_first_not_of("0123456789", 3) == std::string_view::npos;
}

/// Why `path` names no serial port, and what does. `prefix` stands before a path where the key
/// takes other wires, too: "serial:".
inline std::string no_serial_port(std::string_view path, std::string_view prefix) {
    const std::string start = "\"" + std::string{prefix} + "/dev/";
    return "\"" + std::string{path} + "\" " +
           (is_windows_port(path) ? "is a port's name on Windows; Linux names it by a file"
                                  : "is no full path of a serial port") +
           ": write " + start + "serial/by-id/...\" or " + start +
           "ttyUSB0\"; axiscal devices lists what is plugged in";
}

} // namespace axiscal
