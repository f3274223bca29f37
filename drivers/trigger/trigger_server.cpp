#include "drivers/trigger/trigger_server.hpp"

namespace axiscal {

RegisterImage TriggerServer::image(MonotonicTime now) const {
    RegisterImage image = map_->image();
    image.stamp(now);
    return image;
}

void TriggerServer::write(const ModbusRequest& request, MonotonicTime at) {
    deliver(map_->write(request, at));
    changed();
}

void TriggerServer::deliver(MapNews news) {
    counters.late_indices += static_cast<std::uint64_t>(news.late_indices);
    if (!context_.sink) return;
    if (news.silent) context_.sink->on_cnc_silent(*news.silent);
    for (auto& [fault, sentence] : news.notes)
        context_.sink->on_port_note(fault, std::move(sentence));
    for (const auto& event : news.events)
        context_.sink->on_trigger(event);
}

void TriggerServer::note(Fault fault, std::string sentence) {
    if (context_.sink) context_.sink->on_port_note(fault, std::move(sentence));
}

void TriggerServer::arm() {
    map_->arm();
    changed();
}

void TriggerServer::acknowledge(const JournalReceipt& receipt) {
    map_->finish(receipt.sequence());
    changed();
}

void TriggerServer::acknowledge_skip(const JournalReceipt& receipt) {
    map_->finish_skip(receipt.sequence());
    changed();
}

void TriggerServer::end_run(RunEnd end) {
    map_->end_run(end);
    changed();
}

void TriggerServer::look() const {
    if (on_change) on_change();
}

void TriggerServer::refuse(std::uint16_t sequence, Fault fault) {
    map_->refuse(sequence, fault);
    changed();
}

void TriggerServer::publish(const PortStatus& status) {
    map_->show(status);
    changed();
}

/// What has come up may be due before keep_time() wakes; what falls away it finds by itself.
void TriggerServer::changed() const {
    const auto due = map_->due();
    const bool sooner = due && (!wakes_at_ || *due < *wakes_at_);
    if (const auto bell = bell_.lock(); bell && sooner) bell->ring();
    if (on_change) on_change();
}

Task<void> TriggerServer::keep_time(Scheduler* scheduler) {
    const auto bell = std::make_shared<Doorbell>(scheduler->executor());
    bell_ = bell;
    while (attached()) {
        wakes_at_ = map_->due();
        co_await bell->wait(*scheduler, wakes_at_);
        const MonotonicTime now = scheduler->now();
        if (const auto due = map_->due(); !due || now < *due) continue;
        deliver(map_->tick(now));
        changed();
    }
}

std::string_view shape_name(TriggerShape shape) {
    switch (shape) {
    case TriggerShape::sequence_block: return "sequence-block";
    case TriggerShape::single_register: return "single-register";
    case TriggerShape::coil_and_index: return "coil-and-index";
    case TriggerShape::dwell: return "dwell";
    }
    return "?";
}

} // namespace axiscal
