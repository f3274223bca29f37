#include "tests/support/source_dir.hpp"

namespace axiscal::test {

std::string source_dir() {
    return AXISCAL_SOURCE_DIR;
}

} // namespace axiscal::test
