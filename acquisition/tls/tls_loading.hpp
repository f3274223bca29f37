#pragma once
// Loads axiscald-tls.so, which lies in ../lib/axiscal beside the folder of the programs.

#include "acquisition/tls/tls_interface.hpp"
#include "analysis/quantity/result.hpp"

namespace axiscal {

/// The first call maps libssl and libcrypto, some 4 MiB; they stay until the end of the process.
/// @errors Fault::io naming the file: it is not there, or of another version.
Result<TlsModule*> load_tls_module();

} // namespace axiscal
