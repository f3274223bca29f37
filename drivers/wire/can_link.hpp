#pragma once
// Frames of a CAN bus in and out, each with the kernel's own time of arrival. Loop-bound.

#include "drivers/wire/byte_link.hpp"
#include "drivers/wire/can_frame.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace axiscal {

struct TimedCanFrame {
    CanFrame frame;
    MonotonicTime at; ///< when the kernel took it from the bus
    /// Frames that the kernel had dropped before this one, since opening: nobody read in time.
    std::uint64_t dropped = 0;
};

class CanLink {
public:
    virtual ~CanLink() = default;
    /// From now on data frames with these 11-bit identifiers are delivered; none before. All others
    /// stay in the kernel, however many they are.
    virtual Result<void> hear(const std::vector<std::uint32_t>& ids) = 0;
    /// All that has come, at least one frame.
    /// @errors Fault::link_timeout at the deadline; link_closed when the interface is missing, down
    /// or bus-off, in the words of can_absence.
    virtual Task<Result<std::vector<TimedCanFrame>>> read_some(MonotonicTime deadline) = 0;
    /// Handed to the kernel: that somebody on the bus heard it is not known.
    /// @errors as read_some.
    virtual Task<Result<void>> send(CanFrame frame, MonotonicTime deadline) = 0;
    /// Complaints of the controller (receive overflow, error passive) since opening.
    [[nodiscard]] virtual std::uint64_t bus_errors() const { return 0; }
};

/// Opens a raw socket on the interface, which hears nothing yet. `scheduler` must outlive the link.
/// @errors Fault::link_closed in the words of can_absence; bad_configuration for an interface that
/// is no CAN bus.
Result<std::unique_ptr<CanLink>> open_socketcan(Scheduler& scheduler, const std::string& interface);

/// The same over a socket that is open already, which the link closes. Tests give one end of a
/// socketpair that carries struct can_frame.
std::unique_ptr<CanLink>
can_link_over(Scheduler& scheduler, int descriptor, const std::string& interface);

} // namespace axiscal
