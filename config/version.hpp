#pragma once

namespace axiscal {

/// The number of this software, "0.1.0": in every run file, on every certificate, and what a package is called by. It is one
/// object of its own, so that another version is linked from what is compiled already.
const char* software_version();

} // namespace axiscal
