#include "drivers/trigger/single_register_map.hpp"

namespace axiscal {

AddressSpace SingleRegisterMap::space() const {
    return AddressSpace{0, 0, 1, 1, 1};
}

RegisterImage SingleRegisterMap::image() const {
    RegisterImage image;
    image.space = space();
    image.holding[0] = last_request_.value_or(0);
    image.input[0] = done_;
    return image;
}

MapNews SingleRegisterMap::write(const ModbusRequest& request, MonotonicTime at) {
    MapNews news;
    const std::uint16_t sequence = request.values.front();
    const bool first_seen = !last_request_;
    if (last_request_ == sequence) return news; // clients write the same value all the time
    last_request_ = sequence;
    if (sequence == 0) return news;
    TriggerEvent event;
    event.sequence = sequence;
    event.at = at;
    event.standing = first_seen && !armed_;
    news.events.push_back(event);
    return news;
}

MapNews SingleRegisterMap::tick(MonotonicTime /*now*/) {
    return {};
}

void SingleRegisterMap::arm() {
    armed_ = true;
    done_ = 0;
}

/// This CNC has no command to end a run: whoever else did, it is told at once.
void SingleRegisterMap::end_run(RunEnd /*end*/) {
    done_ = no_run_sequence;
}

void SingleRegisterMap::refuse(std::uint16_t /*sequence*/, Fault /*fault*/) {}
void SingleRegisterMap::show(const PortStatus& /*status*/) {}

} // namespace axiscal
