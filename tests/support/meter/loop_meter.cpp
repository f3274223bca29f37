// Preloaded into the unmodified daemon: the CPU time of each callback of its loop, read from
// outside (CLOCK_THREAD_CPUTIME_ID). Main thread only.
//
// Asio's scheduler (Boost 1.81, scheduler::do_run_one) gives its mutex back before it runs a
// handler and takes it again afterwards; what a handler posts from the loop's own thread takes no
// lock. So the time between an unlock and the next lock of that mutex is one callback. Which mutex
// it is shows itself: the last one given back before epoll_wait. That call itself is no callback.
//   AXISCAL_LOOP_METER  file of three 64-bit words: longest callback in ns, sum of all, their
//   count;
//                       whoever writes zeros into it begins anew.

#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/epoll.h>
#include <sys/mman.h>
#include <unistd.h>

namespace {

enum Word : std::uint8_t { longest, sum, count, words };

using Wait = int (*)(int, epoll_event*, int, int);
using MutexCall = int (*)(pthread_mutex_t*);

std::uint64_t* page;
pthread_mutex_t* scheduler_mutex;
pthread_mutex_t* last_given_back;
std::uint64_t callback_began_ns; // 0: none runs

bool on_the_loop() {
    thread_local const bool main_thread = ::getpid() == ::gettid();
    return page != nullptr && main_thread;
}

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

void end_callback() {
    if (callback_began_ns == 0) return;
    const std::uint64_t span = cpu_ns() - callback_began_ns;
    callback_began_ns = 0;
    if (span > __atomic_load_n(&page[longest], __ATOMIC_RELAXED))
        __atomic_store_n(&page[longest], span, __ATOMIC_RELAXED);
    __atomic_fetch_add(&page[sum], span, __ATOMIC_RELAXED);
    __atomic_fetch_add(&page[count], 1, __ATOMIC_RELAXED);
}

} // namespace

extern "C" int pthread_mutex_lock(pthread_mutex_t* mutex) {
    static const auto call = reinterpret_cast<MutexCall>(::dlsym(RTLD_NEXT, "pthread_mutex_lock"));
    if (mutex == scheduler_mutex && on_the_loop()) end_callback();
    return call(mutex);
}

extern "C" int pthread_mutex_unlock(pthread_mutex_t* mutex) {
    static const auto call =
        reinterpret_cast<MutexCall>(::dlsym(RTLD_NEXT, "pthread_mutex_unlock"));
    const int result = call(mutex);
    if (on_the_loop()) {
        last_given_back = mutex;
        if (mutex == scheduler_mutex) callback_began_ns = cpu_ns();
    }
    return result;
}

extern "C" int epoll_wait(int epoll, epoll_event* events, int most, int timeout_ms) {
    static const auto call = reinterpret_cast<Wait>(::dlsym(RTLD_NEXT, "epoll_wait"));
    if (on_the_loop()) {
        scheduler_mutex = last_given_back;
        callback_began_ns = 0;
    }
    return call(epoll, events, most, timeout_ms);
}
