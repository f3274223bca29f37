#pragma once
// Sees every SMB frame that leaves this process and lets none out that was forbidden. libsmbclient
// 4.17, told to require encryption, prints "failing connect" for a server without it, and then goes
// on in clear text; told to rename to a name that is taken, it deletes what bears it. Nothing it
// offers prevents either or tells afterwards. So the wire itself is asked. One a process, for one
// thread. A frame that was held back ends the connection, as far as the library can see.

#include <cstdint>
#include <limits>

namespace axiscal {

struct WireCount {
    std::uint64_t encrypted = 0; ///< frames that left encrypted
    std::uint64_t held_back = 0; ///< forbidden ones, refused with EPROTO
};

/// Those that name or carry a file; from now on, or no longer.
void forbid_readable_frames(bool forbidden);

constexpr unsigned any_number = std::numeric_limits<unsigned>::max();
/// From now on so many frames may leave that name or carry a file, readable or not.
void allow_file_frames(unsigned number);
WireCount smb_frames();

} // namespace axiscal
