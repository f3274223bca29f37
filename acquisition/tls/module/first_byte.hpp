#pragma once
// What the first byte of a connection tells, before TLS looks at any. Pure.

#include <cstdint>
#include <string>

namespace axiscal::tls {

enum class FirstByte : std::uint8_t { handshake, http, other };

/// A record of TLS begins with 22, "handshake" (RFC 8446, 5.1; SSL 3 and newer); a method of HTTP
/// begins with a capital letter.
inline FirstByte judge_first_byte(unsigned char byte) {
    constexpr unsigned char handshake = 22;
    if (byte == handshake) return FirstByte::handshake;
    return byte >= 'A' && byte <= 'Z' ? FirstByte::http : FirstByte::other;
}

/// For a browser or program that asks without TLS: as the console answers what is no request. It
/// sends nobody elsewhere, because the name that he asked for is not to be trusted here.
inline std::string answer_without_tls() {
    const std::string body =
        "{\"error\":{\"fault\":\"bad_request\",\"sentence\":\"This door speaks TLS: the address "
        "begins with https://\"}}\n";
    return "HTTP/1.1 400 Bad Request\r\nContent-Type: application/json; charset=utf-8\r\n"
           "Cache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\nConnection: close\r\n"
           "Content-Length: " +
           std::to_string(body.size()) + "\r\n\r\n" + body;
}

} // namespace axiscal::tls
