#include "tools/axiscal/terminal/terminal.hpp"

#include <cstdlib>
#include <string_view>
#include <sys/ioctl.h>
#include <unistd.h>

namespace axiscal {
namespace {

std::string_view environment_word(const char* name) {
    const char* value = std::getenv(name);
    return value == nullptr ? std::string_view{} : std::string_view{value};
}

} // namespace

bool output_is_screen() {
    const std::string_view kind = environment_word("TERM");
    return ::isatty(STDOUT_FILENO) != 0 && !kind.empty() && kind != "dumb";
}

bool output_takes_colour() {
    return output_is_screen() && environment_word("NO_COLOR").empty();
}

ScreenSize size_of_screen() {
    winsize size{};
    ScreenSize usual;
    if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0) return usual;
    if (size.ws_col > 0) usual.columns = size.ws_col;
    if (size.ws_row > 0) usual.rows = size.ws_row;
    return usual;
}

} // namespace axiscal
