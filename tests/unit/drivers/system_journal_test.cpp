// What systemd's journal is told, against its page "Native Journal Protocol" and systemd.exec(5) of
// systemd 252; its socket is one of the test's own.
#include "drivers/loop/system_journal.hpp"

#include "drivers/loop/line_writer.hpp"
#include "tests/support/scratch_folder.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <fcntl.h>
#include <memory>
#include <optional>
#include <poll.h>
#include <random>
#include <sstream>
#include <string>
#include <string_view>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace axiscal::system_journal_test {
namespace {

constexpr int patience_ms = 20'000; // bounds a failing test

using Fields = std::vector<std::pair<std::string, std::string>>;

/// As the journal reads a datagram; nothing where it would not take it.
std::optional<Fields> fields_of(std::string_view entry) {
    Fields fields;
    while (!entry.empty()) {
        const std::size_t end = entry.find('\n'), sign = entry.substr(0, end).find('=');
        if (end == std::string_view::npos) return std::nullopt;
        std::string name{entry.substr(0, sign == std::string_view::npos ? end : sign)};
        std::string_view value = entry.substr(0, end);
        if (sign == std::string_view::npos) {
            entry.remove_prefix(end + 1);
            if (entry.size() < 8) return std::nullopt;
            std::uint64_t size = 0;
            for (std::size_t byte = 8; byte-- > 0;)
                size = size << 8 | static_cast<unsigned char>(entry[byte]);
            if (entry.size() - 8 <= size || entry[8 + size] != '\n') return std::nullopt;
            value = entry.substr(8, size);
            entry.remove_prefix(8 + size + 1);
        } else {
            value.remove_prefix(sign + 1);
            entry.remove_prefix(end + 1);
        }
        fields.emplace_back(std::move(name), value);
    }
    return fields;
}

LogLine line_about(std::string text, LogFacts facts) {
    return {std::move(text), 4, std::move(facts)};
}

/// The journal's two doors: its socket, and the stream that is some service's stderr, here a file.
struct Journal {
    testing::ScratchFolder folder;
    int socket = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    int stream =
        ::open(folder.file("stream").c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0600);

