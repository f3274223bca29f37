#include "acquisition/console/session_cookie.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace axiscal::session_cookie_test {
namespace {

const std::string token = "AbCdEfGhIjKlMnOpQrStUvWxYz0123456789-_AbCdE";

TEST(SessionCookie, IsFoundAmongOthers) {
    ASSERT_EQ(token.size(), token_letters);
    for (const std::string& cookies :
         {"axiscal_session=" + token, "theme=dark; axiscal_session=" + token + "; a=b",
          " axiscal_session=" + token + " ;", ";;a;axiscal_session=" + token})
        EXPECT_EQ(token_in_cookies(cookies), token) << cookies;
}

TEST(SessionCookie, WhatCanBeNoTokenIsNone) {
    for (const std::string& cookies :
         {std::string{}, std::string{"axiscal_session="}, "axiscal_session=" + token + "x",
          "axiscal_session=" + token.substr(1), "axiscal_session=\"" + token + "\"",
          "axiscal_session=" + token.substr(1) + "+", "Axiscal_session=" + token,
          "xaxiscal_session=" + token, "axiscal_session2=" + token, token})
        EXPECT_EQ(token_in_cookies(cookies), "") << cookies;
}

TEST(SessionCookie, OfSeveralTheFirstCounts) {
    const std::string other(token_letters, 'B');
    EXPECT_EQ(token_in_cookies("axiscal_session=" + token + "; axiscal_session=" + other), token);
    EXPECT_EQ(token_in_cookies("axiscal_session=x; axiscal_session=" + other), "");
}

TEST(SessionCookie, IsKeptFromScriptsAndFromOtherSites) {
    EXPECT_EQ(set_cookie_text(token, std::chrono::seconds{60}, false),
              "axiscal_session=" + token + "; HttpOnly; SameSite=Strict; Path=/; Max-Age=60");
    EXPECT_TRUE(set_cookie_text(token, std::chrono::seconds{60}, true).ends_with("; Secure"));
    EXPECT_EQ(set_cookie_text("", std::chrono::seconds{60}, false),
              "axiscal_session=; HttpOnly; SameSite=Strict; Path=/; Max-Age=0");
}

// RFC 4648, 10, in the alphabet of 5 and without padding.
TEST(Base64url, IsThatOfTheStandard) {
    const auto of = [](const std::string& text) {
        return base64url(std::vector<std::uint8_t>{text.begin(), text.end()});
    };
    EXPECT_EQ(of(""), "");
    EXPECT_EQ(of("f"), "Zg");
    EXPECT_EQ(of("fo"), "Zm8");
    EXPECT_EQ(of("foo"), "Zm9v");
    EXPECT_EQ(of("foobar"), "Zm9vYmFy");
    EXPECT_EQ(base64url(std::vector<std::uint8_t>{0xfb, 0xff, 0xbf}), "-_-_");
    EXPECT_EQ(base64url(std::vector<std::uint8_t>(token_bytes, 0)).size(), token_letters);
}

} // namespace
} // namespace axiscal::session_cookie_test
