#include "drivers/loop/child_process.hpp"

#include <array>
#include <cerrno>
#include <fcntl.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <utility>

namespace axiscal {
namespace {

struct PipeEnds {
    int read = -1, write = -1;
};

Result<PipeEnds> pipe_for(const std::string& program) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
        return fail(Fault::io, "no pipe for " + program, {errno, std::generic_category()});
    return PipeEnds{ends[0], ends[1]};
}

void close_all(std::initializer_list<int> descriptors) {
    for (const int one : descriptors)
        if (one >= 0) ::close(one);
}

/// 0, or the error's number.
int spawn_with(pid_t& pid, const std::vector<std::string>& words, int input, int output) {
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    if (input >= 0) ::posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, output, STDERR_FILENO);
    std::vector<char*> arguments;
    arguments.reserve(words.size() + 1);
    for (const std::string& word : words)
        arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    const int failed =
        ::posix_spawnp(&pid, words.front().c_str(), &actions, nullptr, arguments.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    return failed;
}

} // namespace

Result<ChildProcess> start_child(const std::vector<std::string>& words, ChildInput input) {
    AXISCAL_TRY(const PipeEnds out, pipe_for(words.front()));
    PipeEnds in;
    if (input == ChildInput::pipe) {
        auto made = pipe_for(words.front());
        if (!made) {
            close_all({out.read, out.write});
            return tl::unexpected<Error>(made.error());
        }
        in = *made;
    }
    ChildProcess child;
    const int failed = spawn_with(child.pid, words, in.read, out.write);
    close_all({in.read, out.write});
    child.input = in.write, child.output = out.read;
    if (failed == 0) child.process = static_cast<int>(::syscall(SYS_pidfd_open, child.pid, 0U));
    if (child.process >= 0) return child;
    const int reason = failed != 0 ? failed : errno;
    close_all({child.input, child.output});
    return fail(Fault::io, "cannot start " + words.front(), {reason, std::generic_category()});
}

std::string last_line_of(std::string text) {
    while (!text.empty() && text.back() == '\n')
        text.pop_back();
    const auto cut = text.rfind('\n');
    return cut == std::string::npos ? text : text.substr(cut + 1);
}

} // namespace axiscal
