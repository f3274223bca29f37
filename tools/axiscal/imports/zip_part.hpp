#pragma once
// One part of a ZIP that lies in memory, by libarchive. Pure.

#include "analysis/quantity/result.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace axiscal {

/// A sheet of a million cells has less.
inline constexpr std::size_t largest_part_bytes = std::size_t{32} << 20;

/// Unpacked; nothing where the ZIP has no part of this name.
/// @errors Fault::bad_case, "file": damaged, encrypted, or larger than largest_part_bytes when it
/// is unpacked, however small it says to be.
Result<std::optional<std::string>> zip_part(std::string_view zip, std::string_view name);

} // namespace axiscal
