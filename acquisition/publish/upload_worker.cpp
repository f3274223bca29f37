#include "acquisition/publish/upload_worker.hpp"

#include "acquisition/runfile/durable_file.hpp"

#include <array>
#include <atomic>
#include <csignal>
#include <exception>
#include <optional>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace axiscal {
namespace {

/// The next entry that nobody has, in memory of both processes.
class Claims {
public:
    explicit Claims(std::size_t count)
        : count_{count}
        , memory_{::mmap(nullptr,
                         sizeof(Counter),
                         PROT_READ | PROT_WRITE,
                         MAP_SHARED | MAP_ANONYMOUS,
                         -1,
                         0)} {
        if (*this) new (memory_) Counter{0};
    }
    ~Claims() {
        if (*this) ::munmap(memory_, sizeof(Counter));
    }
    Claims(const Claims&) = delete;
    Claims& operator=(const Claims&) = delete;
    explicit operator bool() const { return memory_ != MAP_FAILED; }
    std::optional<std::size_t> next() {
        const std::size_t index = static_cast<Counter*>(memory_)->fetch_add(1);
        return index < count_ ? std::optional{index} : std::nullopt;
    }

private:
    using Counter = std::atomic<std::size_t>;
    static_assert(Counter::is_always_lock_free, "a lock would be one of this process alone");
    std::size_t count_;
    void* memory_;
};

/// As its parent was started: stopped by a signal, and gone with the parent.
void be_a_child_of(pid_t parent) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(0);
    sigset_t none;
    ::sigemptyset(&none);
    ::pthread_sigmask(SIG_SETMASK, &none, nullptr);
}

/// false: the other end is closed.
bool hears_from(const FileHandle& line) {
    std::array<char, 256> beats{};
    for (;;) {
        const auto got = ::read(line.get(), beats.data(), beats.size());
        if (got >= 0 || errno != EINTR) return got > 0;
    }
}

} // namespace

/// Both ends of it: the publisher's as UploadHelper, the worker's behind begin().
class UploadWorker::Child final : public UploadHelper {
public:
    Child(std::size_t entries, PublisherListener& listener)
        : claims_{entries}
        , listener_{listener} {}
    ~Child() override {
        if (pid_ <= 0) return;
        ::kill(pid_, SIGKILL); // nobody waited for it: the destination is lost
        reap();
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    std::optional<std::size_t> claim() override { return claims_.next(); }
    void wait() override {
        while (hears_from(*line_))
            if (!listener_.go_on()) ::kill(pid_, SIGKILL);
        reap();
    }

    /// @returns 0 in the new process, -1 when there is none.
    pid_t fork() {
        std::array<int, 2> ends{};
        if (!claims_ || ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
            return -1;
        FileHandle own{ends[0]}, other{ends[1]};
        const pid_t parent = ::getpid();
        pid_ = ::fork();
        line_.emplace(pid_ == 0 ? std::move(other) : std::move(own));
        if (pid_ == 0) be_a_child_of(parent);
        return pid_;
    }
    /// A sign of life, for wait(). One that finds no room is one of many.
    void beat() { ::send(line_->get(), "", 1, MSG_DONTWAIT | MSG_NOSIGNAL); }

private:
    void reap() {
        while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
        }
        pid_ = 0;
    }
    Claims claims_;
    PublisherListener& listener_;
    std::optional<FileHandle> line_;
    pid_t pid_ = 0;
};

void UploadWorker::publish_by(Destination& destination,
                              const std::vector<std::string>& run_ids,
                              Child& self) const {
    if (!destination.check()) return;
    const Delivery delivery{destination, mark_of(outbox_), [&self] { self.beat(); }};
    while (const auto index = self.claim()) {
        auto entry = read_entry(outbox_, run_ids.at(*index));
        if (!entry) return;
        const auto receipt = deliver_entry(*entry, delivery, utc_ns_());
        if (!receipt) return;
        if (*receipt) listener_.published(**receipt);
        if (!archive_entry(*entry, delivery.progress)) return;
        self.beat();
    }
}

void UploadWorker::work(const std::vector<std::string>& run_ids, Child& self, bool inherits) const {
    if (inherits) return publish_by(destination_, run_ids, self);
    if (const auto anew = open_()) publish_by(**anew, run_ids, self);
}

std::unique_ptr<UploadHelper> UploadWorker::begin(const std::vector<std::string>& run_ids) {
    auto helper = std::make_unique<Child>(run_ids.size(), listener_);
    const bool inherits = destination_.prepare();
    const pid_t child = helper->fork();
    if (child < 0) return nullptr;
    if (child > 0) return helper;
    // Nothing may unwind from here, nor end as a program does: the session is the parent's.
    try {
        work(run_ids, *helper, inherits);
    } catch (const std::exception&) {
        ::_exit(1); // what is left is the parent's to do
    }
    ::_exit(0);
}

} // namespace axiscal
