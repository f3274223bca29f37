#include "tools/axiscal/conformance/foreign_program.hpp"

#include "tools/axiscal/case_text.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

namespace axiscal {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr std::size_t largest_answer = std::size_t{64} << 20; // as for a case

class Descriptor {
public:
    explicit Descriptor(int number = -1)
        : number_(number) {}
    Descriptor(Descriptor&& other) noexcept
        : number_(std::exchange(other.number_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(number_, other.number_);
        return *this;
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (number_ >= 0) ::close(number_);
    }
    [[nodiscard]] int get() const { return number_; }
    void close() { Descriptor{std::exchange(number_, -1)}; }

private:
    int number_;
};

tl::unexpected<Error> io_failure(const std::string& what, int reason) {
    return fail(Fault::io, what, {reason, std::generic_category()});
}

/// A file in memory instead of a pipe: a program that does not read its input blocks nobody.
Result<Descriptor> input_of(const std::string& text) {
    Descriptor file{::memfd_create("case", MFD_CLOEXEC)};
    std::size_t written = 0;
    while (file.get() >= 0 && written < text.size()) {
        const auto step = ::write(file.get(), text.data() + written, text.size() - written);
        if (step < 0 && errno != EINTR) break;
        written += step > 0 ? static_cast<std::size_t>(step) : 0;
    }
    if (file.get() < 0 || written < text.size() || ::lseek(file.get(), 0, SEEK_SET) != 0)
        return io_failure("no memory for the case", errno);
    return file;
}

/// The running program; its whole group ends with this object.
struct Child {
    Child() = default;
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    ~Child() { reap(); }

    /// Status as of waitpid(); kills what still runs.
    int reap() {
        if (pid <= 0) return status;
        ::kill(-pid, SIGKILL);
        while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
        }
        pid = -1;
        return status;
    }

    pid_t pid = -1;
    int status = 0;
    Descriptor output, complaints, process;
};

struct Pipe {
    Descriptor read, write;
};

Result<Pipe> make_pipe() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) return io_failure("no pipe", errno);
    return Pipe{Descriptor{ends[0]}, Descriptor{ends[1]}};
}

Result<void> start(const std::string& command, const std::string& input, Child& child) {
    AXISCAL_TRY(const Descriptor stdin_file, input_of(input));
    AXISCAL_TRY(Pipe output, make_pipe());
    AXISCAL_TRY(Pipe complaints, make_pipe());
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, stdin_file.get(), STDIN_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, output.write.get(), STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, complaints.write.get(), STDERR_FILENO);
    posix_spawnattr_t attributes;
    ::posix_spawnattr_init(&attributes);
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    std::array<std::string, 3> words{"sh", "-c", command};
    const std::array<char*, 4> arguments{words[0].data(), words[1].data(), words[2].data(),
                                         nullptr};
    const int failed =
        ::posix_spawn(&child.pid, "/bin/sh", &actions, &attributes, arguments.data(), environ);
    ::posix_spawnattr_destroy(&attributes);
    ::posix_spawn_file_actions_destroy(&actions);
    if (failed != 0) {
        child.pid = -1;
        return io_failure("cannot start /bin/sh", failed);
    }
    child.process = Descriptor{static_cast<int>(::syscall(SYS_pidfd_open, child.pid, 0U))};
    child.output = std::move(output.read);
    child.complaints = std::move(complaints.read);
    return {};
}

/// Reads once; closes the descriptor at its end. False: too much came.
bool take(Descriptor& from, std::string& into) {
    std::array<char, 65536> piece{};
    const auto count = ::read(from.get(), piece.data(), piece.size());
    if (count < 0 && errno == EINTR) return true;
    if (count <= 0)
        from.close();
    else
        into.append(piece.data(), static_cast<std::size_t>(count));
    return into.size() <= largest_answer;
}

enum class End : std::uint8_t { finished, too_late, too_much };

struct Said {
    std::string answer, complaints;
};

/// Until both outputs are closed and the program has ended. A closed descriptor is -1, which
/// poll() skips.
End listen(Child& child, Said& said, Clock::time_point deadline) {
    bool ended = false;
    while (child.output.get() >= 0 || child.complaints.get() >= 0 || !ended) {
        std::array<pollfd, 3> watched{pollfd{child.output.get(), POLLIN, 0},
                                      pollfd{child.complaints.get(), POLLIN, 0},
                                      pollfd{ended ? -1 : child.process.get(), POLLIN, 0}};
        const auto left = std::chrono::ceil<milliseconds>(deadline - Clock::now());
        if (left.count() <= 0) return End::too_late;
        ::poll(watched.data(), watched.size(), static_cast<int>(left.count()));
        if (watched[0].revents != 0 && !take(child.output, said.answer)) return End::too_much;
        if (watched[1].revents != 0 && !take(child.complaints, said.complaints))
            return End::too_much;
        ended = ended || watched[2].revents != 0;
    }
    return End::finished;
}

std::string last_line(std::string text) {
    while (!text.empty() && text.back() == '\n')
        text.pop_back();
    const auto cut = text.rfind('\n');
    return printable(cut == std::string::npos ? text : text.substr(cut + 1));
}

/// "Killed", "signal 34" for one without a name.
std::string signal_name(int number) {
    const char* const name = ::sigdescr_np(number);
    return name != nullptr ? name : "signal " + std::to_string(number);
}

std::string ending(int status, const std::string& complaints) {
    std::string how = WIFSIGNALED(status) ? "was ended by " + signal_name(WTERMSIG(status))
                                          : "ended with " + std::to_string(WEXITSTATUS(status));
    const std::string said = last_line(complaints);
    return said.empty() ? how : how + ": " + said;
}

} // namespace

Result<std::string>
ask_program(const std::string& command, const std::string& input, milliseconds limit) {
    Child child;
    const auto deadline = Clock::now() + limit;
    AXISCAL_CHECK(start(command, input, child));
    Said said;
    const End end = listen(child, said, deadline);
    const int status = child.reap();
    if (end == End::too_late)
        return fail(Fault::link_timeout, "has not finished after " + std::to_string(limit.count()) +
                                             " ms and was ended");
    if (end == End::too_much) return fail(Fault::refused, "wrote more than 64 MiB");
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return std::move(said.answer);
    return fail(Fault::refused, ending(status, said.complaints));
}

} // namespace axiscal
