#pragma once
// One Modbus line (RTU) or connection (TCP) that instruments share: requests take turns, and a
// value is that of this request or none. Loop-bound.
//
// A frame of RTU does not tell which request it answers. So the line is silent before each request,
// and a unit that did not answer is not asked again while its answer may still come. Frames of TCP
// bear the number of their transaction: late ones are passed over.

#include "drivers/wire/byte_link.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace axiscal {

/// One request. Function 1 reads coils, 2 discrete inputs, 3 holding registers, 4 input registers;
/// addresses are those on the wire, from 0.
struct ModbusRead {
    int unit_id = 1, function = 3, address = 0, count = 1;
    Duration timeout = std::chrono::milliseconds{500}; ///< for the whole reply
    Duration gap = std::chrono::milliseconds{5};       ///< silence kept before the request
};

struct ModbusWords {
    std::vector<std::uint16_t> words; ///< a bit is 0 or 1
    MonotonicTime asked_at; ///< right before the request
    MonotonicTime read_at;  ///< right after the last byte of the reply was read
};

class ModbusBus {
public:
    /// A unit on a serial line is not asked again for so long, or twice its time-out, after a
    /// request that it did not answer.
    static constexpr Duration latest_answer = std::chrono::seconds{2};

    /// `scheduler` and `opener` are borrowed and must outlive the coroutines that read.
    ModbusBus(LinkSettings settings, Scheduler& scheduler, LinkOpener& opener);
    ~ModbusBus();
    ModbusBus(const ModbusBus&) = delete;
    ModbusBus& operator=(const ModbusBus&) = delete;

    /// Queued behind the requests of the other instruments on this line.
    /// @errors Fault::link_closed (device or peer gone), link_timeout (no or half a reply, or a
    /// gateway that got none from the unit), checksum (bad CRC), bad_frame (a reply that is none,
    /// or another's), refused (the instrument answered with a Modbus exception).
    Task<Result<ModbusWords>> read(ModbusRead request);

private:
    class Line;
    std::shared_ptr<Line> line_; ///< shared with the coroutines that read
};

/// All lines of the station. A line is one bus, by whichever name it is asked for. Loop-bound.
class ModbusBuses {
public:
    /// Borrowed, as those of ModbusBus.
    ModbusBuses(Scheduler& scheduler, LinkOpener& opener)
        : scheduler_{scheduler}
        , opener_{opener} {}
    /// @errors Fault::bad_configuration when the line is in use with other settings.
    Result<ModbusBus*> bus(const LinkSettings& settings);
    [[nodiscard]] std::size_t size() const { return buses_.size(); }

private:
    struct Shared {
        std::string asked; ///< its settings in words
        std::unique_ptr<ModbusBus> bus;
    };
    Scheduler& scheduler_;
    LinkOpener& opener_;
    std::map<std::string, Shared> buses_;
};

} // namespace axiscal
