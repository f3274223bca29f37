#include "acquisition/publish/publisher.hpp"

#include "acquisition/journal/durable_file.hpp"

#include <algorithm>

namespace axiscal {

std::size_t Publisher::pass() {
    const auto run_ids = entry_names(settings_.outbox);
    if (run_ids.empty() || !destination_ready()) return run_ids.size();
    auto [own, others] = shared_out(run_ids);
    const auto wait_for_second_hand = others.empty() ? nullptr : settings_.second_hand(others);
    const bool may_go_on = publish_all(own);
    if (wait_for_second_hand) wait_for_second_hand();
    // What the second hand left is done here, where its trouble is remembered and told.
    const auto still_there = entry_names(settings_.outbox);
    std::erase_if(others, [&](const std::string& run_id) {
        return !std::ranges::binary_search(still_there, run_id);
    });
    if (may_go_on) publish_all(others);
    const auto left = entry_names(settings_.outbox);
    // Moves that a power cut undoes are made again: the receipts are on disk.
    if (left != run_ids) static_cast<void>(sync_outbox(settings_.outbox));
    return left.size();
}

/// Every other entry is for the second hand, where one is worth its session and nothing is wrong.
Publisher::Shares Publisher::shared_out(const std::vector<std::string>& run_ids) const {
    constexpr std::size_t worth_a_session = 16;
    if (!settings_.second_hand || !troubles_.empty() || run_ids.size() < worth_a_session)
        return {run_ids, {}};
    Shares shares;
    for (const std::string& run_id : run_ids)
        (shares.own.size() > shares.others.size() ? shares.others : shares.own).push_back(run_id);
    return shares;
}

bool Publisher::publish_all(const std::vector<std::string>& run_ids) {
    for (const auto& run_id : run_ids) {
        if (!listener_.go_on()) return false;
        if (!is_due(run_id)) continue;
        const auto done = publish(run_id);
        if (done) {
            troubles_.erase(run_id);
            continue;
        }
        const bool lost = is_share_lost(done.error());
        remember(lost ? "" : run_id, done.error());
        if (lost) return false;
    }
    return true;
}

std::optional<MonotonicTime> Publisher::next_due() const {
    const auto first = std::ranges::min_element(
        troubles_, {}, [](const auto& trouble) { return trouble.second.due; });
    return first == troubles_.end() ? std::nullopt : std::optional{first->second.due};
}

bool Publisher::destination_ready() {
    if (!is_due("")) return false;
    if (auto ready = destination_.check(); !ready) {
        remember("", ready.error());
        return false;
    }
    return true;
}

bool Publisher::is_due(const std::string& run_id) const {
    const auto trouble = troubles_.find(run_id);
    return trouble == troubles_.end() || clock_.now() >= trouble->second.due;
}

// Nothing leaves the outbox before its receipt is on disk; an entry that has one (the process
// ended in between) only needs to be moved.
Result<void> Publisher::publish(const std::string& run_id) {
    AXISCAL_TRY(auto entry, read_entry(settings_.outbox, run_id));
    const Progress progress = [this] { listener_.progress(); };
    AXISCAL_TRY(const auto receipt, deliver_entry(entry, destination_, clock_.utc_ns(), progress));
    if (receipt) {
        // Only what arrived proves that the destination is back: a full disk passes its check.
        if (troubles_.erase("") > 0) listener_.destination_back();
        listener_.published(*receipt);
    }
    AXISCAL_TRY([[maybe_unused]] const auto place, archive_entry(entry));
    return {};
}

void Publisher::remember(const std::string& run_id, const Error& why) {
    auto& trouble = troubles_[run_id];
    const bool first = trouble.last_words.empty();
    trouble.pause = first ? settings_.retry : std::min(2 * trouble.pause, 16 * settings_.retry);
    trouble.due = clock_.now() + trouble.pause;
    const auto words = publishing_words(why);
    if (words != trouble.last_words) listener_.waiting(run_id, why);
    trouble.last_words = words;
}

} // namespace axiscal
