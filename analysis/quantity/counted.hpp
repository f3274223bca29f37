#pragma once
#include <string>

namespace axiscal {

/// "1 point", "3 points", "0 points". `thing` in its singular, its plural made by an s. Pure.
inline std::string counted(long count, const std::string& thing) {
    return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

/// The same where more than an s differs: "1 reading is", "3 readings are". Pure.
inline std::string counted(long count, const std::string& single, const std::string& many) {
    return std::to_string(count) + " " + (count == 1 ? single : many);
}

} // namespace axiscal
