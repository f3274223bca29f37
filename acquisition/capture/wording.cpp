#include "acquisition/capture/wording.hpp"

#include <cstdio>

namespace axiscal {

std::string plain_number(double value, int digits) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", digits, value);
    std::string number{text};
    if (number.find('.') != std::string::npos) {
        number.erase(number.find_last_not_of('0') + 1);
        if (number.back() == '.') number.pop_back();
    }
    return number == "-0" ? "0" : number;
}

std::string in_mm(Length length) {
    return plain_number(length.in(mm), 4) + " mm";
}
std::string in_axis_unit(AxisKind kind, Length coordinate) {
    constexpr int digits_deg = 5; // 0.04 seconds of arc
    if (kind == AxisKind::linear) return in_mm(coordinate);
    return plain_number(coordinate.in(mm), digits_deg) + " deg";
}
std::string in_um(Length length) {
    return plain_number(length.in(um), 2) + " um";
}
std::string in_seconds(Duration span) {
    return plain_number(seconds_of(span), 3) + " s";
}
} // namespace axiscal
