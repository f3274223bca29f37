#pragma once
// The raw samples of a point as few bytes, and back, bit for bit. Pure.

#include "analysis/record/run_record.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

/// Of a laser on a still axis six to eight bytes a sample instead of 24: fewer blocks of the disk
/// wait in each commit. Numbers are only made short, not compressed: a thousand samples take some
/// microseconds. The bytes are those of docs/run-file.md.
std::string packed_window(std::span<const WindowSample> samples);

/// Nothing for bytes that `packed_window` does not make: cut, with more behind, a number that is
/// longer than 64 bits or than it needs to be. No input makes it reserve more than 8 times its
/// size.
std::optional<std::vector<WindowSample>> unpacked_window(std::string_view bytes);

} // namespace axiscal
