#include "wire/elcomat_line.hpp"

#include <cstdio>

namespace axiscal::simulate {

std::string elcomat_record(std::optional<double> x_arcsec, double y_arcsec) {
    if (!x_arcsec) return "4 000 0.00 0.00\r";
    char text[64];
    std::snprintf(text, sizeof text, "4 003 %.2f %.2f\r", *x_arcsec, y_arcsec);
    return text;
}

std::string elcomat_answer(std::string& typed, std::optional<double> x_arcsec, double y_arcsec) {
    std::string answer;
    for (const char letter : typed)
        if (letter == 'a') answer += elcomat_record(x_arcsec, y_arcsec);
    typed.clear();
    return answer;
}

} // namespace axiscal::simulate
