#include "acquisition/publish/smb/wire_watch.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

namespace axiscal {
namespace {

// MS-SMB2 2.2.1.2 and 2.2.41: the first bytes of a readable and of an encrypted frame.
constexpr char readable_mark[] = {'\xFE', 'S', 'M', 'B'},
               encrypted_mark[] = {'\xFD', 'S', 'M', 'B'};
constexpr std::size_t length_field = 4;    // before each frame on TCP
constexpr std::size_t command_offset = 12; // in the header, two bytes, the lower one first
// What leads to the encryption or keeps the line alive, MS-SMB2 2.2.1.2: NEGOTIATE, SESSION_SETUP,
// LOGOFF, TREE_CONNECT, TREE_DISCONNECT; IOCTL (asks for a referral), CANCEL, ECHO (outside of any
// session, hence never encrypted). All others name a file or carry it.
constexpr std::array<unsigned char, 8> without_files{0, 1, 2, 3, 4, 11, 12, 13};

bool forbidden = false;
unsigned allowed = any_number;
WireCount count;

bool begins_with(const iovec& part, const char (&mark)[4]) {
    return part.iov_len > command_offset && std::memcmp(part.iov_base, mark, sizeof mark) == 0;
}

bool concerns_files(const iovec& header) {
    const auto command = static_cast<const unsigned char*>(header.iov_base)[command_offset];
    return std::ranges::find(without_files, command) == without_files.end();
}

/// false: must not leave. Encrypted ones count as concerned with files: what is not is never
/// encrypted, but for the end of a session.
bool may_leave(const iovec* parts, int parts_count) {
    if (parts_count < 2 || parts[0].iov_len != length_field) return true;
    const bool encrypted = begins_with(parts[1], encrypted_mark);
    const bool readable = begins_with(parts[1], readable_mark) && concerns_files(parts[1]);
    if (!encrypted && !readable) return true;
    if (allowed == 0 || (forbidden && readable)) {
        ++count.held_back;
        return false;
    }
    if (allowed != any_number) --allowed;
    if (encrypted) ++count.encrypted;
    return true;
}

} // namespace

void forbid_readable_frames(bool forbid) {
    forbidden = forbid;
}

void allow_file_frames(unsigned number) {
    allowed = number;
}

WireCount smb_frames() {
    return count;
}

} // namespace axiscal

/// Takes the place of the C library's in this program: libsmbclient sends by it.
extern "C" ssize_t writev(int file, const iovec* parts, int parts_count) {
    if (axiscal::may_leave(parts, parts_count))
        return ::syscall(SYS_writev, file, parts, parts_count);
    errno = EPROTO;
    return -1;
}
