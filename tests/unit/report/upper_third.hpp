#pragma once
// What is read of a paper's first page in five seconds: its upper third in grey at 100 dpi, by a
// program that reads pictures of pages (tesseract).

#include "pdf_tools.hpp"

#include <cctype>
#include <string>
#include <vector>

namespace axiscal::test {

/// Letters and digits alone, in small letters: what distinguishes no two words here.
inline std::string letters_of(const std::string& text) {
    std::string out;
    for (const char c : text)
        if (std::isalnum(static_cast<unsigned char>(c)) != 0)
            out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return out;
}

/// The upper third of page one in grey at 100 dpi, as tesseract reads it.
inline std::string upper_third_of(const std::string& pdf, const testing::ScratchFolder& folder) {
    const std::string picture = folder.file("top");
    output_of("pdftoppm -gray -r 100 -f 1 -l 1 -x 0 -y 0 -W 827 -H 390 -singlefile '" + pdf +
              "' '" + picture + "'");
    return output_of("OMP_THREAD_LIMIT=1 tesseract '" + picture +
                     ".pgm' - -l eng --psm 6 2>/dev/null");
}

/// Which of these words cannot be read there; the whole of what is read behind them.
inline std::string missing_above(const std::string& pdf,
                                 const testing::ScratchFolder& folder,
                                 const std::vector<std::string>& wanted) {
    const std::string seen = upper_third_of(pdf, folder);
    std::string missing;
    for (const std::string& words : wanted)
        if (letters_of(seen).find(letters_of(words)) == std::string::npos)
            missing += "\"" + words + "\" ";
    return missing.empty() ? missing : missing + "is not read in:\n" + seen;
}

} // namespace axiscal::test
