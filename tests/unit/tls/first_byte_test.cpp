#include "acquisition/tls/module/first_byte.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace axiscal::first_byte_test {
namespace {

using tls::FirstByte;
using tls::judge_first_byte;

TEST(FirstByteOfAClient, IsThatOfAHandshakeOfHttpOrOfNothingKnown) {
    int handshakes = 0, requests = 0;
    for (int byte = 0; byte < 256; ++byte) {
        const FirstByte judged = judge_first_byte(static_cast<unsigned char>(byte));
        handshakes += judged == FirstByte::handshake ? 1 : 0;
        requests += judged == FirstByte::http ? 1 : 0;
    }
    EXPECT_EQ(handshakes, 1);
    EXPECT_EQ(requests, 26);
    EXPECT_EQ(judge_first_byte(0x16), FirstByte::handshake);
    for (const unsigned char method : {'G', 'P', 'D', 'H', 'O'})
        EXPECT_EQ(judge_first_byte(method), FirstByte::http);
}

TEST(FirstByteOfAClient, TheAnswerWithoutTlsIsWholeAndOfTheFormOfTheOthers) {
    const std::string answer = tls::answer_without_tls();
    const std::size_t body = answer.find("\r\n\r\n") + 4;
    EXPECT_NE(answer.find("Content-Length: " + std::to_string(answer.size() - body) + "\r\n"),
              std::string::npos);
    const auto error = nlohmann::json::parse(answer.substr(body)).at("error");
    EXPECT_EQ(error.at("fault"), "bad_request");
    EXPECT_NE(error.at("sentence").get<std::string>().find("https://"), std::string::npos);
}

} // namespace
} // namespace axiscal::first_byte_test
