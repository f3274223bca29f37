// Counts, from outside, every step by which a program changes a folder: write, pwrite, writev,
// fsync, fdatasync, ftruncate, rename, unlink, mkdir; kills the program before one of them, tears
// one in two, or lets some of them fail. LD_PRELOAD of the shipped programs; nothing of ours is
// linked.
//
//   AXISCAL_STEPS  file of one struct Steps, made and read by the test (tests/simulation/steps.py)
//
// Programs started by the first one inherit both: the steps of all are counted in one row, and the
// kill takes the first one with it, as a power cut would.
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

namespace {

constexpr std::size_t longest_path = 256, words = 64, most_logged = 8192;

/// Bits of Steps::fail_kinds.
enum Kind : std::uint32_t { content = 1, durability = 2, names = 4 };

/// Shared by the programs and the test; steps.py packs the same bytes.
struct Steps {
    std::atomic<std::uint64_t> count;
    std::uint64_t kill_at;                 ///< before this step, counted from 1; 0: never
    std::uint64_t tear;                    ///< 1: half of the bytes of that step are written first
    std::atomic<std::uint64_t> fail_error; ///< errno for the steps of fail_kinds; 0: none fails
    std::atomic<std::uint64_t> fail_kinds, failed;
    std::atomic<std::int64_t> first_program;
    std::uint64_t reserved;
    char folder[longest_path]; ///< real path; steps elsewhere are not counted
    char log[most_logged][words];
};

Steps* steps = nullptr;

template <class Function> Function* next(const char* symbol) {
    return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, symbol));
}

__attribute__((constructor)) void begin() {
    const char* path = std::getenv("AXISCAL_STEPS");
    if (path == nullptr) return;
    const int file = ::open(path, O_RDWR | O_CLOEXEC);
    if (file < 0) return;
    void* shared = ::mmap(nullptr, sizeof(Steps), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    ::close(file);
    if (shared == MAP_FAILED) return;
    steps = static_cast<Steps*>(shared);
    std::int64_t nobody = 0;
    steps->first_program.compare_exchange_strong(nobody, ::getpid());
}

bool inside(const char* path) {
    const std::size_t length = std::strlen(steps->folder);
    return std::strncmp(path, steps->folder, length) == 0 && path[length] == '/';
}

/// The file's path where it is one of the folder; a socket or a terminal has none.
bool path_of(int file, char (&path)[longest_path]) {
    char link[words];
    std::snprintf(link, sizeof link, "/proc/self/fd/%d", file);
    const ssize_t length = ::readlink(link, path, longest_path - 1);
    if (length <= 0) return false;
    path[length] = '\0';
    return inside(path);
}

void die() {
    const auto first = static_cast<pid_t>(steps->first_program.load());
    if (first != ::getpid()) ::kill(first, SIGKILL);
    ::kill(::getpid(), SIGKILL);
    for (;;)
        ::pause();
}

/// One step. `half`: writes the first half, where there is one. @returns false: it has to fail.
template <class Half>
bool pass(Kind kind, const char* what, const char* path, std::size_t bytes, Half half) {
    const std::uint64_t number = ++steps->count;
    if (number <= most_logged) {
        const char* name_at = std::strrchr(path, '/');
        std::snprintf(steps->log[number - 1], words, "%s %.40s %zu", what,
                      name_at ? name_at + 1 : path, bytes);
    }
    if (number == steps->kill_at) {
        if (steps->tear != 0) half();
        die();
    }
    const auto error = static_cast<int>(steps->fail_error.load());
    if (error == 0 || (steps->fail_kinds.load() & kind) == 0) return true;
    ++steps->failed;
    errno = error;
    return false;
}

bool pass_file(Kind kind, const char* what, int file, std::size_t bytes = 0) {
    char path[longest_path];
    if (steps == nullptr || !path_of(file, path)) return true;
    return pass(kind, what, path, bytes, [] {});
}

template <class Half> bool pass_data(const char* what, int file, std::size_t bytes, Half half) {
    char path[longest_path];
    if (steps == nullptr || !path_of(file, path)) return true;
    return pass(content, what, path, bytes, half);
}

/// Names come relative or absolute: what they lead to decides, and the folder they lie in must.
bool pass_name(const char* what, const char* path) {
    if (steps == nullptr) return true;
    char folder[longest_path];
    std::snprintf(folder, sizeof folder, "%s", path);
    char* slash = std::strrchr(folder, '/');
    if (slash == nullptr) return true;
    *slash = '\0';
    char real[4096];
    if (::realpath(folder, real) == nullptr) return true;
    const std::size_t length = std::strlen(steps->folder);
    if (std::strncmp(real, steps->folder, length) != 0) return true;
    return pass(names, what, path, 0, [] {});
}

} // namespace

extern "C" {

ssize_t write(int file, const void* bytes, size_t count) {
    static const auto real = next<ssize_t(int, const void*, size_t)>("write");
    if (!pass_data("write", file, count, [&] { (void)real(file, bytes, count / 2); })) return -1;
    return real(file, bytes, count);
}

ssize_t pwrite(int file, const void* bytes, size_t count, off_t at) {
    static const auto real = next<ssize_t(int, const void*, size_t, off_t)>("pwrite");
    if (!pass_data("pwrite", file, count, [&] { (void)real(file, bytes, count / 2, at); }))
        return -1;
    return real(file, bytes, count, at);
}

ssize_t pwrite64(int file, const void* bytes, size_t count, off64_t at) {
    static const auto real = next<ssize_t(int, const void*, size_t, off64_t)>("pwrite64");
    if (!pass_data("pwrite", file, count, [&] { (void)real(file, bytes, count / 2, at); }))
        return -1;
    return real(file, bytes, count, at);
}

ssize_t writev(int file, const struct iovec* pieces, int count) {
    static const auto real = next<ssize_t(int, const struct iovec*, int)>("writev");
    if (!pass_data("writev", file, 0, [&] { (void)real(file, pieces, 1); })) return -1;
    return real(file, pieces, count);
}

int fsync(int file) {
    static const auto real = next<int(int)>("fsync");
    return pass_file(durability, "fsync", file) ? real(file) : -1;
}

int fdatasync(int file) {
    static const auto real = next<int(int)>("fdatasync");
    return pass_file(durability, "fdatasync", file) ? real(file) : -1;
}

int ftruncate(int file, off_t size) {
    static const auto real = next<int(int, off_t)>("ftruncate");
    return pass_file(content, "ftruncate", file) ? real(file, size) : -1;
}

int ftruncate64(int file, off64_t size) {
    static const auto real = next<int(int, off64_t)>("ftruncate64");
    return pass_file(content, "ftruncate", file) ? real(file, size) : -1;
}

int rename(const char* from, const char* to) {
    static const auto real = next<int(const char*, const char*)>("rename");
    return pass_name("rename", to) ? real(from, to) : -1;
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) {
    static const auto real = next<int(int, const char*, int, const char*, unsigned)>("renameat2");
    return pass_name("rename", to) ? real(from_folder, from, to_folder, to, flags) : -1;
}

int unlink(const char* path) {
    static const auto real = next<int(const char*)>("unlink");
    return pass_name("unlink", path) ? real(path) : -1;
}

int remove(const char* path) {
    static const auto real = next<int(const char*)>("remove");
    return pass_name("unlink", path) ? real(path) : -1;
}

int mkdir(const char* path, mode_t mode) {
    static const auto real = next<int(const char*, mode_t)>("mkdir");
    return pass_name("mkdir", path) ? real(path, mode) : -1;
}

} // extern "C"
