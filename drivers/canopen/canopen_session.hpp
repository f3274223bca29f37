#pragma once
// One CANopen node from its reset to its process data, watched for as long as it sends. What its
// PDOs hold is read from the node itself. Loop-bound.

#include "drivers/canopen/canopen_node.hpp"
#include "drivers/canopen/node_guard.hpp"
#include "drivers/canopen/pdo_layout.hpp"
#include "drivers/canopen/register_watch.hpp"
#include "drivers/instrument.hpp"

#include <optional>
#include <vector>

namespace axiscal {

struct CanOpenSetup {
    LinkSettings link;
    int node = 0;              ///< 1 .. 127
    std::uint16_t profile = 0; ///< CiA number that the node must have
    Duration sample_period{};  ///< asked of the node for the PDOs that are used
    /// Between two readings: a stream is fetched in batches, for the kernel has stamped each frame.
    Duration rest{};
};

struct PdoArrival {
    std::size_t layout = 0; ///< index into layouts()
    CanFrame frame;
    MonotonicTime at;
    std::uint64_t dropped = 0; ///< by the kernel before it, since opening
    bool in_error = false;     ///< the node had told of a fault that was not over
};

class CanOpenSession {
public:
    /// `counters` is borrowed.
    CanOpenSession(CanOpenSetup setup, InstrumentCounters& counters);

    /// Opens the link, resets the node's communication, checks its profile, reads who it is and
    /// what its PDOs hold. The node is pre-operational then and can be asked.
    /// @errors of the link and the node; Fault::bad_configuration for another profile.
    Task<Result<void>> open(InstrumentContext context);
    [[nodiscard]] CanOpenNode& node() { return *node_; }
    [[nodiscard]] std::uint32_t device_type() const { return device_type_; }
    [[nodiscard]] const std::vector<PdoLayout>& layouts() const { return layouts_; }
    /// Sets period and heartbeat and starts the node; one that has no heartbeat is guarded. @param
    /// used  indices into layouts().
    Task<Result<void>> start(std::vector<std::size_t> used);
    /// PDOs that are used, in their order, at least one.
    /// @errors of the link; silence(); Fault::link_closed when the node was reset or stopped.
    Task<Result<std::vector<PdoArrival>>> next();
    /// A PDO ended before the object that is read from it: counted and told.
    void take_short_frame();
    /// The socket is closed; open() may follow.
    void close();

private:
    Task<Result<void>> identify();
    Task<Result<std::uint32_t>> number_or(ObjectKey key, std::uint32_t otherwise);
    Task<Result<std::string>> text_or_nothing(ObjectKey key);
    Task<Result<void>> read_layout(int number);
    Task<Result<void>> set_up(const PdoLayout& layout);
    Task<Result<void>> ask_for_heartbeat();
    Task<Result<void>> read_error_register();
    Task<Result<void>> guard();
    Task<Result<void>> ask_error_register();
    void judge_error_register(unsigned errors);
    [[nodiscard]] MonotonicTime silent_from() const;
    Task<Result<std::vector<TimedCanFrame>>> read_on();
    Result<void> take(const TimedCanFrame& timed, std::vector<PdoArrival>& arrived);
    Result<void> take_state(NodeState state, MonotonicTime at);
    void take_emergency(const Emergency& emergency);

    CanOpenSetup setup_;
    InstrumentCounters& counters_;
    InstrumentContext context_;
    std::unique_ptr<CanLink> link_;
    std::unique_ptr<CanOpenNode> node_;
    std::uint32_t device_type_ = 0;
    std::vector<PdoLayout> layouts_;
    std::vector<std::size_t> used_;
    bool beats_ = false, in_error_ = false, operational_ = false;
    MonotonicTime last_beat_{}, last_pdo_{};
    Duration beat_patience_{};
    NodeGuard guard_;
    RegisterWatch register_watch_;
    std::optional<Error> then_;    ///< told after the PDOs that came before it
    std::uint64_t bus_errors_ = 0; ///< counted so far
};

} // namespace axiscal
