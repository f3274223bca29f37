#include "drivers/laser/counter_record.hpp"

#include <cstring>
#include <linux/counter.h>

namespace axiscal {
namespace {

static_assert(sizeof(counter_event) == counter_record_bytes);

CounterRecord record_of(std::span<const std::byte> bytes) {
    counter_event event{};
    std::memcpy(&event, bytes.data(), sizeof event);
    CounterRecord record;
    record.at_ns = static_cast<std::int64_t>(event.timestamp);
    record.value = event.value;
    record.component_type = event.watch.component.type;
    record.scope = event.watch.component.scope;
    record.parent = event.watch.component.parent;
    record.component = event.watch.component.id;
    record.event = event.watch.event;
    record.channel = event.watch.channel;
    record.status = event.status;
    return record;
}

} // namespace

std::vector<CounterRecord> CounterFramer::feed(std::span<const std::byte> bytes) {
    partial_.insert(partial_.end(), bytes.begin(), bytes.end());
    std::vector<CounterRecord> records;
    records.reserve(partial_.size() / counter_record_bytes);
    std::size_t at = 0;
    for (; at + counter_record_bytes <= partial_.size(); at += counter_record_bytes)
        records.push_back(record_of(std::span{partial_}.subspan(at, counter_record_bytes)));
    partial_.erase(partial_.begin(), partial_.begin() + static_cast<std::ptrdiff_t>(at));
    return records;
}

std::int64_t CountUnwrapper::sign_extended(std::uint64_t value) const {
    const int unused = 64 - bits_;
    // Arithmetic shift of the signed value brings the sign bit down.
    return static_cast<std::int64_t>(value << unused) >> unused;
}

std::int64_t CountUnwrapper::unwrap(std::uint64_t value) {
    const std::int64_t step = total_ ? sign_extended(value - last_) : sign_extended(value);
    last_ = value;
    // A register of 64 bits is the long number itself and comes round with it.
    const auto total = static_cast<std::uint64_t>(total_.value_or(0));
    total_ = static_cast<std::int64_t>(total + static_cast<std::uint64_t>(step));
    return *total_;
}

} // namespace axiscal
