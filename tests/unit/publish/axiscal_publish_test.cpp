// The program itself, as a process.

#include "acquisition/publish/outbox.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/source_dir.hpp"
#include "tests/unit/publish/staged_entry.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <sys/wait.h>
#include <unistd.h>

namespace axiscal::axiscal_publish_test {
namespace {

using testing::read_bytes;
using testing::ScratchFolder;
using testing::stage_entry;
using testing::write_bytes;

class Program {
public:
    explicit Program(std::vector<std::string> words, bool as_nobody = false) {
        int ends[2];
        EXPECT_EQ(::pipe2(ends, O_CLOEXEC), 0);
        pid_ = ::fork();
        if (pid_ == 0) start(std::move(words), ends[1], as_nobody);
        ::close(ends[1]);
        out_ = ::fdopen(ends[0], "r");
    }
    ~Program() {
        if (pid_ > 0) ::kill(pid_, SIGKILL), ::waitpid(pid_, nullptr, 0);
        ::fclose(out_);
    }
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    /// The next line of --json; null at the end.
    nlohmann::json line() {
        char text[4096];
        if (::fgets(text, sizeof text, out_) == nullptr) return nullptr;
        return nlohmann::json::parse(text);
    }
    void stop() const { ::kill(pid_, SIGTERM); }
    int exit_code() {
        int status = 0;
        ::waitpid(std::exchange(pid_, -1), &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

private:
    [[noreturn]] static void start(std::vector<std::string> words, int out, bool as_nobody) {
        words.insert(words.begin(), AXISCAL_PUBLISH_PROGRAM);
        std::vector<char*> arguments;
        for (auto& word : words)
            arguments.push_back(word.data());
        arguments.push_back(nullptr);
        ::dup2(out, STDOUT_FILENO);
        ::dup2(::open("/dev/null", O_WRONLY), STDERR_FILENO);
        // Opened while this process is still root: the checkout may lie in root's home, where
        // nobody else may look.
        const int program = ::open(arguments[0], O_RDONLY | O_CLOEXEC);
        if (as_nobody && ::geteuid() == 0 && ::setuid(65534) != 0) ::_exit(99);
        ::fexecve(program, arguments.data(), environ);
        ::_exit(98);
    }
    pid_t pid_ = -1;
    FILE* out_ = nullptr;
};

struct Site {
    ScratchFolder scratch;
    std::string outbox = scratch.file("state/outbox"), destination = scratch.file("share");
    [[nodiscard]] std::vector<std::string> words(std::vector<std::string> more = {}) const {
        std::vector<std::string> all{"--outbox", outbox,    "--to", destination,
                                     "--json",   "--retry", "0.05"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
};

TEST(AxiscalPublish, WaitsForADestinationThatAppearsLater) {
    const Site site;
    ASSERT_TRUE(stage_entry(site.outbox, "run-1", {{"certificate.json", "{}"}}));
    Program program{site.words()};
    EXPECT_EQ(program.line()["event"], "waiting");
    std::filesystem::create_directory(site.destination);
    EXPECT_EQ(program.line()["event"], "destination_back");
    const auto published = program.line();
    EXPECT_EQ(published["event"], "published");
    EXPECT_EQ(published["folder"], site.destination + "/run-1");
    EXPECT_EQ(read_bytes(site.destination + "/run-1/certificate.json"), "{}");
    program.stop();
    EXPECT_EQ(program.exit_code(), 0);
    const auto receipt =
        nlohmann::json::parse(read_bytes(site.scratch.file("state/published/run-1/receipt.json")));
    EXPECT_EQ(receipt["files"][0]["name"], "certificate.json");
}

TEST(AxiscalPublish, SeesWhatComesWhileItRuns) {
    const Site site;
    std::filesystem::create_directory(site.destination);
    Program program{site.words()};
    for (const std::string run : {"run-1", "run-2"}) {
        ASSERT_TRUE(stage_entry(site.outbox, run, {{"a", run}}));
        EXPECT_EQ(program.line()["run_id"], run);
    }
}

TEST(AxiscalPublish, TellsWithOnceThatSomethingStillWaits) {
    const Site site;
    ASSERT_TRUE(stage_entry(site.outbox, "run-1", {{"a", "x"}}));
    Program missing{site.words({"--once"})};
    EXPECT_EQ(missing.exit_code(), 1);
    std::filesystem::create_directory(site.destination);
    Program there{site.words({"--once"})};
    EXPECT_EQ(there.exit_code(), 0);
    EXPECT_TRUE(entry_names(site.outbox).empty());
}

TEST(AxiscalPublish, KeepsTheEntryWhileTheDestinationIsReadOnly) {
    const Site site;
    std::filesystem::create_directory(site.destination);
    const auto folder = stage_entry(site.outbox, "run-1", {{"a", "x"}}).value();
    std::filesystem::permissions(site.destination, std::filesystem::perms{0555});
    for (const auto& open : {site.scratch.path(), site.scratch.file("state"), site.outbox, folder})
        std::filesystem::permissions(open, std::filesystem::perms{0777});
    Program program{site.words({"--once"}), true};
    const auto line = program.line();
    EXPECT_EQ(line["event"], "waiting");
    EXPECT_NE(line["reason"].get<std::string>().find(site.destination), std::string::npos);
    EXPECT_EQ(program.exit_code(), 1);
    EXPECT_EQ(entry_names(site.outbox).size(), 1U);
}

TEST(AxiscalPublish, ReadsDestinationAndStateFromTheStationFile) {
    const Site site;
    std::filesystem::create_directory(site.destination);
    auto station = read_bytes(test::source_dir() + "/config/station.example.toml");
    const auto set = [&](const std::string& key, const std::string& value) {
        for (std::size_t at = 0; (at = station.find(key, at)) != std::string::npos; ++at) {
            const bool at_line_start = at == 0 || station[at - 1] == '\n' ||
                                       (at >= 2 && station.substr(at - 2, 2) == "# ");
            const auto end = station.find('\n', at);
            if (!at_line_start || station.find('=', at) > end) continue;
            const auto begin = station.rfind('\n', at) + 1;
            station.replace(begin, end - begin, key + " = \"" + value + "\"");
            return;
        }
        ADD_FAILURE() << key << " is not in the example";
    };
    set("state_directory", site.scratch.file("state"));
    set("destination", site.destination);
    write_bytes(site.scratch.file("station.toml"), station);
    ASSERT_TRUE(stage_entry(site.outbox, "run-1", {{"a", "x"}}));
    Program program{{"--config", site.scratch.file("station.toml"), "--once", "--json"}};
    EXPECT_EQ(program.line()["folder"], site.destination + "/run-1");
    EXPECT_EQ(program.exit_code(), 0);
}

TEST(AxiscalPublish, RefusesWrongUseAndWrongStationFiles) {
    const Site site;
    EXPECT_EQ(Program{{}}.exit_code(), 2);
    EXPECT_EQ((Program{{"--outbox", site.outbox}}.exit_code()), 2);
    write_bytes(site.scratch.file("station.toml"), "[publish]\ndestinatoin = \"/x\"\n");
    EXPECT_EQ((Program{{"--config", site.scratch.file("station.toml")}}.exit_code()), 3);
    EXPECT_EQ((Program{{"--config", site.scratch.file("none.toml")}}.exit_code()), 3);
    EXPECT_EQ((Program{{"--help"}}.exit_code()), 0);
    EXPECT_EQ((Program{{"--outbox", site.outbox, "--to", "smb://server"}}.exit_code()), 2);
}

TEST(AxiscalPublish, IsOneAnOutbox) {
    const Site site;
    std::filesystem::create_directory(site.destination);
    Program first{site.words()};
    ASSERT_TRUE(stage_entry(site.outbox, "run-1", {{"a", "x"}}));
    EXPECT_EQ(first.line()["event"], "published"); // it holds the outbox
    EXPECT_EQ(Program{site.words({"--once"})}.exit_code(), 3);
    first.stop();
    EXPECT_EQ(first.exit_code(), 0);
    EXPECT_EQ(Program{site.words({"--once"})}.exit_code(), 0);
}

TEST(AxiscalPublish, LeavesWordOfItsStateBesideTheOutbox) {
    const Site site;
    const auto report = [&] {
        return nlohmann::json::parse(read_bytes(site.scratch.file("state/publisher.json")));
    };
    ASSERT_TRUE(stage_entry(site.outbox, "run-1", {{"a", "x"}}));
    EXPECT_EQ(Program{site.words({"--once"})}.exit_code(), 1);
    EXPECT_EQ(report()["state"], "waiting");
    EXPECT_NE(report()["reason"].get<std::string>().find(site.destination), std::string::npos);
    std::filesystem::create_directory(site.destination);
    EXPECT_EQ(Program{site.words({"--once"})}.exit_code(), 0);
    EXPECT_EQ(report()["state"], "idle");
    EXPECT_EQ(report()["reason"], "");
}

} // namespace
} // namespace axiscal::axiscal_publish_test