    Journal() {
        ::sockaddr_un address{AF_UNIX, {}};
        place().copy(address.sun_path, sizeof address.sun_path - 1);
        EXPECT_EQ(::bind(socket, reinterpret_cast<const ::sockaddr*>(&address), sizeof address), 0);
        EXPECT_GE(stream, 0);
    }
    ~Journal() {
        hang_up();
        ::close(stream);
    }
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    [[nodiscard]] std::string place() const { return folder.file("socket"); }
    void hang_up() {
        if (socket >= 0) ::close(socket);
        socket = -1;
    }
    /// One datagram; empty when none comes.
    [[nodiscard]] std::string heard() const {
        ::pollfd ready{socket, POLLIN, 0};
        std::array<char, 1024> bytes{};
        if (::poll(&ready, 1, patience_ms) != 1) return {};
        const auto count = ::recv(socket, bytes.data(), bytes.size(), 0);
        return count > 0 ? std::string{bytes.data(), static_cast<std::size_t>(count)} : "";
    }
    [[nodiscard]] bool heard_nothing() const {
        ::pollfd ready{socket, POLLIN, 0};
        return ::poll(&ready, 1, 0) == 0;
    }
    /// What the stream got since it was asked last.
    [[nodiscard]] std::string streamed() const {
        std::string text = testing::read_bytes(folder.file("stream"));
        EXPECT_EQ(::ftruncate(stream, 0), 0);
        return text;
    }
};

TEST(SystemJournal, HasAFieldForEachFactAndNoneForWhatNobodyKnows) {
    EXPECT_EQ(journal_entry({"ready\n", 6, {}}),
              "MESSAGE=ready\nPRIORITY=6\nSYSLOG_FACILITY=3\nSYSLOG_IDENTIFIER=axiscald\n");
    EXPECT_EQ(journal_entry(line_about("laser: no beam\n",
                                       {Fault::beam_lost, "bay-3-X-20261124T101500Z", "laser"})),
              "MESSAGE=laser: no beam\nPRIORITY=4\nSYSLOG_FACILITY=3\n"
              "SYSLOG_IDENTIFIER=axiscald\nAXISCAL_FAULT=beam_lost\n"
              "AXISCAL_RUN=bay-3-X-20261124T101500Z\nAXISCAL_INSTRUMENT=laser\n");
}

TEST(SystemJournal, TellsTheLengthOfAValueWithALineFeed) {
    const std::string entry = journal_entry({"a\nAXISCAL_RUN=forged\n", 6, {}});
    const std::string length{"\x14\0\0\0\0\0\0\0", 8};
    EXPECT_TRUE(entry.starts_with("MESSAGE\n" + length + "a\nAXISCAL_RUN=forged\nPRIORITY=6\n"));
}

TEST(SystemJournal, ReadsBackWhateverBytesStandInAValue) {
    std::mt19937_64 random{20261128};
    const std::string bytes{"\n=\0\x08 A\xff", 7};
    std::uniform_int_distribution<std::size_t> which{0, bytes.size() - 1}, size{1, 12};
    const auto made = [&] {
        std::string text(size(random), ' ');
        for (char& byte : text)
            byte = bytes[which(random)];
        return text;
    };
    for (int nth = 0; nth < 2000; ++nth) {
        const std::string text = made(), run = made(), instrument = made();
        const auto read =
            fields_of(journal_entry(line_about(text + "\n", {Fault::not_still, run, instrument})));
        const Fields wanted{{"MESSAGE", text},
                            {"PRIORITY", "4"},
                            {"SYSLOG_FACILITY", "3"},
                            {"SYSLOG_IDENTIFIER", "axiscald"},
                            {"AXISCAL_FAULT", "not_still"},
                            {"AXISCAL_RUN", run},
                            {"AXISCAL_INSTRUMENT", instrument}};
        ASSERT_TRUE(read && *read == wanted) << "number " << nth;
    }
}

TEST(SystemJournal, IsSentWhatIsAboutSomethingAndStreamedTheRest) {
    const Journal journal;
    const SystemJournal writer{journal.stream, journal.place()};
    const LogLine about = line_about("no beam\n", {Fault::beam_lost});
    writer.write(about);
    writer.write({"ready\n", 6, {}});
    EXPECT_EQ(journal.heard(), journal_entry(about));
    EXPECT_TRUE(journal.heard_nothing());
    EXPECT_EQ(journal.streamed(), "<6>ready\n");
}

TEST(SystemJournal, GetsByTheStreamWhatItsSocketDoesNotTake) {
    Journal journal;
    const SystemJournal writer{journal.stream, journal.place()};
    const std::string long_text(16'000'000, 'x');
    writer.write(line_about(long_text + "\n", {Fault::io}));
    EXPECT_TRUE(journal.streamed() == "<4>" + long_text + "\n") << "longer than a datagram";
    EXPECT_TRUE(journal.heard_nothing());
    journal.hang_up();
    writer.write(line_about("nobody listens\n", {Fault::io}));
    ::unlink(journal.place().c_str());
    writer.write(line_about("nor is there a socket\n", {Fault::io}));
    EXPECT_EQ(journal.streamed(), "<4>nobody listens\n<4>nor is there a socket\n");
}

TEST(SystemJournal, IsFoundAgainAfterItWasRestarted) {
    Journal journal;
    const SystemJournal writer{journal.stream, journal.place()};
    writer.write(line_about("before\n", {Fault::io}));
    journal.hang_up();
    ::unlink(journal.place().c_str());
    journal.socket = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    ::sockaddr_un address{AF_UNIX, {}};
    journal.place().copy(address.sun_path, sizeof address.sun_path - 1);
    ASSERT_EQ(::bind(journal.socket, reinterpret_cast<const ::sockaddr*>(&address), sizeof address),
              0);
    writer.write(line_about("after\n", {Fault::io}));
    EXPECT_TRUE(journal.heard().starts_with("MESSAGE=after\n"));
}

/// Lines that the stream says are missing; it tells nothing else. They go in one gap, or in two
/// where the thread came up so late that some went before it took its first.
int missing_by(const std::string& streamed) {
    constexpr std::string_view told = "<4>axiscald: ";
    std::istringstream text{streamed};
    int missing = 0;
    for (std::string line; std::getline(text, line);) {
        EXPECT_TRUE(line.starts_with(told)) << line;
        if (line.starts_with(told)) missing += std::stoi(line.substr(told.size()));
    }
    EXPECT_GT(missing, 0) << "nothing was told: " << streamed;
    return missing;
}

/// The kernel keeps a few datagrams for a reader, so that a sender waits soon.
TEST(SystemJournal, ThatHangsHoldsNobodyUpWhoLogsNorTheEnd) {
    const Journal journal;
    constexpr int lines = 10'000;
    {
        LineWriter writer{
            [to = std::make_shared<const SystemJournal>(journal.stream, journal.place())](
                const LogLine& line) { to->write(line); }};
        for (int nth = 1; nth < lines; ++nth)
            writer.put(line_about(std::string(99, '.') + "\n", {Fault::no_run_armed}));
        writer.put(line_about("the last word\n", {Fault::no_run_armed}));
    } // waits no longer than last_words
    int arrived = 0;
    for (std::string entry; !entry.starts_with("MESSAGE=the last word\n"); ++arrived) {
        entry = journal.heard(); // of the thread that was left behind
        ASSERT_NE(entry, "");
    }
    EXPECT_EQ(arrived + missing_by(journal.streamed()), lines);
}

/// As systemd sets it for a service; gone with the test.
struct Named {
    explicit Named(const std::string& stream) { ::setenv("JOURNAL_STREAM", stream.c_str(), 1); }
    ~Named() { ::unsetenv("JOURNAL_STREAM"); }
    Named(const Named&) = delete;
    Named& operator=(const Named&) = delete;
};

TEST(SystemJournal, IsKnownByDeviceAndInodeOfItsStreamAlone) {
    const Journal journal;
    struct ::stat file {};
    ASSERT_EQ(::fstat(journal.stream, &file), 0);
    const std::string device = std::to_string(file.st_dev), inode = std::to_string(file.st_ino);
    ::unsetenv("JOURNAL_STREAM");
    EXPECT_FALSE(leads_to_system_journal(journal.stream));
    const Named named{device + ":" + inode};
    EXPECT_TRUE(leads_to_system_journal(journal.stream));
    EXPECT_FALSE(leads_to_system_journal(journal.socket)) << "redirected, the variable inherited";
    EXPECT_FALSE(leads_to_system_journal(-1));
    for (const std::string& other :
         {std::string{}, device, device + ":" + inode + "1", ":" + inode}) {
        const Named otherwise{other};
        EXPECT_FALSE(leads_to_system_journal(journal.stream)) << other;
    }
}

} // namespace
} // namespace axiscal::system_journal_test
