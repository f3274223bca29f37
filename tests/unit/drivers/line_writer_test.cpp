// A log that nobody reads holds nobody up, and says how much of it is missing.
#include "drivers/loop/line_writer.hpp"

#include <gtest/gtest.h>

#include <array>
#include <csignal>
#include <fcntl.h>
#include <poll.h>
#include <sstream>
#include <string>
#include <unistd.h>

namespace axiscal::line_writer_test {
namespace {

constexpr int patience_ms = 20'000; // bounds a failing test

/// A pipe of one page, read by nobody until the test does.
struct Pipe {
    Pipe() {
        EXPECT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
        EXPECT_GT(::fcntl(ends[1], F_SETPIPE_SZ, 4096), 0);
    }
    ~Pipe() {
        ::close(ends[0]);
        ::close(ends[1]);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;

    void fill() const {
        wait_never(true);
        while (::write(ends[1], "x\n", 2) == 2) {
        }
        wait_never(false);
    }
    void wait_never(bool on) const { ::fcntl(ends[1], F_SETFL, O_WRONLY | (on ? O_NONBLOCK : 0)); }

    /// Reads on until what was read ends like this; false when nothing comes any more.
    bool read_until(const std::string& end) {
        while (!text.ends_with(end)) {
            pollfd ready{ends[0], POLLIN, 0};
            if (::poll(&ready, 1, patience_ms) != 1) return false;
            std::array<char, 4096> bytes{};
            const ssize_t count = ::read(ends[0], bytes.data(), bytes.size());
            if (count <= 0) return false;
            text.append(bytes.data(), static_cast<std::size_t>(count));
        }
        return true;
    }

    std::array<int, 2> ends{-1, -1};
    std::string text;
};

/// A line of a hundred bytes that tells its number.
std::string numbered(int number) {
    std::string line = "line " + std::to_string(number) + " ";
    line.resize(99, '.');
    return line + "\n";
}

/// Follows the numbers through the text: each must be the next, or the one after as many as the
/// line before it says are missing.
struct Followed {
    explicit Followed(const std::string& text) {
        std::istringstream lines{text};
        int announced = 0;
        for (std::string line; std::getline(lines, line);) {
            if (line.find(" lines are missing here") != std::string::npos) {
                announced = std::stoi(line.substr(line.find(": ") + 2));
                missing += announced;
            } else if (line.starts_with("line ")) {
                const int number = std::stoi(line.substr(5));
                right = right && number == last + 1 + announced;
                last = number;
                announced = 0;
                ++arrived;
            }
        }
    }
    bool right = true;
    int last = -1, arrived = 0, missing = 0;
};

TEST(LineWriter, WritesEveryLineInOrderBeforeItEnds) {
    Pipe pipe;
    std::string all;
    {
        LineWriter writer{pipe.ends[1]};
        for (int number = 0; number < 30; ++number) {
            writer.put(numbered(number));
            all += numbered(number);
        }
    }
    ASSERT_TRUE(pipe.read_until(numbered(29)));
    EXPECT_EQ(pipe.text, all);
}

TEST(LineWriter, NeverWaitsForAReaderAndSaysHowManyLinesAreMissingWhere) {
    Pipe pipe;
    pipe.fill();
    LineWriter writer{pipe.ends[1]};
    constexpr int lines = 10'000; // eight times what is kept
    for (int number = 0; number < lines; ++number)
        writer.put(numbered(number)); // returns though the pipe is full
    ASSERT_TRUE(pipe.read_until(numbered(lines - 1)));
    const Followed seen{pipe.text};
    EXPECT_TRUE(seen.right) << "a gap that is not said, or said wrongly";
    EXPECT_EQ(seen.arrived + seen.missing, lines);
    EXPECT_GT(seen.missing, 0);
    EXPECT_GT(seen.arrived, 1000) << "as many as are kept";
    EXPECT_LT(seen.arrived, 4000) << "no more than are kept and on their way";
}

TEST(LineWriter, EndsThoughNobodyReads) {
    Pipe pipe;
    pipe.fill();
    {
        LineWriter writer{pipe.ends[1]};
        writer.put("the last word\n");
    } // waits no longer than last_words
    EXPECT_TRUE(pipe.read_until("the last word\n")) << "the thread that was left behind";
}

TEST(LineWriter, WritesToADescriptorThatSomebodyMadeNonBlocking) {
    Pipe pipe;
    pipe.fill();
    pipe.wait_never(true);
    LineWriter writer{pipe.ends[1]};
    writer.put("a word\n");
    EXPECT_TRUE(pipe.read_until("a word\n"));
}

TEST(LineWriter, OutlivesItsReader) {
    std::signal(SIGPIPE, SIG_IGN);
    Pipe pipe;
    ::close(pipe.ends[0]);
    {
        LineWriter writer{pipe.ends[1]};
        writer.put("to nobody\n");
    }
    pipe.ends[0] = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
}

} // namespace
} // namespace axiscal::line_writer_test
