#include "tests/unit/publish/denied_calls.hpp"

#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <string_view>
#include <sys/syscall.h>
#include <unistd.h>

namespace axiscal::testing {
namespace {

DeniedCalls* denied = nullptr;

void step() {
    if (denied && denied->die_at > 0 && --denied->die_at == 0) ::kill(::getpid(), SIGKILL);
}

/// true: errno is set.
bool denies(int DeniedCalls::*error, std::string_view from, std::string_view to) {
    if (!denied || denied->*error == 0) return false;
    if (!from.starts_with(denied->from) || !to.starts_with(denied->to)) return false;
    errno = denied->*error;
    return true;
}

bool denies_sync() {
    if (!denied || denied->sync == 0) return false;
    errno = denied->sync;
    return true;
}

} // namespace

DeniedCalls::DeniedCalls() {
    denied = this;
}
DeniedCalls::~DeniedCalls() {
    denied = nullptr;
}

} // namespace axiscal::testing

using axiscal::testing::DeniedCalls;
using axiscal::testing::denies;
using axiscal::testing::denies_sync;
using axiscal::testing::step;

// Definitions of the program itself come before those of the C library.
extern "C" {

int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) {
    step();
    if (denies(&DeniedCalls::rename_to_free, from, to)) return -1;
    return static_cast<int>(::syscall(SYS_renameat2, from_folder, from, to_folder, to, flags));
}

int rename(const char* from, const char* to) {
    step();
    if (denies(&DeniedCalls::rename, from, to)) return -1;
    return static_cast<int>(::syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}

int link(const char* from, const char* to) {
    step();
    if (denies(&DeniedCalls::link, from, to)) return -1;
    return static_cast<int>(::syscall(SYS_linkat, AT_FDCWD, from, AT_FDCWD, to, 0));
}

int fsync(int file) {
    step();
    if (denies_sync()) return -1;
    return static_cast<int>(::syscall(SYS_fsync, file));
}

} // extern "C"
