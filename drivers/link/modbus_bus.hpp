#pragma once
// One Modbus line (RTU) or connection (TCP) with the thread that owns its libmodbus context.
// libmodbus contexts are not thread-safe and block, so nothing else ever touches one.

#include "drivers/link/byte_link.hpp"

#include <boost/asio/any_io_executor.hpp>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace axiscal {

/// One request. Function 3 reads holding registers, 4 input registers; addresses are those on the
/// wire, from 0.
struct ModbusRead {
    int unit_id = 1, function = 3, address = 0, count = 1;
    Duration timeout = std::chrono::milliseconds{500}; ///< for the whole reply
    Duration gap = std::chrono::milliseconds{5};       ///< silence kept before the request
};

struct ModbusWords {
    std::vector<std::uint16_t> words;
    MonotonicTime asked_at; ///< taken on the bus thread, right before the request
    MonotonicTime read_at;  ///< the same, right after the reply
};

/// Thread-safe in `read` (called on the loop, served on the bus thread); construction and
/// destruction belong to the loop. Destruction waits a second for the request in flight; a line
/// that hangs in the kernel (close(2) of a dead USB adapter: 30 s) is left to its thread.
class ModbusBus {
public:
    ModbusBus(LinkSettings settings, boost::asio::any_io_executor loop);
    ~ModbusBus();
    ModbusBus(const ModbusBus&) = delete;
    ModbusBus& operator=(const ModbusBus&) = delete;

    /// Queued behind the requests of the other instruments on this line.
    /// @errors Fault::link_closed (device or peer gone), link_timeout (no or half a reply),
    /// checksum (bad CRC), bad_frame (a reply that is none), refused (the instrument answered with
    /// a Modbus exception).
    Task<Result<ModbusWords>> read(ModbusRead request);
    [[nodiscard]] const LinkSettings& settings() const;

private:
    struct Pending;
    class Context;
    class Line;
    std::shared_ptr<Line> line_; ///< shared with the thread
};

/// All lines of the station: instruments on one line share its bus. Loop-bound.
class ModbusBuses {
public:
    /// Where a line that is asked for is opened in fact (a recorder stands between); itself when
    /// empty.
    using Detour = std::function<Result<LinkSettings>(const LinkSettings&)>;
    explicit ModbusBuses(boost::asio::any_io_executor loop, Detour detour = {})
        : loop_{std::move(loop)}
        , detour_{std::move(detour)} {}
    /// @errors Fault::bad_configuration when the line is in use with other settings.
    Result<ModbusBus*> bus(const LinkSettings& settings);
    [[nodiscard]] std::size_t size() const { return buses_.size(); }

private:
    struct Line {
        std::string asked; ///< its settings in words
        std::unique_ptr<ModbusBus> bus;
    };
    boost::asio::any_io_executor loop_;
    Detour detour_;
    std::map<std::string, Line> buses_;
};

} // namespace axiscal
