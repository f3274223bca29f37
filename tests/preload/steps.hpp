#pragma once
// What the interposed calls ask before they go on to the kernel: write_steps.cpp counts.

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <dlfcn.h>

// Hidden: the program that this library is loaded into must not meet these names.
#pragma GCC visibility push(hidden)
namespace axiscal::preload {

inline constexpr std::size_t longest_path = 256, words = 64, most_logged = 8192;

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
    char kill_what[words];          ///< "pwrite x.axiscal-wal", each digit a 0; empty: any step
    char log[most_logged][words];
};

/// Null where nothing is to be counted.
extern Steps* steps;

/// What the call would have reached without this library.
template <class Function> Function* next(const char* symbol) {
    return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, symbol));
}

/// The file's path where it is one of the folder; a socket or a terminal has none.
bool path_of(int file, char (&path)[longest_path]);

/// What a step does and to which file, whatever the date in its name.
bool is_sought(const char* what, const char* name);

[[noreturn]] void die();

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

template <class Half> bool pass_data(const char* what, int file, std::size_t bytes, Half half) {
    char path[longest_path];
    if (steps == nullptr || !path_of(file, path)) return true;
    return pass(content, what, path, bytes, half);
}

bool pass_file(Kind kind, const char* what, int file, std::size_t bytes = 0);

/// What the folder of a name leads to decides, and it must be the watched one or lie in it.
bool pass_name(Kind kind, const char* what, int folder, const char* path);

/// An open changes the folder when it makes a file or empties one; any other is no step.
bool pass_open(int folder, const char* path, int flags);

} // namespace axiscal::preload

#pragma GCC visibility pop
