#include "tools/axiscal/imports/foreign_text.hpp"

#include "tools/axiscal/cases/table_text.hpp"

#include <array>
#include <cstddef>
#include <iconv.h>
#include <optional>
#include <utility>

namespace axiscal {
namespace {

std::uint8_t byte_at(std::string_view bytes, std::size_t at) {
    return static_cast<std::uint8_t>(bytes[at]);
}

/// By iconv: nothing where the bytes are not of that encoding.
std::optional<std::string> converted(std::string_view bytes, const char* from) {
    const iconv_t handle = iconv_open("UTF-8", from);
    if (handle == reinterpret_cast<iconv_t>(-1))
        return std::nullopt; // NOLINT(performance-no-int-to-ptr)
    std::string input{bytes}, out;
    char* at = input.data();
    std::size_t left = input.size();
    bool whole = true;
    while (left > 0 && whole) {
        std::array<char, 4096> piece{};
        char* to = piece.data();
        std::size_t room = piece.size();
        const std::size_t done = iconv(handle, &at, &left, &to, &room);
        out.append(piece.data(), piece.size() - room);
        whole = done != static_cast<std::size_t>(-1) || room < 8; // full: the next piece
    }
    iconv_close(handle);
    return whole ? std::optional{std::move(out)} : std::nullopt;
}

bool has_only_pairs_of_gb2312(std::string_view bytes) {
    constexpr std::uint8_t first = 0xA1, last_lead = 0xF7, last = 0xFE;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        if (byte_at(bytes, i) < 0x80) continue;
        if (byte_at(bytes, i) < first || byte_at(bytes, i) > last_lead || i + 1 >= bytes.size())
            return false;
        ++i;
        if (byte_at(bytes, i) < first || byte_at(bytes, i) > last) return false;
    }
    return true;
}

bool begins_with_mark_of_utf16(std::string_view bytes) {
    return bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff");
}

} // namespace

std::string_view name_of(TextEncoding encoding) {
    switch (encoding) {
    case TextEncoding::utf8: return "UTF-8";
    case TextEncoding::utf16: return "UTF-16";
    case TextEncoding::gbk: return "GBK";
    case TextEncoding::latin1: return "Latin-1";
    }
    return "UTF-8";
}

Result<ForeignText> foreign_text(std::string_view bytes) {
    const bool wide = begins_with_mark_of_utf16(bytes);
    if (!wide && bytes.find('\0') != std::string_view::npos)
        return refuse(Fault::bad_case, "file", "has a byte 0: it is no text");
    if (wide || converted(bytes, "UTF-8")) {
        auto text = utf8_of(bytes);
        if (!text || text->find('\0') != std::string::npos)
            return refuse(Fault::bad_case, "file",
                          "is no text: it is cut within UTF-16, or has a character 0");
        return ForeignText{*std::move(text), wide ? TextEncoding::utf16 : TextEncoding::utf8};
    }
    if (has_only_pairs_of_gb2312(bytes))
        if (auto text = converted(bytes, "GBK"))
            return ForeignText{*std::move(text), TextEncoding::gbk};
    auto text = converted(bytes, "ISO-8859-1");
    if (!text) return refuse(Fault::bad_case, "file", "is no text");
    return ForeignText{*std::move(text), TextEncoding::latin1};
}

} // namespace axiscal
