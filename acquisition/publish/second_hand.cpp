#include "acquisition/publish/second_hand.hpp"

#include "acquisition/journal/durable_file.hpp"

#include <array>
#include <csignal>
#include <exception>
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace axiscal {
namespace {

/// As its parent was started: stopped by a signal, and gone with the parent.
void be_a_child_of(pid_t parent) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(0);
    sigset_t none;
    ::sigemptyset(&none);
    ::pthread_sigmask(SIG_SETMASK, &none, nullptr);
}

/// Until the other end is closed, by which the child ends.
void wait_for(pid_t child, const FileHandle& heartbeat, PublisherListener& listener) {
    std::array<char, 256> beats{};
    for (;;) {
        const auto got = ::read(heartbeat.get(), beats.data(), beats.size());
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) break;
        if (!listener.go_on()) ::kill(child, SIGKILL);
    }
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
}

} // namespace

void SecondHand::work(const std::vector<std::string>& run_ids, int heartbeat) const {
    const Progress beat = [heartbeat] { [[maybe_unused]] auto put = ::write(heartbeat, "", 1); };
    auto destination = open_();
    if (!destination || !(*destination)->check()) return;
    for (const std::string& run_id : run_ids) {
        auto entry = read_entry(outbox_, run_id);
        if (!entry) return;
        const auto receipt = deliver_entry(*entry, **destination, utc_ns_(), beat);
        if (!receipt) return;
        if (*receipt) listener_.published(**receipt);
        if (!archive_entry(*entry)) return;
        beat();
    }
}

std::function<void()> SecondHand::begin(const std::vector<std::string>& run_ids) {
    std::array<int, 2> pipe{};
    if (::pipe2(pipe.data(), O_CLOEXEC) != 0) return {};
    auto heartbeat = std::make_shared<FileHandle>(pipe[0]);
    FileHandle other_end{pipe[1]};
    const pid_t parent = ::getpid(), child = ::fork();
    if (child < 0) return {};
    if (child == 0) {
        be_a_child_of(parent);
        // Nothing may unwind from here, nor end as a program does: the session is the parent's.
        try {
            work(run_ids, other_end.get());
        } catch (const std::exception&) {
            ::_exit(1); // what is left is the parent's to do
        }
        ::_exit(0);
    }
    return [this, child, heartbeat] { wait_for(child, *heartbeat, listener_); };
}

} // namespace axiscal
