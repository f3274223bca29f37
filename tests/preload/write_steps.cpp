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
#include "steps.hpp"

#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace axiscal::preload {

Steps* steps = nullptr;

namespace {

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

} // namespace

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

bool is_sought(const char* what, const char* name) {
    if (steps->kill_what[0] == '\0') return true;
    char label[words];
    std::snprintf(label, sizeof label, "%s %.40s", what, name);
    for (char* letter = label; *letter != '\0'; ++letter)
        if (*letter >= '0' && *letter <= '9') *letter = '0';
    return std::strcmp(label, steps->kill_what) == 0;
}

bool pass_file(Kind kind, const char* what, int file, std::size_t bytes) {
    char path[longest_path];
    if (steps == nullptr || !path_of(file, path)) return true;
    return pass(kind, what, path, bytes, [] {});
}

namespace {

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

} // namespace

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

bool pass_open(int folder, const char* path, int flags) {
    if (steps == nullptr || (flags & (O_CREAT | O_TRUNC)) == 0) return true;
    const int error = errno;
    const bool there = ::faccessat(folder, path, F_OK, AT_SYMLINK_NOFOLLOW) == 0;
    errno = error;
    if (there) return (flags & O_TRUNC) == 0 || pass_name(content, "empty", folder, path);
    return (flags & O_CREAT) == 0 || pass_name(names, "create", folder, path);
}

} // namespace axiscal::preload
