#pragma once
// Where the readings of a run come from that this station did not take. Pure data.

#include <string>

namespace axiscal {

struct ImportedReadings {
    std::string file;     ///< its name
    std::string form;     ///< "Laser10 text (.rtl, .rta)"
    std::string sha256;   ///< of its bytes, lower-case hex
    std::string measured; ///< when, as the file says it; empty: not stated
    std::string remark;   ///< what was taken although it is unusual: one line, often empty
};

} // namespace axiscal
