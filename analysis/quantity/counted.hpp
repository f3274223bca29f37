#pragma once
#include <string>

namespace axiscal {

/// "1 point", "3 points", "0 points". `thing` in its singular, its plural made by an s. Pure.
inline std::string counted(long count, const std::string& thing) {
    return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

} // namespace axiscal
