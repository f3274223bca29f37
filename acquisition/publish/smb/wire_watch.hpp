#pragma once
// Sees every SMB frame that leaves this process and lets no readable one out that names or carries
// a file, once that is forbidden. libsmbclient 4.17, told to require encryption, prints "failing
// connect" for a server without it, and then goes on in clear text; nothing it offers tells
// afterwards. So the wire itself is asked. One a process, for one thread.

#include <cstdint>

namespace axiscal {

struct WireCount {
    std::uint64_t encrypted = 0; ///< frames that left encrypted
    std::uint64_t held_back = 0; ///< readable ones that were refused with EPROTO
};

/// From now on, or no longer.
void forbid_readable_frames(bool forbidden);
WireCount smb_frames();

} // namespace axiscal
