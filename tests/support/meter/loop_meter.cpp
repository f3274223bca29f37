// Preloaded into the unmodified daemon: how much CPU time its loop takes between two looks at its
// descriptors (CLOCK_THREAD_CPUTIME_ID). Between two looks a handful of callbacks run, so the
// longest span bounds the longest callback. Main thread only.
//   AXISCAL_LOOP_METER  file of three 64-bit words: longest span in ns, sum of all, their count;
//                       whoever writes zeros into it begins anew.

#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/epoll.h>
#include <sys/mman.h>
#include <unistd.h>

namespace {

enum Word : std::uint8_t { longest, sum, count, words };

using Wait = int (*)(int, epoll_event*, int, int);

std::uint64_t* page;
std::uint64_t woken_ns;

std::uint64_t cpu_ns() {
    timespec now{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<std::uint64_t>(now.tv_sec) * 1'000'000'000U +
           static_cast<std::uint64_t>(now.tv_nsec);
}

__attribute__((constructor)) void open_meter() {
    const char* path = std::getenv("AXISCAL_LOOP_METER");
    const int file = path != nullptr ? ::open(path, O_RDWR | O_CLOEXEC) : -1;
    if (file < 0) return;
    void* mapped =
        ::mmap(nullptr, words * sizeof(std::uint64_t), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    ::close(file);
    if (mapped != MAP_FAILED) page = static_cast<std::uint64_t*>(mapped);
}

void count_span() {
    if (woken_ns == 0) return;
    const std::uint64_t span = cpu_ns() - woken_ns;
    if (span > __atomic_load_n(&page[longest], __ATOMIC_RELAXED))
        __atomic_store_n(&page[longest], span, __ATOMIC_RELAXED);
    __atomic_fetch_add(&page[sum], span, __ATOMIC_RELAXED);
    __atomic_fetch_add(&page[count], 1, __ATOMIC_RELAXED);
}

} // namespace

extern "C" int epoll_wait(int epoll, epoll_event* events, int most, int timeout_ms) {
    static const auto wait_of_libc = reinterpret_cast<Wait>(::dlsym(RTLD_NEXT, "epoll_wait"));
    if (page == nullptr || ::getpid() != ::gettid())
        return wait_of_libc(epoll, events, most, timeout_ms);
    count_span();
    const int ready = wait_of_libc(epoll, events, most, timeout_ms);
    woken_ns = cpu_ns();
    return ready;
}
