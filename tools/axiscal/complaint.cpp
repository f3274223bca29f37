#include "tools/axiscal/complaint.hpp"

#include "tools/axiscal/exit_code.hpp"

#include <iostream>

namespace axiscal {

int complain(const Error& error) {
    std::cerr << describe(error) << "\n";
    return error.fault == Fault::io ? exit_failed : exit_refused;
}

} // namespace axiscal
