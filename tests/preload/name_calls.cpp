// Calls that change names, modes and owners, or make a file by opening it.
#include "steps.hpp"

#include <cstdarg>
#include <cstdio>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

using namespace axiscal::preload;

namespace {

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
