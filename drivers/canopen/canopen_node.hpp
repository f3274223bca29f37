#pragma once
// Questions to one CANopen node. Loop-bound.

#include "drivers/canopen/node_messages.hpp"
#include "drivers/canopen/sdo.hpp"
#include "drivers/wire/can_link.hpp"

namespace axiscal {

/// The link and the scheduler are borrowed. While a question is open, what else the node says is
/// passed over: ask before it is started.
class CanOpenNode {
public:
    CanOpenNode(CanLink& link, Scheduler& scheduler, int node, std::string place);

    /// @errors of the link; Fault::refused with the node's reason; bad_frame; silence().
    Task<Result<std::vector<std::byte>>> read(ObjectKey key);
    /// 1 to 4 bytes as a number. @errors of read; bad_frame for another length.
    Task<Result<std::uint32_t>> read_number(ObjectKey key);
    Task<Result<void>> write_number(ObjectKey key, std::uint32_t value, int bytes);
    /// A command that no node confirms.
    Task<Result<void>> command(NmtCommand command);
    /// Whether its boot-up message comes by then.
    Task<Result<bool>> boots_up(MonotonicTime deadline);
    /// Fault::link_timeout in the one sentence that a dead node has, however it was noticed.
    [[nodiscard]] Error silence() const;
    /// "node 125 on CAN can0"
    [[nodiscard]] const std::string& name() const { return name_; }

private:
    Task<Result<std::vector<std::byte>>> carry_out(SdoTransfer transfer);
    /// Goes on with what has come; the content once done.
    Task<Result<bool>> go_on(SdoTransfer& transfer, std::vector<TimedCanFrame> arrived);

    CanLink& link_;
    Scheduler& scheduler_;
    int node_;
    std::string name_;
};

} // namespace axiscal
