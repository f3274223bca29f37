#include "drivers/canopen/canopen_node.hpp"

namespace axiscal {
namespace {

/// A node answers within some milliseconds; after a reset it may be busy for longer.
constexpr Duration reply_patience = std::chrono::milliseconds{500};

} // namespace

CanOpenNode::CanOpenNode(CanLink& link, Scheduler& scheduler, int node, std::string place)
    : link_{link}
    , scheduler_{scheduler}
    , node_{node}
    , name_{"node " + std::to_string(node) + " on " + std::move(place)} {}

Error CanOpenNode::silence() const {
    return {Fault::link_timeout,
            name_ + " does not answer: is it powered, and are node number and bit rate right?",
            {},
            {}};
}

Task<Result<bool>> CanOpenNode::go_on(SdoTransfer& transfer, std::vector<TimedCanFrame> arrived) {
    for (const TimedCanFrame& timed : arrived) {
        const auto step = transfer.take(timed.frame);
        if (!step) co_return tl::unexpected<Error>(step.error());
        if (*step == SdoTransfer::Step::done) co_return true;
        if (*step == SdoTransfer::Step::ignored) continue;
        const auto sent =
            co_await link_.send(transfer.request(), scheduler_.now() + reply_patience);
        if (!sent) co_return tl::unexpected<Error>(sent.error());
    }
    co_return false;
}

Task<Result<std::vector<std::byte>>> CanOpenNode::carry_out(SdoTransfer transfer) {
    const auto sent = co_await link_.send(transfer.request(), scheduler_.now() + reply_patience);
    if (!sent) co_return tl::unexpected<Error>(sent.error());
    CanFrame asked = transfer.request();
    MonotonicTime deadline = scheduler_.now() + reply_patience;
    for (;;) {
        auto arrived = co_await link_.read_some(deadline);
        if (!arrived && arrived.error().fault == Fault::link_timeout)
            co_return tl::unexpected<Error>(silence());
        if (!arrived) co_return tl::unexpected<Error>(arrived.error());
        const auto done = co_await go_on(transfer, *std::move(arrived));
        if (!done) co_return tl::unexpected<Error>(done.error());
        if (*done) co_return transfer.content();
        if (asked == transfer.request()) continue; // strangers do not prolong the wait
        asked = transfer.request();
        deadline = scheduler_.now() + reply_patience;
    }
}

Task<Result<std::vector<std::byte>>> CanOpenNode::read(ObjectKey key) {
    SdoTransfer transfer = SdoTransfer::read(node_, key);
    auto content = co_await carry_out(std::move(transfer));
    co_return content;
}

Task<Result<std::uint32_t>> CanOpenNode::read_number(ObjectKey key) {
    AXISCAL_CO_TRY(const std::vector<std::byte> content, co_await read(key));
    if (content.empty() || content.size() > 4)
        co_return fail(Fault::bad_frame, name_ + " gives " + std::to_string(content.size()) +
                                             " bytes for the number " + name_of(key));
    std::uint32_t value = 0;
    for (std::size_t at = 0; at < content.size(); ++at)
        value |= std::to_integer<std::uint32_t>(content[at]) << (8 * at);
    co_return value;
}

Task<Result<void>> CanOpenNode::write_number(ObjectKey key, std::uint32_t value, int bytes) {
    SdoTransfer transfer = SdoTransfer::write(node_, key, value, bytes);
    const auto done = co_await carry_out(std::move(transfer));
    if (!done) co_return tl::unexpected<Error>(done.error());
    co_return Result<void>{};
}

Task<Result<void>> CanOpenNode::command(NmtCommand command) {
    const CanFrame frame = nmt_frame(command, node_);
    auto sent = co_await link_.send(frame, scheduler_.now() + reply_patience);
    co_return sent;
}

Task<Result<bool>> CanOpenNode::boots_up(MonotonicTime deadline) {
    for (;;) {
        const auto arrived = co_await link_.read_some(deadline);
        if (!arrived && arrived.error().fault == Fault::link_timeout) co_return false;
        if (!arrived) co_return tl::unexpected<Error>(arrived.error());
        for (const TimedCanFrame& timed : *arrived)
            if (decode_heartbeat(timed.frame, node_) == NodeState::boot_up) co_return true;
    }
}

} // namespace axiscal
