#include "acquisition/station/certificate_writer.hpp"

#include "acquisition/capture/wording.hpp"

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/buffer.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <nlohmann/json.hpp>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <memory>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace axiscal {
namespace {

namespace asio = boost::asio;

struct Child {
    pid_t pid = -1;
    int output = -1;  ///< read end of its stdout and stderr
    int process = -1; ///< pidfd: readable when it has ended
};

constexpr std::size_t longest_answer = std::size_t{64} * 1024;

using Stream = asio::posix::stream_descriptor;

/// Ends a hung program, and the waiting for what it says: a child of its own may hold the pipe.
struct KillLate {
    std::shared_ptr<Stream> process, output;
    std::shared_ptr<bool> killed;
    void operator()(boost::system::error_code cancelled) const {
        if (cancelled || !process->is_open()) return;
        *killed = true;
        ::syscall(SYS_pidfd_send_signal, process->native_handle(), SIGKILL, nullptr, 0U);
        output->close();
    }
};

Result<Child> start(const std::vector<std::string>& words) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
        return fail(Fault::io, "no pipe for " + words.front(), {errno, std::generic_category()});
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
    std::vector<char*> arguments;
    arguments.reserve(words.size() + 1);
    for (const std::string& word : words)
        arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    Child child;
    const int failed = ::posix_spawnp(&child.pid, words.front().c_str(), &actions, nullptr,
                                      arguments.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
    child.output = ends[0];
    if (failed == 0) child.process = static_cast<int>(::syscall(SYS_pidfd_open, child.pid, 0U));
    if (child.process >= 0) return child;
    const int reason = failed != 0 ? failed : errno;
    ::close(child.output);
    return fail(Fault::io, "cannot start " + words.front(), {reason, std::generic_category()});
}

std::string last_line(std::string text) {
    while (!text.empty() && text.back() == '\n')
        text.pop_back();
    const auto cut = text.rfind('\n');
    return cut == std::string::npos ? text : text.substr(cut + 1);
}

} // namespace

Task<Result<std::string>> write_certificate(Scheduler& scheduler,
                                            std::string program,
                                            std::string run_file,
                                            std::string outbox,
                                            std::chrono::milliseconds limit) {
    const std::vector<std::string> words{program, run_file, "--outbox", outbox};
    AXISCAL_CO_TRY(const Child child, start(words));
    const auto output = std::make_shared<Stream>(scheduler.executor(), child.output);
    const auto process = std::make_shared<Stream>(scheduler.executor(), child.process);
    const auto killed = std::make_shared<bool>(false);
    asio::steady_timer deadline{scheduler.executor(), limit}; // another process: real time
    deadline.async_wait(KillLate{process, output, killed});
    std::string said;
    co_await asio::async_read(*output, asio::dynamic_buffer(said, longest_answer),
                              asio::as_tuple(asio::use_awaitable));
    output->close(); // one that goes on talking is ended by it
    co_await process->async_wait(Stream::wait_read, asio::as_tuple(asio::use_awaitable));
    deadline.cancel();
    process->close();
    int status = 0;
    ::waitpid(child.pid, &status, 0); // it has ended: this does not wait
    if (*killed)
        co_return fail(Fault::io,
                       program + " has not finished after " + in_seconds(limit) + " and was ended");
    const std::string line = last_line(said);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        co_return fail(Fault::io, program + " failed: " + line);
    const auto answer = nlohmann::json::parse(line, nullptr, false);
    if (!answer.is_object() || !answer.contains("entry") || !answer["entry"].is_string())
        co_return fail(Fault::io, program + " said nothing of its entry: " + line);
    co_return answer["entry"].get<std::string>();
}

std::string sibling_program(const std::string& name) {
    std::error_code error;
    const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
    const auto beside = self.parent_path() / name;
    return !error && std::filesystem::exists(beside, error) ? beside.string() : name;
}

} // namespace axiscal
