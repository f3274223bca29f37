#pragma once
// Lines made to fit a terminal: cut, folded, coloured by rank, the least worthy left out. Pure but
// for wcwidth(3), which asks the locale's LC_CTYPE how many columns a letter takes.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

enum class Rank : std::uint8_t {
    fault,   ///< nothing goes on until it is mended
    warning, ///< a person should look
    main,    ///< what the eye looks for: the next target, the reading
    plain,
    minor ///< notes
};

struct ScreenLine {
    Rank rank = Rank::plain;
    std::string text;
};

struct ScreenSize {
    int columns = 80, rows = 24;
};

/// From top to bottom. `head` never gives way; of `body` and `notes` what there is room for, the
/// latest notes and at least three of them.
struct ScreenParts {
    std::vector<ScreenLine> head, body, notes;
};

/// Columns that `text` takes on a terminal; a control character counts as the '?' put for it.
int columns_of(std::string_view text);
/// At most `columns` wide, the end replaced by "…" where it is cut; control characters become '?'.
std::string cut_to(std::string_view text, int columns);
/// `text` in lines of at most `columns`, parted at blanks where there are any, later ones indented
/// by `indent`; at most `most` lines, the last one cut.
std::vector<std::string> folded(std::string_view text, int columns, int indent, int most);

/// One screen: at most `size.rows` - 1 lines, none wider than `size.columns`, so that nothing wraps
/// and nothing scrolls; each ends with a new line and leaves no colour behind.
std::string screen_text(const ScreenParts& parts, ScreenSize size, bool colour);

} // namespace axiscal
