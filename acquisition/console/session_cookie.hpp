#pragma once
// The cookie by which a paired browser is known (RFC 6265), and its token as text. Pure.

#include "analysis/quantity/time.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace axiscal {

inline constexpr std::string_view session_cookie_name = "axiscal_session";
inline constexpr std::size_t token_bytes = 32;   ///< 256 bit
inline constexpr std::size_t token_letters = 43; ///< of base64url

/// RFC 4648, 5, without padding.
std::string base64url(std::span<const std::uint8_t> bytes);

/// The token in a Cookie header; empty where it holds none, or what can be none. Of several
/// cookies of the name the first counts: a browser sends the one of the longest path first.
std::string_view token_in_cookies(std::string_view cookies);

/// A Set-Cookie header. @param token  empty: the browser forgets its own
/// @param secure  the door speaks TLS: the browser sends it over nothing else
std::string set_cookie_text(std::string_view token, std::chrono::seconds lasts, bool secure);

} // namespace axiscal
