#include "wire/gauge_line.hpp"

#include <cmath>
#include <cstdio>

namespace axiscal::simulate {

namespace {

std::string printed(const char* format, double value_mm) {
    char text[32];
    std::snprintf(text, sizeof text, format, std::abs(value_mm));
    return (std::signbit(value_mm) ? "-" : "+") + std::string{text};
}

/// One command ended by CR, without its end; false: none is whole yet.
bool next_command(std::string& typed, std::string& command) {
    const auto end = typed.find('\r');
    if (end == std::string::npos) return false;
    command = typed.substr(0, end);
    typed.erase(0, end + 1);
    return true;
}

std::string sylvac_answer(const std::string& command, double value_mm) {
    std::string echo = command + "\r";
    if (command == "?" || command == "PRI") return echo + sylvac_record(value_mm);
    if (command == "SET?") return echo + "MM RES3 REF1 NOR CHA+ B1\r";
    return echo;
}

} // namespace

std::string heidenhain_record(double value_mm) {
    return printed("%10.4f", value_mm) + "  = \r\n";
}

std::string mitutoyo_record(double value_mm) {
    return "01A" + printed("%08.3f", value_mm) + "\r";
}

std::string sylvac_record(double value_mm) {
    return printed("%07.3f", value_mm) + "\r";
}

std::string gauge_answer(std::string_view kind, std::string& typed, double value_mm) {
    std::string answer, command;
    if (kind == "sylvac") {
        while (next_command(typed, command))
            answer += sylvac_answer(command, value_mm);
        return answer;
    }
    const bool heidenhain = kind == "nd-28x";
    for (const char key : typed) {
        if (heidenhain && key == '\x02') answer += heidenhain_record(value_mm);
        if (!heidenhain && key == '1') answer += mitutoyo_record(value_mm);
    }
    typed.clear();
    return answer;
}

} // namespace axiscal::simulate
