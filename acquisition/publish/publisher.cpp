#include "acquisition/publish/publisher.hpp"

#include <algorithm>

namespace axiscal {

std::size_t Publisher::pass(MonotonicTime now, std::int64_t utc_ns) {
    const auto entries = list_entries(settings_.outbox);
    if (entries.empty() || !destination_ready(now)) return entries.size();
    std::size_t waiting = 0;
    for (const auto& entry : entries) {
        if (!is_due(entry.run_id, now)) {
            ++waiting;
        } else if (auto done = publish(entry, utc_ns); done) {
            troubles_.erase(entry.run_id);
        } else {
            remember(entry.run_id, done.error(), now);
            ++waiting;
        }
    }
    return waiting;
}

std::optional<MonotonicTime> Publisher::next_due() const {
    const auto first = std::ranges::min_element(
        troubles_, {}, [](const auto& trouble) { return trouble.second.due; });
    return first == troubles_.end() ? std::nullopt : std::optional{first->second.due};
}

bool Publisher::destination_ready(MonotonicTime now) {
    if (!is_due("", now)) return false;
    if (auto ready = check_destination(settings_.destination); !ready) {
        remember("", ready.error(), now);
        return false;
    }
    if (troubles_.erase("") > 0) listener_.destination_back();
    return true;
}

bool Publisher::is_due(const std::string& run_id, MonotonicTime now) const {
    const auto trouble = troubles_.find(run_id);
    return trouble == troubles_.end() || now >= trouble->second.due;
}

// Nothing leaves the outbox before its receipt is on disk; an entry that has one (the process
// ended in between) only needs to be moved.
Result<void> Publisher::publish(OutboxEntry entry, std::int64_t utc_ns) {
    AXISCAL_TRY(entry, read_entry(settings_.outbox, entry.run_id));
    if (entry.has_receipt) {
        AXISCAL_TRY([[maybe_unused]] const auto place, archive_entry(entry));
        return {};
    }
    const Progress progress = [this] { listener_.progress(); };
    AXISCAL_TRY(const auto receipt, copy_entry(entry, settings_.destination, utc_ns, progress));
    AXISCAL_CHECK(write_receipt(entry, receipt));
    entry.has_receipt = true;
    AXISCAL_TRY([[maybe_unused]] const auto place, archive_entry(entry));
    listener_.published(receipt);
    return {};
}

void Publisher::remember(const std::string& run_id, const Error& why, MonotonicTime now) {
    auto& trouble = troubles_[run_id];
    const bool first = trouble.last_words.empty();
    trouble.pause = first ? settings_.retry : std::min(2 * trouble.pause, 16 * settings_.retry);
    trouble.due = now + trouble.pause;
    const auto words = axiscal::describe(why);
    if (words != trouble.last_words) listener_.waiting(run_id, why);
    trouble.last_words = words;
}

} // namespace axiscal
