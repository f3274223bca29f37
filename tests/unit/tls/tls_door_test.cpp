// The door of axiscald-tls.so, which this program loads as the daemon does: real sockets, a client
// of OpenSSL on one side, clear bytes on the other.
#include "acquisition/tls/tls_loading.hpp"

#include "tests/support/scratch_folder.hpp"
#include "tests/unit/tls/tls_client.hpp"

#include <boost/asio/local/connect_pair.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <gtest/gtest.h>

#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <vector>

namespace axiscal::tls_door_test {
namespace {

namespace asio = boost::asio;
using Plain = asio::local::stream_protocol::socket;
using test::heard_until;

/// What the door tells, in turn.
class Told {
public:
    void take(TlsTold told) {
        const std::lock_guard lock{mutex_};
        all_.push_back(std::move(told));
        news_.notify_all();
    }
    /// The next one; of an empty kind after ten seconds.
    TlsTold next() {
        std::unique_lock lock{mutex_};
        if (!news_.wait_for(lock, std::chrono::seconds{10}, [this] { return !all_.empty(); }))
            return {TlsNews::kept, "nobody", "nothing was told"};
        TlsTold told = std::move(all_.front());
        all_.pop_front();
        return told;
    }

private:
    std::mutex mutex_;
    std::condition_variable news_;
    std::deque<TlsTold> all_;
};

class OnTheTlsDoor : public ::testing::Test {
protected:
    void SetUp() override {
        files = {test::write_secret(folder.path(), "certificate.pem", made.certificate),
                 test::write_secret(folder.path(), "key.pem", made.key)};
        limits.look = std::chrono::milliseconds{0};
    }
    void TearDown() override {
        if (door) door->stop();
        if (runner.joinable()) runner.join();
        door.reset();
    }
    void open() {
        const auto module = load_tls_module();
        ASSERT_TRUE(module) << module.error().detail;
        door =
            (*module)->open(files, limits, [this](TlsTold told) { told_.take(std::move(told)); });
        ASSERT_NE(door, nullptr);
        runner = std::jthread{[this] { door->run(); }};
        listener.listen();
    }
    [[nodiscard]] unsigned short port() const { return listener.local_endpoint().port(); }
    /// Takes the next client, as the console does. @returns the program's end
    Plain take(const std::string& address = "127.0.0.1") {
        test::Tcp client = listener.accept();
        Plain ours{loop}, theirs{loop};
        asio::local::connect_pair(ours, theirs);
        timeval limit{10, 0};
        ::setsockopt(ours.native_handle(), SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
        door->carry(client.release(), theirs.release(), address);
        return ours;
    }
    /// A client that has shaken hands; the program's end of it becomes `plain`.
    std::unique_ptr<test::TlsClient> meet(Plain& plain, const std::string& trusted) {
        std::unique_ptr<test::TlsClient> client;
        std::jthread connecting{
            [&] { client = std::make_unique<test::TlsClient>(port(), trusted); }};
        plain = take();
        connecting.join();
        return client;
    }
    test::Tcp connect_in_clear() {
        test::Tcp socket{loop};
        socket.connect({asio::ip::make_address("127.0.0.1"), port()});
        test::bound(socket);
        return socket;
    }

    testing::ScratchFolder folder;
    test::MadeCertificate made = test::make_certificate();
    TlsFiles files;
    TlsLimits limits;
    Told told_;
    std::unique_ptr<TlsDoor> door;
    std::jthread runner;
    asio::io_context loop;
    asio::ip::tcp::acceptor listener{loop, {asio::ip::make_address("127.0.0.1"), 0}};
};

TEST_F(OnTheTlsDoor, WhatIsSaidOnOneSideIsHeardOnTheOther) {
    open();
    Plain plain{loop};
    const auto client = meet(plain, made.certificate);
    EXPECT_EQ(client->protocol(), "TLSv1.3");
    client->say("a question\n");
    EXPECT_EQ(heard_until(plain, "\n"), "a question\n");
    const std::string long_answer(200'000, 'a');
    std::jthread answering{[&] { asio::write(plain, asio::buffer(long_answer + "\n")); }};
    EXPECT_EQ(client->until("\n").size(), long_answer.size() + 1);
}

TEST_F(OnTheTlsDoor, TheEndOfTheProgramIsAnEndInOrder) {
    open();
    Plain plain{loop};
    const auto client = meet(plain, made.certificate);
    asio::write(plain, asio::buffer(std::string{"the last words"}));
    plain.close();
    EXPECT_EQ(client->until(test::to_the_end), "the last words");
    EXPECT_EQ(client->next_error(), asio::error::eof) << "the alert close_notify has come";
}

TEST_F(OnTheTlsDoor, TheLastWordsReachAClientThatIsStillSending) {
    open();
    Plain plain{loop};
    const auto client = meet(plain, made.certificate);
    client->say(std::string(4000, 'x'));
    asio::write(plain, asio::buffer(std::string{"too much"}));
    plain.close(); // without a look at what came
    boost::system::error_code ignored;
    EXPECT_EQ(client->until("too much"), "too much");
}

TEST_F(OnTheTlsDoor, TheProgramSeesThatAClientHasGone) {
    open();
    Plain plain{loop};
    auto client = meet(plain, made.certificate);
    client.reset();
    EXPECT_EQ(heard_until(plain, "never"), "");
}

TEST_F(OnTheTlsDoor, WhoAsksWithoutTlsIsToldSo) {
    open();
    test::Tcp socket = connect_in_clear();
    Plain plain = take("192.168.10.7");
    asio::write(socket, asio::buffer(std::string{"GET / HTTP/1.1\r\nHost: localhost\r\n\r\n"}));
    const std::string answer = heard_until(socket, "\n\n\n never");
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 400")) << answer;
    EXPECT_NE(answer.find("https://"), std::string::npos);
    EXPECT_EQ(heard_until(plain, "never"), "") << "the program hears none of it";
    const TlsTold told = told_.next();
    EXPECT_EQ(told.news, TlsNews::turned_away);
    EXPECT_EQ(told.address, "192.168.10.7");
    EXPECT_EQ(told.words, "it spoke HTTP without TLS");
}

TEST_F(OnTheTlsDoor, GarbageIsHungUpOn) {
    open();
    for (const std::string& garbage :
         {std::string{"\0\0\0", 3}, std::string{"\xff\xfe"}, std::string{"ssh\r\n"}}) {
        test::Tcp socket = connect_in_clear();
        Plain plain = take();
        asio::write(socket, asio::buffer(garbage));
        EXPECT_EQ(heard_until(socket, "never"), "");
        EXPECT_EQ(told_.next().words, "what it sent was no TLS");
    }
    test::Tcp socket = connect_in_clear();
    Plain plain = take();
    asio::write(socket, asio::buffer(std::string{"\x16 and then nothing of TLS, for long enough"}));
    heard_until(socket, "never");
    EXPECT_TRUE(told_.next().words.starts_with("its TLS handshake failed: "));
}

TEST_F(OnTheTlsDoor, Tls1Point1IsRefusedWithTheAlertOfItsOwn) {
    open();
    test::Tcp socket = connect_in_clear();
    Plain plain = take();
    asio::write(socket, asio::buffer(test::hello_of_tls_1_1()));
    const std::string alert = heard_until(socket, "never");
    ASSERT_EQ(alert.size(), 7U);
    EXPECT_EQ(alert[0], 21) << "a record of alerts";
    EXPECT_EQ(alert[5], 2) << "fatal";
    EXPECT_EQ(alert[6], 70) << "protocol_version (RFC 8446, 6.2)";
}

TEST_F(OnTheTlsDoor, AClientThatDoesNotTrustTheCertificateIsToldOf) {
    open();
    std::jthread connecting{[this] {
        EXPECT_ANY_THROW(test::TlsClient(port(), test::make_certificate().certificate));
    }};
    Plain plain = take();
    EXPECT_EQ(heard_until(plain, "never"), "");
    const TlsTold told = told_.next();
    EXPECT_EQ(told.news, TlsNews::turned_away);
    EXPECT_NE(told.words.find("TLS handshake"), std::string::npos) << told.words;
}

TEST_F(OnTheTlsDoor, AHandshakeThatStallsEnds) {
    limits.handshake = std::chrono::milliseconds{500};
    open();
    std::vector<test::Tcp> crowd;
    std::vector<Plain> ends;
    for (int nth = 0; nth < 64; ++nth) {
        crowd.push_back(connect_in_clear());
        asio::write(crowd.back(), asio::buffer(std::string{"\x16\x03\x01"}));
        ends.push_back(take());
    }
    for (std::size_t nth = 0; nth < crowd.size(); ++nth) {
        EXPECT_EQ(heard_until(crowd[nth], "never"), "");
        EXPECT_EQ(heard_until(ends[nth], "never"), "");
        EXPECT_EQ(told_.next().words, "its TLS handshake took too long");
    }
}

TEST_F(OnTheTlsDoor, AStalledHandshakeHoldsUpNobodyElse) {
    open();
    test::Tcp stalled = connect_in_clear();
    Plain its_end = take();
    asio::write(stalled, asio::buffer(std::string{"\x16\x03\x01"}));
    Plain plain{loop};
    const auto client = meet(plain, made.certificate);
    client->say("here\n");
    EXPECT_EQ(heard_until(plain, "\n"), "here\n");
}

TEST_F(OnTheTlsDoor, AClientThatTakesNothingEnds) {
    limits.taking = std::chrono::milliseconds{50};
    open();
    Plain plain{loop};
    const auto client = meet(plain, made.certificate);
    boost::system::error_code error; // what fits into the buffers of the kernel is written at first
    const std::string flood(std::size_t{64} << 20U, 'f');
    asio::write(plain, asio::buffer(flood), error);
    EXPECT_TRUE(error);
}

TEST_F(OnTheTlsDoor, RenewedFilesServeTheNextClientAndBadOnesDoNot) {
    open();
    Plain before{loop};
    const auto first = meet(before, made.certificate);
    const test::MadeCertificate renewed = test::make_certificate();
    test::write_secret(folder.path(), "certificate.pem",
                       renewed.certificate); // and not yet the key
    Plain between{loop};
    const auto second = meet(between, made.certificate);
    const TlsTold kept = told_.next();
    EXPECT_EQ(kept.news, TlsNews::kept);
    EXPECT_NE(kept.words.find("does not belong to"), std::string::npos) << kept.words;
    test::write_secret(folder.path(), "key.pem", renewed.key);
    Plain after{loop};
    const auto third = meet(after, renewed.certificate);
    EXPECT_EQ(told_.next().news, TlsNews::renewed);
    for (test::TlsClient* const client : {first.get(), second.get(), third.get()})
        client->say("still here\n");
    for (Plain* const plain : {&before, &between, &after})
        EXPECT_EQ(heard_until(*plain, "\n"), "still here\n");
}

TEST_F(OnTheTlsDoor, TheEndOfTheDoorEndsEverybody) {
    open();
    Plain plain{loop};
    const auto client = meet(plain, made.certificate);
    door->stop();
    runner.join();
    door.reset();
    EXPECT_EQ(heard_until(plain, "never"), "");
    EXPECT_EQ(client->until("never"), "");
}

} // namespace
} // namespace axiscal::tls_door_test
