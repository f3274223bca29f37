#pragma once
// Which certificate belongs to a stored run as it stands, and what is said where none does. Private
// to the console. Blocking calls.

#include "acquisition/console/run_history.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace axiscal {

/// A sentence, with the way to one where there is a way.
std::string why_no_paper(const StoredRun& run);

/// Puts facts, folder and state of the first one that belongs to the run: of its id, and with the
/// digest of the result that the run file keeps. Else the reason why none does.
/// @param run   with its summary  @param most  bytes of a certificate.json
void take_certificate(StoredRun& run, const std::vector<PaperFolder>& folders, std::size_t most);

} // namespace axiscal
