// Counts, from outside, every step by which a program changes a folder: write, pwrite, writev,
// sendfile, copy_file_range, fsync, fdatasync, truncation, an open that makes or
// empties a file, rename, link, unlink, rmdir, mkdir, a change of mode or owner; kills the program
// before one of them, tears one in two, or lets some of them fail. LD_PRELOAD of the shipped
// programs; nothing of ours is linked. These are all of the calls that change files which the
// programs and the libraries they load import (nm -D), but for the memory that SQLite shares
// between its connections.
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
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

namespace {

constexpr std::size_t longest_path = 256, words = 64, most_logged = 8192;

/// Bits of Steps::fail_kinds.
enum Kind : std::uint32_t { content = 1, durability = 2, names = 4, attributes = 8 };

/// Shared by the programs and the test; steps.py packs the same bytes.
struct Steps {
    std::atomic<std::uint64_t> count;
    std::uint64_t kill_at;                 ///< before this one of kill_what, from 1; 0: never
    std::uint64_t tear;                    ///< 1: half of the bytes of that step are written first
    std::atomic<std::uint64_t> fail_error; ///< errno for the steps of fail_kinds; 0: none fails
    std::atomic<std::uint64_t> fail_kinds, failed;
    std::atomic<std::int64_t> first_program;
    std::atomic<std::uint64_t> met; ///< steps like kill_what
    char folder[longest_path];      ///< real path; steps elsewhere are not counted
    char kill_what[words];          ///< "pwrite x.axiscal-wal", each digit a 0
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

/// What a step does and to which file, whatever the date in its name.
bool is_sought(const char* what, const char* name) {
    char label[words];
    std::snprintf(label, sizeof label, "%s %.40s", what, name);
    for (char* letter = label; *letter != '\0'; ++letter)
        if (*letter >= '0' && *letter <= '9') *letter = '0';
    return std::strcmp(label, steps->kill_what) == 0;
}

/// One step. `half`: writes the first half, where there is one. @returns false: it has to fail.
template <class Half>
bool pass(Kind kind, const char* what, const char* path, std::size_t bytes, Half half) {
    const std::uint64_t number = ++steps->count;
    const char* slash = std::strrchr(path, '/');
    const char* name = slash ? slash + 1 : path;
    if (number <= most_logged)
        std::snprintf(steps->log[number - 1], words, "%s %.40s %zu", what, name, bytes);
    if (is_sought(what, name) && ++steps->met == steps->kill_at) {
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

/// A name as the kernel would read it: relative ones begin at `folder`, a descriptor or AT_FDCWD.
bool whole_name(int folder, const char* path, char (&whole)[4096]) {
    if (path[0] == '/') return std::snprintf(whole, sizeof whole, "%s", path) > 0;
    char link[words] = "/proc/self/cwd";
    if (folder != AT_FDCWD) std::snprintf(link, sizeof link, "/proc/self/fd/%d", folder);
    const ssize_t length = ::readlink(link, whole, sizeof whole - 1);
    if (length <= 0) return false;
    const auto at = static_cast<std::size_t>(length);
    return std::snprintf(whole + at, sizeof whole - at, "/%s", path) > 0;
}

/// What the folder of a name leads to decides, and it must be the watched one or lie in it.
bool pass_name(Kind kind, const char* what, int folder, const char* path) {
    char whole[4096], real[4096];
    if (steps == nullptr || path == nullptr || !whole_name(folder, path, whole)) return true;
    char* slash = std::strrchr(whole, '/');
    *slash = '\0';
    if (::realpath(slash == whole ? "/" : whole, real) == nullptr) return true;
    const std::size_t length = std::strlen(steps->folder);
    if (std::strncmp(real, steps->folder, length) != 0) return true;
    if (real[length] != '\0' && real[length] != '/') return true;
    return pass(kind, what, path, 0, [] {});
}

/// An open changes the folder when it makes a file or empties one; any other is no step.
bool pass_open(int folder, const char* path, int flags) {
    if (steps == nullptr || (flags & (O_CREAT | O_TRUNC)) == 0) return true;
    const int error = errno;
    const bool there = ::faccessat(folder, path, F_OK, AT_SYMLINK_NOFOLLOW) == 0;
    errno = error;
    if (there) return (flags & O_TRUNC) == 0 || pass_name(content, "empty", folder, path);
    return (flags & O_CREAT) == 0 || pass_name(names, "create", folder, path);
}

/// The flags by which fopen opens.
int flags_of(const char* mode) {
    if (mode[0] == 'w') return O_CREAT | O_TRUNC;
    return mode[0] == 'a' ? O_CREAT : 0;
}

/// The mode stands there only when a file may be made.
mode_t mode_in(int flags, std::va_list list) {
    return (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(list, mode_t) : 0;
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
    return pass_name(names, "rename", AT_FDCWD, to) ? real(from, to) : -1;
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) {
    static const auto real = next<int(int, const char*, int, const char*, unsigned)>("renameat2");
    return pass_name(names, "rename", to_folder, to) ? real(from_folder, from, to_folder, to, flags)
                                                     : -1;
}

int unlink(const char* path) {
    static const auto real = next<int(const char*)>("unlink");
    return pass_name(names, "unlink", AT_FDCWD, path) ? real(path) : -1;
}

int remove(const char* path) {
    static const auto real = next<int(const char*)>("remove");
    return pass_name(names, "unlink", AT_FDCWD, path) ? real(path) : -1;
}

int mkdir(const char* path, mode_t mode) {
    static const auto real = next<int(const char*, mode_t)>("mkdir");
    return pass_name(names, "mkdir", AT_FDCWD, path) ? real(path, mode) : -1;
}

int mkdirat(int folder, const char* path, mode_t mode) {
    static const auto real = next<int(int, const char*, mode_t)>("mkdirat");
    return pass_name(names, "mkdir", folder, path) ? real(folder, path, mode) : -1;
}

int unlinkat(int folder, const char* path, int flags) {
    static const auto real = next<int(int, const char*, int)>("unlinkat");
    const char* what = (flags & AT_REMOVEDIR) != 0 ? "rmdir" : "unlink";
    return pass_name(names, what, folder, path) ? real(folder, path, flags) : -1;
}

int rmdir(const char* path) {
    static const auto real = next<int(const char*)>("rmdir");
    return pass_name(names, "rmdir", AT_FDCWD, path) ? real(path) : -1;
}

int renameat(int from_folder, const char* from, int to_folder, const char* to) {
    static const auto real = next<int(int, const char*, int, const char*)>("renameat");
    return pass_name(names, "rename", to_folder, to) ? real(from_folder, from, to_folder, to) : -1;
}

int link(const char* from, const char* to) {
    static const auto real = next<int(const char*, const char*)>("link");
    return pass_name(names, "link", AT_FDCWD, to) ? real(from, to) : -1;
}

int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) {
    static const auto real = next<int(int, const char*, int, const char*, int)>("linkat");
    if (!pass_name(names, "link", to_folder, to)) return -1;
    return real(from_folder, from, to_folder, to, flags);
}

int symlink(const char* to, const char* path) {
    static const auto real = next<int(const char*, const char*)>("symlink");
    return pass_name(names, "symlink", AT_FDCWD, path) ? real(to, path) : -1;
}

ssize_t sendfile(int to, int from, off_t* at, size_t count) {
    static const auto real = next<ssize_t(int, int, off_t*, size_t)>("sendfile");
    if (!pass_data("sendfile", to, count, [&] { (void)real(to, from, at, count / 2); })) return -1;
    return real(to, from, at, count);
}

ssize_t sendfile64(int to, int from, off64_t* at, size_t count) {
    static const auto real = next<ssize_t(int, int, off64_t*, size_t)>("sendfile64");
    if (!pass_data("sendfile", to, count, [&] { (void)real(to, from, at, count / 2); })) return -1;
    return real(to, from, at, count);
}

ssize_t
copy_file_range(int from, off64_t* from_at, int to, off64_t* to_at, size_t count, unsigned flags) {
    static const auto real =
        next<ssize_t(int, off64_t*, int, off64_t*, size_t, unsigned)>("copy_file_range");
    const auto half = [&] { (void)real(from, from_at, to, to_at, count / 2, flags); };
    if (!pass_data("copy_file_range", to, count, half)) return -1;
    return real(from, from_at, to, to_at, count, flags);
}

int truncate(const char* path, off_t size) {
    static const auto real = next<int(const char*, off_t)>("truncate");
    return pass_name(content, "truncate", AT_FDCWD, path) ? real(path, size) : -1;
}

int truncate64(const char* path, off64_t size) {
    static const auto real = next<int(const char*, off64_t)>("truncate64");
    return pass_name(content, "truncate", AT_FDCWD, path) ? real(path, size) : -1;
}

int fchmod(int file, mode_t mode) {
    static const auto real = next<int(int, mode_t)>("fchmod");
    return pass_file(attributes, "fchmod", file) ? real(file, mode) : -1;
}

int fchmodat(int folder, const char* path, mode_t mode, int flags) {
    static const auto real = next<int(int, const char*, mode_t, int)>("fchmodat");
    return pass_name(attributes, "chmod", folder, path) ? real(folder, path, mode, flags) : -1;
}

int chmod(const char* path, mode_t mode) {
    static const auto real = next<int(const char*, mode_t)>("chmod");
    return pass_name(attributes, "chmod", AT_FDCWD, path) ? real(path, mode) : -1;
}

int fchown(int file, uid_t user, gid_t group) {
    static const auto real = next<int(int, uid_t, gid_t)>("fchown");
    return pass_file(attributes, "fchown", file) ? real(file, user, group) : -1;
}

int chown(const char* path, uid_t user, gid_t group) {
    static const auto real = next<int(const char*, uid_t, gid_t)>("chown");
    return pass_name(attributes, "chown", AT_FDCWD, path) ? real(path, user, group) : -1;
}

// By their symbols: hardened headers define these names themselves.
#define AXISCAL_OPEN(symbol)                                                                       \
    int step_##symbol(const char* path, int flags, ...) __asm__(#symbol);                          \
    int step_##symbol(const char* path, int flags, ...) {                                          \
        static const auto real = next<int(const char*, int, ...)>(#symbol);                        \
        std::va_list list;                                                                         \
        va_start(list, flags);                                                                     \
        const mode_t mode = mode_in(flags, list);                                                  \
        va_end(list);                                                                              \
        return pass_open(AT_FDCWD, path, flags) ? real(path, flags, mode) : -1;                    \
    }
#define AXISCAL_OPENAT(symbol)                                                                     \
    int step_##symbol(int folder, const char* path, int flags, ...) __asm__(#symbol);              \
    int step_##symbol(int folder, const char* path, int flags, ...) {                              \
        static const auto real = next<int(int, const char*, int, ...)>(#symbol);                   \
        std::va_list list;                                                                         \
        va_start(list, flags);                                                                     \
        const mode_t mode = mode_in(flags, list);                                                  \
        va_end(list);                                                                              \
        return pass_open(folder, path, flags) ? real(folder, path, flags, mode) : -1;              \
    }
#define AXISCAL_FOPEN(symbol)                                                                      \
    std::FILE* step_##symbol(const char* path, const char* mode) __asm__(#symbol);                 \
    std::FILE* step_##symbol(const char* path, const char* mode) {                                 \
        static const auto real = next<std::FILE*(const char*, const char*)>(#symbol);              \
        return pass_open(AT_FDCWD, path, flags_of(mode)) ? real(path, mode) : nullptr;             \
    }
AXISCAL_OPEN(open)
AXISCAL_OPEN(open64)
AXISCAL_OPENAT(openat)
AXISCAL_OPENAT(openat64)
AXISCAL_FOPEN(fopen)
AXISCAL_FOPEN(fopen64)

} // extern "C"
