#include "acquisition/console/access.hpp"

#include <gtest/gtest.h>

namespace axiscal::access_test {
namespace {

AccessRules rules() {
    const std::vector<std::string> allowed{"station7.shop.example"};
    return {known_hosts_of("127.0.0.1", 8470, allowed), std::string(64, 'a'),
            page_hosts_of("127.0.0.1", 8470, allowed)};
}

RequestHead over_tcp(bool changes_state) {
    RequestHead head;
    head.door = Door::tcp;
    head.changes_state = changes_state;
    head.host = "127.0.0.1:8470";
    return head;
}

TEST(Access, EverybodyReadsOverTcp) {
    EXPECT_EQ(judge_access(over_tcp(false), rules()).status, 200U);
}

TEST(Access, NobodyChangesStateOverTcpWithoutTheToken) {
    EXPECT_EQ(judge_access(over_tcp(true), rules()).status, 401U);
}

TEST(Access, TheTokenChangesStateOverTcp) {
    RequestHead head = over_tcp(true);
    head.authorization = "Bearer " + std::string(64, 'a');
    EXPECT_EQ(judge_access(head, rules()).status, 200U);
}

TEST(Access, ANearlyRightTokenIsRefused) {
    for (const std::string& wrong :
         {std::string(63, 'a'), std::string(65, 'a'), std::string(63, 'a') + "b", std::string{}}) {
        RequestHead head = over_tcp(true);
        head.authorization = "Bearer " + wrong;
        EXPECT_EQ(judge_access(head, rules()).status, 401U) << wrong;
    }
}

TEST(Access, AnEmptyTokenFileOpensNothing) {
    AccessRules open = rules();
    open.token.clear();
    RequestHead head = over_tcp(true);
    head.authorization = "Bearer ";
    EXPECT_EQ(judge_access(head, open).status, 401U);
}

TEST(Access, TheUnixSocketChangesState) {
    RequestHead head;
    head.door = Door::unix_socket;
    head.changes_state = true;
    EXPECT_EQ(judge_access(head, rules()).status, 200U);
}

TEST(Access, AnUnknownHostIsRefusedEvenForReading) {
    RequestHead head = over_tcp(false);
    for (const char* host : {"evil.example", "", "127.0.0.1:80", "127.0.0.1:84700"}) {
        head.host = host;
        EXPECT_EQ(judge_access(head, rules()).status, 421U) << host;
    }
}

TEST(Access, ConfiguredHostsAreKnownWithAndWithoutPort) {
    RequestHead head = over_tcp(false);
    for (const char* host :
         {"station7.shop.example", "station7.shop.example:8470", "localhost:8470", "[::1]:8470"}) {
        head.host = host;
        EXPECT_EQ(judge_access(head, rules()).status, 200U) << host;
    }
}

TEST(Access, AForeignOriginIsRefusedOnBothDoors) {
    for (const Door door : {Door::tcp, Door::unix_socket}) {
        RequestHead head = over_tcp(false);
        head.door = door;
        head.origin = "http://evil.example";
        EXPECT_EQ(judge_access(head, rules()).status, 403U);
        head.origin = "null";
        EXPECT_EQ(judge_access(head, rules()).status, 403U);
        head.origin = "http://127.0.0.1:8470";
        EXPECT_EQ(judge_access(head, rules()).status, 200U);
    }
}

// RFC 9110, 4.2.3 and 11.1: neither case nor the dot behind a full name tells hosts apart.
TEST(Access, ANameIsKnownInAnyCase) {
    AccessRules known{known_hosts_of("::1", 8470, {"BAY3-PC", "bay3.shop.example."}),
                      std::string(64, 'a')};
    for (const char* host : {"bay3-pc:8470", "BAY3-PC", "Bay3-Pc.:8470", "LOCALHOST", "localhost.",
                             "bay3.shop.example:8470", "[::1]:8470", "[::1]"}) {
        RequestHead head = over_tcp(true);
        head.host = host;
        head.origin = std::string{"HTTP://"} + host;
        head.authorization = "bearer  " + std::string(64, 'a');
        EXPECT_EQ(judge_access(head, known).status, 200U) << host;
    }
    for (const char* host : {"bay3-pc.:8471", "bay3", "", ".", "localhost..", "[::1"}) {
        RequestHead head = over_tcp(false);
        head.host = host;
        EXPECT_EQ(judge_access(head, known).status, 421U) << host;
    }
}

TEST(Access, TheLettersOfATokenKeepTheirCase) {
    RequestHead head = over_tcp(true);
    head.authorization = "Bearer " + std::string(64, 'A');
    EXPECT_EQ(judge_access(head, rules()).status, 401U);
}

/// An order of a browser that is paired.
RequestHead from_page(const std::string& origin) {
    RequestHead head = over_tcp(true);
    head.page = "tablet 2";
    head.origin = origin;
    return head;
}

TEST(Access, APairedBrowserOrdersFromAPageOfTheStation) {
    for (const char* own : {"http://127.0.0.1:8470", "http://localhost:8470", "http://[::1]:8470",
                            "http://station7.shop.example:8470", "https://station7.shop.example",
                            "HTTP://LocalHost:8470"}) {
        const AccessVerdict verdict = judge_access(from_page(own), rules());
        EXPECT_EQ(verdict.status, 200U) << own;
        EXPECT_TRUE(verdict.by_page);
    }
}

TEST(Access, APairedBrowserOrdersFromNoOtherPage) {
    for (const char* foreign :
         {"http://evil.example", "null", "", "http://localhost", "http://127.0.0.1",
          "http://localhost:80", "http://localhost:8471", "http://localhost:8470.evil.example",
          "ftp://localhost:8470", "http://localhost:8470/"})
        EXPECT_EQ(judge_access(from_page(foreign), rules()).status, 403U) << foreign;
}

TEST(Access, AtTheUsualPortOfTheWebNoPortStandsInAnOrigin) {
    AccessRules at_80{known_hosts_of("127.0.0.1", 80, {}), std::string(64, 'a'),
                      page_hosts_of("127.0.0.1", 80, {})};
    RequestHead head = from_page("http://localhost");
    head.host = "localhost";
    EXPECT_EQ(judge_access(head, at_80).status, 200U);
}

TEST(Access, TheTokenStaysTheTokenBesideACookie) {
    RequestHead head = from_page("");
    head.authorization = "Bearer " + std::string(64, 'a');
    const AccessVerdict verdict = judge_access(head, rules());
    EXPECT_EQ(verdict.status, 200U);
    EXPECT_FALSE(verdict.by_page);
}

TEST(Access, ACookieThatProvesNobodyIsNoCookie) {
    RequestHead head = over_tcp(true);
    head.origin = "http://localhost:8470";
    head.cookies = "axiscal_session=" + std::string(43, 'A');
    EXPECT_EQ(judge_access(head, rules()).status, 401U);
}

TEST(Access, ACodeIsBorneByAPageOfTheStationAlone) {
    for (const Door door : {Door::tcp, Door::unix_socket}) {
        RequestHead head = over_tcp(true);
        head.door = door;
        head.matter = Matter::opening_session;
        EXPECT_EQ(judge_access(head, rules()).status, 403U);
        head.authorization = "Bearer " + std::string(64, 'a');
        EXPECT_EQ(judge_access(head, rules()).status, 403U);
        head.origin = "http://localhost:8471";
        EXPECT_EQ(judge_access(head, rules()).status, 403U);
        head.origin = "http://localhost:8470";
        EXPECT_EQ(judge_access(head, rules()).status, 200U);
    }
}

TEST(Access, BrowsersArePairedAtTheUnixSocketAlone) {
    RequestHead head = from_page("http://localhost:8470");
    head.matter = Matter::pairing;
    head.authorization = "Bearer " + std::string(64, 'a');
    for (const bool changes : {false, true}) {
        head.changes_state = changes;
        head.door = Door::tcp;
        EXPECT_EQ(judge_access(head, rules()).status, 403U);
        head.door = Door::unix_socket;
        EXPECT_EQ(judge_access(head, rules()).status, 200U);
    }
}

TEST(Access, ABrowserIsSentWhereTheStationAnswersIt) {
    EXPECT_EQ(page_address("127.0.0.1", 8470, {}), "http://127.0.0.1:8470/");
    EXPECT_EQ(page_address("::1", 8470, {}), "http://[::1]:8470/");
    EXPECT_EQ(page_address("192.168.10.5", 80, {}), "http://192.168.10.5/");
    EXPECT_EQ(page_address("0.0.0.0", 8470, {"bay3.shop.example"}),
              "http://bay3.shop.example:8470/");
    EXPECT_EQ(page_address("0.0.0.0", 8470, {"bay3.shop.example:9000"}),
              "http://bay3.shop.example:9000/");
    EXPECT_EQ(page_address("::", 8470, {}), "http://localhost:8470/");
    EXPECT_EQ(page_address("127.0.0.1", 8470, {}, true), "https://127.0.0.1:8470/");
    EXPECT_EQ(page_address("0.0.0.0", 443, {"bay3.shop.example"}, true),
              "https://bay3.shop.example/");
    EXPECT_EQ(page_address("192.168.10.5", 80, {}, true), "https://192.168.10.5:80/");
}

TEST(Access, BehindTlsAPageThatCameWithoutItIsForeign) {
    AccessRules strict = rules();
    strict.tls = true;
    RequestHead head = over_tcp(true);
    head.page = "tablet";
    head.origin = "http://127.0.0.1:8470";
    EXPECT_EQ(judge_access(head, rules()).status, 200U);
    EXPECT_EQ(judge_access(head, strict).status, 403U);
    head.changes_state = false;
    EXPECT_EQ(judge_access(head, strict).status, 403U);
    head.changes_state = true;
    head.origin = "HTTPS://127.0.0.1:8470";
    EXPECT_EQ(judge_access(head, strict).status, 200U);
    head.authorization = "Bearer " + std::string(64, 'a'); // a program has no Origin
    head.origin.clear();
    EXPECT_EQ(judge_access(head, strict).status, 200U);
}

TEST(Access, BehindTlsThePortThatBrowsersLeaveOutIs443) {
    AccessRules strict = rules();
    strict.tls = true;
    strict.known_hosts = known_hosts_of("127.0.0.1", 443, {});
    strict.page_hosts = page_hosts_of("127.0.0.1", 443, {}, true);
    RequestHead head = over_tcp(true);
    head.host = "127.0.0.1";
    head.page = "tablet";
    head.origin = "https://127.0.0.1";
    EXPECT_EQ(judge_access(head, strict).status, 200U);
    strict.page_hosts = page_hosts_of("127.0.0.1", 80, {}, true);
    EXPECT_EQ(judge_access(head, strict).status, 403U) << "another program's page at port 443";
}

} // namespace
} // namespace axiscal::access_test
