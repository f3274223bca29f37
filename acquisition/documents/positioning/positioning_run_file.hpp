#pragma once
// From a run file that was read to the certificate of a positioning test.

#include "acquisition/runfile/run_file.hpp"
#include "analysis/positioning/positioning_certificate.hpp"

namespace axiscal {

/// With the digest of its figures, and without what the paper adds: number, hash of the file.
/// Of a run that is open, or was closed as incomplete, it is the partial result.
/// @errors what make_certificate() refuses.
Result<Certificate> certificate_of(RunFileContents contents);

} // namespace axiscal
