#pragma once
// A file of another program, whatever it is, as a case of `axiscal analyze`. Pure.

#include "analysis/quantity/result.hpp"
#include "tools/axiscal/imports/import_map.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

struct ImportedFile {
    std::string form; ///< "Laser10 text (.rtl, .rta)", "raw stream", "uMD log", "table"
    nlohmann::json document;
    bool only_backward = false;       ///< a test from the far side
    std::vector<std::string> remarks; ///< what was taken although it is unusual
};

/// Told apart by content: HEADER:: of Laser10, the first line of a stream or of a log of the uMD, a
/// table of our own (docs/analysis.md), or a table that the map describes, as text or in a
/// workbook.
/// @errors Fault::bad_case naming the place; where a map is needed, or not the right one, what the
/// file looks like.
Result<ImportedFile> import_file(std::string_view bytes, const std::optional<ImportMap>& map);

} // namespace axiscal
