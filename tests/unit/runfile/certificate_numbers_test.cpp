#include "acquisition/runfile/certificate_numbers.hpp"

#include "tests/support/scratch_folder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <iterator>
#include <set>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace axiscal::certificate_numbers_test {
namespace {

using testing::ScratchFolder;

NumberWanted of_run(const std::string& run_id, int closing = 1, int year = 2026) {
    return {"CAL-{year}-{count:4}", run_id, closing, year};
}

class CertificateNumbers : public ::testing::Test {
protected:
    std::string take(const NumberWanted& wanted) {
        auto taken = take_certificate_number(state.path(), wanted);
        return taken ? *taken : describe(taken.error());
    }
    [[nodiscard]] std::string content() const {
        std::ifstream file{path, std::ios::binary};
        return {std::istreambuf_iterator<char>{file}, {}};
    }
    void write(const std::string& text) const {
        std::ofstream{path, std::ios::binary | std::ios::trunc} << text;
    }
    ScratchFolder state;
    std::string path = state.file("certificate-numbers");
};

TEST_F(CertificateNumbers, FollowThePatternOnePaperANumber) {
    EXPECT_EQ(take(of_run("a")), "CAL-2026-0001");
    EXPECT_EQ(take(of_run("b")), "CAL-2026-0002");
    EXPECT_EQ(take(of_run("a", 2)), "CAL-2026-0003") << "an amended paper is another paper";
}

TEST_F(CertificateNumbers, OfAPaperThatWasBegunBeforeAKillIsTheSame) {
    const std::string first = take(of_run("a"));
    EXPECT_EQ(take(of_run("a")), first);
    EXPECT_EQ(take(of_run("b")), "CAL-2026-0002");
}

TEST_F(CertificateNumbers, CountOnOverTheEndOfAYearAndAnotherPattern) {
    take(of_run("a"));
    EXPECT_EQ(take(of_run("b", 1, 2027)), "CAL-2027-0002");
    EXPECT_EQ(take({"{count}/{year}", "c", 1, 2027}), "3/2027");
    EXPECT_EQ(take({"X{count:1}{count:2}", "d", 1, 2027}), "X404");
}

TEST_F(CertificateNumbers, ThatWereUsedArePassedOver) {
    EXPECT_EQ(take({"N-2", "a", 1, 2026}), "N-2") << "a plain one, by hand";
    EXPECT_EQ(take({"N-{count}", "b", 1, 2026}), "N-1");
    EXPECT_EQ(take({"N-{count}", "c", 1, 2026}), "N-3") << "N-2 is used";
}

TEST_F(CertificateNumbers, ThatArePlainGetAMarkBehindThemForAnAmendedPaper) {
    EXPECT_EQ(take({"2026-0147", "a", 1, 2026}), "2026-0147");
    EXPECT_EQ(take({"2026-0147", "a", 2, 2026}), "2026-0147-2");
    EXPECT_EQ(take({"2026-0147", "a", 3, 2026}), "2026-0147-3");
}

TEST_F(CertificateNumbers, ThatArePlainAndUsedAreRefusedForAnotherRun) {
    EXPECT_TRUE(check_number_is_free(state.path(), "2026-0147"));
    take({"2026-0147", "a", 1, 2026});
    const auto refused = check_number_is_free(state.path(), "2026-0147");
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().fault, Fault::refused);
    EXPECT_NE(refused.error().detail.find("was given to run a"), std::string::npos);
    EXPECT_NE(refused.error().detail.find("{count:4}"), std::string::npos) << "the way out";
    EXPECT_TRUE(check_number_is_free(state.path(), "2026-0148"));
    EXPECT_TRUE(check_number_is_free(state.path(), "CAL-{count}"));
    EXPECT_TRUE(check_number_is_free(state.path(), ""));
}

TEST_F(CertificateNumbers, ThatWereTornByAPowerCutAreGivenAnewForNobodyHasThem) {
    take(of_run("a")), take(of_run("b"));
    const std::string whole = content();
    const auto second = whole.find('\n') + 1;
    for (std::size_t cut = second; cut < whole.size(); ++cut) {
        write(whole.substr(0, cut));
        EXPECT_EQ(take(of_run("c")), "CAL-2026-0002") << cut;
        EXPECT_EQ(std::ranges::count(content(), '\n'), 2);
    }
}

TEST_F(CertificateNumbers, ThatCannotBeReadAreRefusedWithTheWayOut) {
    take(of_run("a"));
    for (const std::string& line :
         {std::string{"x\t1\tb\tN\n"}, std::string{"2\t1\tb\n"}, std::string{"\n"},
          std::string(40, '\0') + "\n", std::string{"2\t1\tb\tN\tmore\n"},
          std::string{"-2\t1\tb\tN\n"}}) {
        const std::string before = content();
        write(before + line);
        const auto refused = take_certificate_number(state.path(), of_run("c"));
        ASSERT_FALSE(refused) << line;
        EXPECT_EQ(refused.error().fault, Fault::refused);
        EXPECT_NE(refused.error().detail.find("line 2 is damaged: put the file back"),
                  std::string::npos);
        EXPECT_EQ(content(), before + line) << "nothing is written over it";
        write(before);
    }
}

/// Each child takes numbers as fast as it can and is killed in the midst of it.
TEST_F(CertificateNumbers, AreNeverGivenTwiceByProcessesThatAreKilled) {
    constexpr int children = 24, abreast = 3, papers = 200;
    for (int round = 0; round < children / abreast; ++round) {
        std::vector<pid_t> running;
        std::array<int, 2> pipe_of{};
        ASSERT_EQ(::pipe(pipe_of.data()), 0);
        for (int i = 0; i < abreast; ++i) {
            const std::string name = std::to_string(round) + "." + std::to_string(i);
            const pid_t child = ::fork();
            if (child == 0) {
                for (int paper = 0; paper < papers; ++paper) {
                    if (!take_certificate_number(state.path(), of_run(name, paper))) ::_exit(1);
                    if (::write(pipe_of[1], ".", 1) != 1) ::_exit(1);
                }
                ::_exit(0);
            }
            running.push_back(child);
        }
        char taken = 0; // some numbers were taken, others are on their way
        for (int i = 0; i < 5 + round; ++i)
            ASSERT_EQ(::read(pipe_of[0], &taken, 1), 1);
        for (const pid_t child : running) {
            ::kill(child, SIGKILL);
            int status = 0;
            ASSERT_EQ(::waitpid(child, &status, 0), child);
            ASSERT_TRUE(WIFSIGNALED(status) || WEXITSTATUS(status) == 0);
        }
        ::close(pipe_of[0]), ::close(pipe_of[1]);
    }
    EXPECT_TRUE(take_certificate_number(state.path(), of_run("the last one")));
    std::set<std::string> seen;
    std::ifstream file{path};
    int lines = 0;
    for (std::string line; std::getline(file, line); ++lines)
        seen.insert(line.substr(line.rfind('\t') + 1));
    EXPECT_GE(lines, children / abreast * 5);
    EXPECT_EQ(seen.size(), static_cast<std::size_t>(lines));
}

} // namespace
} // namespace axiscal::certificate_numbers_test
