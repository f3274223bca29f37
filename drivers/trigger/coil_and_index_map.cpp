#include "drivers/trigger/coil_and_index_map.hpp"

namespace axiscal {

AddressSpace CoilAndIndexMap::space() const {
    return AddressSpace{1, 1, 1, 1, 1};
}

RegisterImage CoilAndIndexMap::image() const {
    RegisterImage image;
    image.space = space();
    image.coils[0] = coil_.value_or(false) ? 1 : 0;
    image.discrete_inputs[0] = acknowledge_ ? 1 : 0;
    image.holding[0] = index_;
    image.input[0] = done_;
    return image;
}

MapNews CoilAndIndexMap::write(const ModbusRequest& request, MonotonicTime at) {
    MapNews news;
    if (request.writes_coils())
        take_coil(request.values.front() != 0, at, news);
    else
        take_index(request.values.front(), news);
    return news;
}

void CoilAndIndexMap::take_index(std::uint16_t index, MapNews& news) {
    index_ = index;
    if (index == 0) delivered_.reset(); // a program begins: every number is fresh again
    if (!undecided_ || !index_is_fresh()) return;
    ++news.late_indices;
    deliver(news);
}

void CoilAndIndexMap::take_coil(bool high, MonotonicTime at, MapNews& news) {
    const bool first_seen = !coil_;
    const bool was_high = coil_.value_or(false);
    coil_ = high;
    if (high == was_high) return;
    acknowledge_ = false;
    if (high) {
        undecided_ = Edge{at, first_seen && !armed_};
        if (index_is_fresh()) deliver(news);
    } else if (undecided_) {
        undecided_.reset();
        news.notes.emplace_back(Fault::out_of_order,
                                "The trigger coil fell before its index register was written: let "
                                "the program dwell between index and coil.");
    }
}

bool CoilAndIndexMap::index_is_fresh() const {
    return index_ != 0 && index_ != done_ && delivered_ != index_;
}

void CoilAndIndexMap::deliver(MapNews& news) {
    TriggerEvent event;
    event.sequence = index_;
    event.at = undecided_->at;
    event.standing = undecided_->standing;
    news.events.push_back(event);
    delivered_ = index_;
    undecided_.reset();
}

// Index 0 is no request: such an edge goes on waiting until an index comes or the coil falls.
std::optional<MonotonicTime> CoilAndIndexMap::due() const {
    if (!undecided_ || index_ == 0) return std::nullopt;
    return undecided_->at + index_grace_;
}

MapNews CoilAndIndexMap::tick(MonotonicTime now) {
    MapNews news;
    if (const auto end = due(); end && now >= *end) deliver(news);
    return news;
}

void CoilAndIndexMap::arm() {
    armed_ = true;
    done_ = 0;
    acknowledge_ = false;
}

void CoilAndIndexMap::end_run(RunEnd /*end*/) {
    done_ = no_run_sequence;
    acknowledge_ = false;
}

void CoilAndIndexMap::finish(std::uint16_t sequence) {
    done_ = sequence;
    if (coil_.value_or(false) && !undecided_ && delivered_ == sequence) acknowledge_ = true;
}

void CoilAndIndexMap::refuse(std::uint16_t /*sequence*/, Fault /*fault*/) {}
void CoilAndIndexMap::show(const PortStatus& /*status*/) {}

} // namespace axiscal
