#pragma once
// The near end of a wire that this process makes, a pseudo terminal or a TCP port: another program
// opens its far end as if an instrument were there. Loop-bound.

#include "drivers/wire/byte_link.hpp"

namespace axiscal {

class NearWire {
public:
    virtual ~NearWire() = default;
    /// As a driver opens it; path or port alone.
    [[nodiscard]] virtual LinkSettings settings() const = 0;
    /// The next opening of the far end. Reading from it ends when the other side closes.
    /// @errors Fault::link_timeout.
    virtual Task<Result<std::unique_ptr<ByteLink>>> accept(MonotonicTime deadline) = 0;
    /// What was written has been read there, as far as that can be told; at the deadline at the
    /// latest.
    virtual Task<void> drain(MonotonicTime deadline) = 0;
    /// The far end is unplugged: it must be opened again, under the same name if it has one.
    /// @errors Fault::io.
    virtual Result<void> unplug() = 0;
};

/// A pseudo terminal. `name` is a symbolic link to it, made anew when it is unplugged, and replaced
/// if it is one already; empty: the kernel's own name, which changes then.
/// @errors Fault::io naming what could not be made.
Result<std::unique_ptr<NearWire>> make_pty_wire(Scheduler& scheduler, const std::string& name);
/// A port on this PC (127.0.0.1); 0: one that is free. @errors Fault::io.
Result<std::unique_ptr<NearWire>> make_tcp_wire(Scheduler& scheduler, int port);

} // namespace axiscal
