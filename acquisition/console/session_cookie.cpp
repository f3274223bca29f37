#include "acquisition/console/session_cookie.hpp"

#include <algorithm>

namespace axiscal {
namespace {

constexpr std::string_view base64url_letters =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";

std::string_view without_blanks(std::string_view text) {
    const auto begin = text.find_first_not_of(" \t");
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

bool can_be_token(std::string_view value) {
    return value.size() == token_letters &&
           value.find_first_not_of(base64url_letters) == std::string_view::npos;
}

} // namespace

std::string base64url(std::span<const std::uint8_t> bytes) {
    std::string text;
    unsigned held = 0, bits = 0; // not written yet
    for (const std::uint8_t byte : bytes) {
        held = (held << 8U | byte) & 0xFFFFU;
        for (bits += 8; bits >= 6; bits -= 6)
            text += base64url_letters[held >> (bits - 6) & 63U];
    }
    if (bits > 0) text += base64url_letters[held << (6 - bits) & 63U];
    return text;
}

std::string_view token_in_cookies(std::string_view cookies) {
    while (!cookies.empty()) {
        const std::size_t end = std::min(cookies.find(';'), cookies.size());
        const std::string_view pair = without_blanks(cookies.substr(0, end));
        cookies.remove_prefix(std::min(end + 1, cookies.size()));
        const std::size_t equals = pair.find('=');
        if (equals == std::string_view::npos || pair.substr(0, equals) != session_cookie_name)
            continue;
        const std::string_view value = pair.substr(equals + 1);
        return can_be_token(value) ? value : std::string_view{};
    }
    return {};
}

std::string set_cookie_text(std::string_view token, std::chrono::seconds lasts, bool secure) {
    std::string text{session_cookie_name};
    text.append("=").append(token).append("; HttpOnly; SameSite=Strict; Path=/; Max-Age=");
    text += std::to_string(token.empty() ? 0 : lasts.count());
    return secure ? text + "; Secure" : text;
}

} // namespace axiscal
