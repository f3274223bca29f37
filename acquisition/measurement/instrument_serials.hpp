#pragma once
// Which instruments have told who they are: after a restart they must be those of the run.

#include "acquisition/run/resume.hpp"

#include <vector>

namespace axiscal {

class Supervisor;

/// @param channels  ids of what the run uses
/// @returns the serial numbers of their instruments, as far as they have told one; of an instrument
/// with several channels several times
std::vector<InstrumentSerial> answered_serials(const Supervisor& instruments,
                                               const std::vector<int>& channels);

} // namespace axiscal
