#pragma once
// Text from wires and people: made valid where it enters, and folded to what may be part of a path.
// No function here fails on any bytes. Pure.

#include <cstddef>
#include <string>
#include <string_view>

namespace axiscal {

/// `bytes` as one line of well-formed UTF-8: each maximal part of an ill-formed sequence becomes
/// U+FFFD (The Unicode Standard 15.0, 3.9, "U+FFFD Substitution of Maximal Subparts"), each
/// control character (C0, DEL, C1) and each separator of lines or paragraphs a space. Well-formed
/// text without them comes back as it was.
std::string valid_text(std::string_view bytes);

/// Bytes of the well-formed character that `text` begins with (RFC 3629); 0: none stands there, or
/// `text` is empty.
std::size_t well_formed_length(std::string_view text);

/// Longest parts of an id. That of the axis is shorter than an instant (20261124T101500Z), so that
/// the last instant in an id is always the one of the run.
inline constexpr std::size_t longest_station_part = 40, longest_axis_part = 15,
                             longest_run_id = 120;

/// The part of an id that stands for a person's name (docs/run-file.md, "How a run is called"):
/// ASCII letters, digits and _ are kept, all between them becomes one hyphen, hyphens at the ends
/// go, the first `longest` bytes count. Nothing left: `otherwise`. A device name of Windows (CON,
/// PRN, AUX, NUL, COM0-9, LPT0-9, in any case) gets a _ at its end. An id made by it stays as it
/// is.
/// @param otherwise  itself such an id, not longer than `longest`
/// @param longest    at least 5: a device name and its _
std::string id_of_name(std::string_view name, std::string_view otherwise, std::size_t longest);

} // namespace axiscal
