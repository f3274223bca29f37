// Calls that change what stands in a file, or make it durable.
#include "steps.hpp"

#include <fcntl.h>
#include <sys/sendfile.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

using namespace axiscal::preload;

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

} // extern "C"
