#pragma once
// Looks at a PDF with poppler's tools, as a reader of the certificate would.

#include "tests/support/scratch_folder.hpp"

#include <algorithm>

#include <array>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace axiscal::test {

inline std::string output_of(const std::string& command) {
    std::string text;
    FILE* pipe = ::popen(command.c_str(), "r");
    if (!pipe) return text;
    std::array<char, 4096> block{};
    while (const std::size_t n = std::fread(block.data(), 1, block.size(), pipe))
        text.append(block.data(), n);
    return ::pclose(pipe) == 0 ? text : "failed: " + command;
}

inline std::string write_pdf(const testing::ScratchFolder& folder, const std::string& bytes) {
    const std::string path = folder.file("certificate.pdf");
    std::ofstream{path, std::ios::binary} << bytes;
    return path;
}

inline std::string text_of(const std::string& pdf) {
    return output_of("pdftotext -layout -enc UTF-8 '" + pdf + "' -");
}

inline int pages_of(const std::string& pdf) {
    const std::string info = output_of("pdfinfo '" + pdf + "'");
    const auto at = info.find("Pages:");
    return at == std::string::npos ? 0 : std::stoi(info.substr(at + 6));
}

/// The day on which the document says it was made, "20260101010000Z"; empty where it says none.
inline std::string made_on(const std::string& pdf) {
    const std::string info = output_of("pdfinfo -rawdates '" + pdf + "'");
    const auto at = info.find("CreationDate:");
    if (at == std::string::npos) return "";
    const auto begin = info.find_first_of("0123456789", at);
    return info.substr(begin, info.find('\n', begin) - begin);
}

/// A page as grey levels, 1 pixel a point.
struct PageImage {
    int width = 0, height = 0;
    std::vector<unsigned char> grey;
    [[nodiscard]] bool ink_at(int x, int y) const {
        return grey[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                    static_cast<std::size_t>(x)] < 250;
    }
    [[nodiscard]] int ink_outside(int margin) const {
        int found = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const bool inside =
                    x >= margin && x < width - margin && y >= margin && y < height - margin;
                found += !inside && ink_at(x, y);
            }
        return found;
    }
    [[nodiscard]] int ink() const { return ink_outside(width); }
};

inline PageImage image_of(const std::string& pdf, int page) {
    const std::string number = std::to_string(page);
    std::istringstream ppm{
        output_of("pdftoppm -gray -r 72 -f " + number + " -l " + number + " '" + pdf + "'")};
    PageImage image;
    std::string magic;
    int depth = 0;
    ppm >> magic >> image.width >> image.height >> depth;
    ppm.get();
    image.grey.resize(static_cast<std::size_t>(image.width) *
                      static_cast<std::size_t>(image.height));
    ppm.read(reinterpret_cast<char*>(image.grey.data()),
             static_cast<std::streamsize>(image.grey.size()));
    return image;
}

struct Word {
    int page = 0;
    double left = 0, top = 0, right = 0, bottom = 0;
    std::string text;
};

/// Every word with its box, from pdftotext's own measure.
inline std::vector<Word> words_of(const std::string& pdf) {
    std::istringstream lines{output_of("pdftotext -bbox -enc UTF-8 '" + pdf + "' -")};
    std::vector<Word> words;
    int page = 0;
    for (std::string line; std::getline(lines, line);) {
        page += line.find("<page ") != std::string::npos;
        Word word;
        word.page = page;
        const auto begin = line.find("<word ");
        if (begin == std::string::npos) continue;
        if (std::sscanf(line.c_str() + begin,
                        R"(<word xMin="%lf" yMin="%lf" xMax="%lf" yMax="%lf">)", &word.left,
                        &word.top, &word.right, &word.bottom) != 4)
            continue;
        word.text = line.substr(line.find('>', begin) + 1);
        word.text.resize(word.text.find("</word>"));
        words.push_back(word);
    }
    return words;
}

/// Pairs of words whose ink would touch: the boxes hold the full line, so a third is taken off.
inline std::vector<std::string> collisions_in(const std::vector<Word>& words) {
    std::vector<std::string> found;
    for (std::size_t a = 0; a < words.size(); ++a)
        for (std::size_t b = a + 1; b < words.size() && words[b].page == words[a].page; ++b) {
            const double height_a = words[a].bottom - words[a].top,
                         height_b = words[b].bottom - words[b].top;
            const double slack = 0.33 * std::min(height_a, height_b);
            const bool apart_x =
                words[a].right < words[b].left + 0.5 || words[b].right < words[a].left + 0.5;
            const bool apart_y =
                words[a].bottom - slack < words[b].top || words[b].bottom - slack < words[a].top;
            // a combining macron stands over its letter and is told apart from it by pdftotext
            const bool macron = words[a].text == "\u0304" || words[b].text == "\u0304";
            if (!apart_x && !apart_y && !macron)
                found.push_back("page " + std::to_string(words[a].page) + ": \"" + words[a].text +
                                "\" and \"" + words[b].text + "\"");
        }
    return found;
}

} // namespace axiscal::test
