// [webhook] of the station file.

#include "config/webhook_address.hpp"
#include "tests/unit/config/station_text.hpp"

#include <gtest/gtest.h>
#include <string>

namespace axiscal::webhook_config_test {
namespace {

using test::example_text;
using test::read_text;

std::string with_webhook(const std::string& lines) {
    std::string text = example_text();
    return text.insert(text.find("[certificate]"), "[webhook]\n" + lines + "\n");
}

const std::string usual = "url = \"https://alarms.shop.example:8443/hook?line=3\"\n"
                          "secret_file = \"/etc/axiscal/webhook.secret\"\n";

TEST(WebhookConfig, IsAbsentWithoutItsTable) {
    EXPECT_FALSE(read_text(example_text()).config.webhook);
}

TEST(WebhookConfig, TellsOfBothUnlessOneIsNamed) {
    const auto both = read_text(with_webhook(usual));
    EXPECT_EQ(both.told, "");
    ASSERT_TRUE(both.config.webhook);
    EXPECT_TRUE(both.config.webhook->on_complete && both.config.webhook->on_fault);
    EXPECT_EQ(both.config.webhook->place, "https://alarms.shop.example:8443");
    const auto one = read_text(with_webhook(usual + "on = [\"fault\"]"));
    EXPECT_FALSE(one.config.webhook->on_complete);
    EXPECT_TRUE(one.config.webhook->on_fault);
}

TEST(WebhookConfig, RefusesKindsThatAreNone) {
    EXPECT_NE(read_text(with_webhook(usual + "on = [\"faults\"]")).told.find("webhook.on"),
              std::string::npos);
    EXPECT_NE(read_text(with_webhook(usual + "on = []")).told.find("is empty"), std::string::npos);
}

TEST(WebhookConfig, RefusesAnAddressWithAnAccountWithoutQuotingIt) {
    const auto reading = read_text(with_webhook("url = \"https://me:hunter2@host/\"\n"
                                                "secret_file = \"/s\""));
    EXPECT_NE(reading.told.find("webhook.url"), std::string::npos) << reading.told;
    EXPECT_EQ(reading.told.find("hunter2"), std::string::npos) << reading.told;
}

TEST(WebhookConfig, WarnsOfClearTextInTheShopAndRefusesItBeyond) {
    const auto inside = read_text(with_webhook("url = \"http://192.168.1.4:8080/\"\n"
                                               "secret_file = \"/s\""));
    EXPECT_EQ(inside.told, "");
    bool warned = false;
    for (const Refusal& warning : inside.config.warnings)
        warned = warned || warning.key == "webhook.url";
    EXPECT_TRUE(warned);
    const auto beyond = read_text(with_webhook("url = \"http://alarms.example/\"\n"
                                               "secret_file = \"/s\""));
    EXPECT_NE(beyond.told.find("clear text"), std::string::npos) << beyond.told;
}

TEST(WebhookAddress, HasServerAndPort) {
    const auto plain = parse_webhook_address("https://alarms.shop.example").value();
    EXPECT_EQ(plain.host, "alarms.shop.example");
    EXPECT_EQ(plain.port, 443);
    const auto six = parse_webhook_address("http://[fd00::2]:8080/a").value();
    EXPECT_EQ(six.host, "fd00::2");
    EXPECT_EQ(six.port, 8080);
    EXPECT_EQ(six.place, "http://[fd00::2]:8080");
}

TEST(WebhookAddress, IsRefusedWhereItIsNone) {
    for (const char* url :
         {"", "ftp://host/", "https://", "https:///path", "https://a b/", "https://host:0/",
          "https://host:70000/", "https://host:x/", "https://[fd00::2/", "https://[fd00::2]x/",
          "https://[host]/", "https://h\xC3\xB6st/", "https://host/#part", "https://-host/",
          "HTTPS://host/", "http://8.8.8.8/", "http://localhost.example/", "http://[2001:db8::1]/"})
        EXPECT_FALSE(parse_webhook_address(url)) << url;
}

TEST(WebhookAddress, KnowsWhatIsPrivate) {
    for (const char* host : {"localhost", "127.0.0.1", "10.1.2.3", "172.16.0.1", "172.31.255.1",
                             "192.168.0.9", "169.254.1.1", "::1", "fd00::2", "fe80::1"})
        EXPECT_TRUE(is_private_host(host)) << host;
    for (const char* host : {"172.32.0.1", "11.0.0.1", "192.169.0.1", "2001:db8::1", "shop"})
        EXPECT_FALSE(is_private_host(host)) << host;
}

} // namespace
} // namespace axiscal::webhook_config_test
