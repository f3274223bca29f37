#pragma once
// What standard output is, and what may be written to it.

#include "tools/axiscal/terminal/screen.hpp"

namespace axiscal {

/// Home, then clear: what begins a screen.
constexpr const char* new_screen = "\x1b[H\x1b[2J";

/// A terminal that can be redrawn: no pipe, no file, and TERM is neither empty nor "dumb".
bool output_is_screen();
/// Such a terminal, and nobody asked for no colours (NO_COLOR, https://no-color.org).
bool output_takes_colour();
/// Asked anew for each screen: a window may be drawn larger. 80×24 where it is not told.
ScreenSize size_of_screen();

} // namespace axiscal
