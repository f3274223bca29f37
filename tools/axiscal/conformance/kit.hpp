#pragma once
// Finds and reads the files of the conformance kit.

#include "tools/axiscal/conformance/conformance_case.hpp"

#include <string>
#include <vector>

namespace axiscal {

/// The folder of cases: `stated`, else the first of $AXISCAL_CONFORMANCE_PATH (folders separated by
/// ':') that is there, else the installed one (../share/axiscal/conformance as seen from the
/// program), else tests/reference/conformance in a folder above the program (a build tree).
/// @errors Fault::not_found with the places that were looked at.
Result<std::string> find_conformance_folder(const std::string& stated);

struct Kit {
    std::vector<ConformanceCase> cases;  ///< by id
    std::vector<std::string> complaints; ///< "FILE: field: reason", one a file that is no case
    bool unreadable = false;             ///< among them a file that could not be read at all
};

/// Every *.json in `folder` whose id is one of `only` (or matches it, as "circle-*"); all where
/// `only` is empty.
/// @errors Fault::io: the folder cannot be read. Fault::not_found: a word of `only` fits no file.
Result<Kit> read_kit(const std::string& folder, const std::vector<std::string>& only);

} // namespace axiscal
