#include "config/version.hpp"

namespace axiscal {

const char* software_version() { return AXISCAL_VERSION; }

} // namespace axiscal
