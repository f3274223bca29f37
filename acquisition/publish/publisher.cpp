#include "acquisition/publish/publisher.hpp"

#include "acquisition/runfile/durable_file.hpp"

#include <algorithm>

namespace axiscal {

std::size_t Publisher::pass() {
    const auto run_ids = entry_names(settings_.outbox);
    if (run_ids.empty() || !is_due("")) return run_ids.size();
    const auto helper = upload_worker_for(run_ids);
    if (!destination_ready()) return run_ids.size();
    mark_ = mark_of(settings_.outbox);
    const bool may_go_on = !helper || publish_beside(*helper, run_ids);
    // What the worker left is done here, where its trouble is remembered and reported.
    if (may_go_on) publish_all(helper ? entry_names(settings_.outbox) : run_ids);
    const auto left = entry_names(settings_.outbox);
    // Moves that a power cut undoes are made again: the receipts are on disk.
    if (left != run_ids) static_cast<void>(sync_outbox(settings_.outbox));
    return left.size();
}

/// Where there is enough for a session of its own and nothing is wrong.
std::unique_ptr<UploadHelper>
Publisher::upload_worker_for(const std::vector<std::string>& run_ids) const {
    constexpr std::size_t worth_a_session = 16;
    if (!settings_.upload_worker || !troubles_.empty() || run_ids.size() < worth_a_session)
        return {};
    return settings_.upload_worker(run_ids);
}

bool Publisher::publish_beside(UploadHelper& helper, const std::vector<std::string>& run_ids) {
    bool may_go_on = true;
    while (may_go_on) {
        const auto index = helper.claim();
        if (!index) break;
        may_go_on = attend_to(run_ids.at(*index));
    }
    helper.wait();
    return may_go_on;
}

bool Publisher::publish_all(const std::vector<std::string>& run_ids) {
    return std::ranges::all_of(run_ids,
                               [&](const std::string& run_id) { return attend_to(run_id); });
}

bool Publisher::attend_to(const std::string& run_id) {
    if (!listener_.go_on()) return false;
    if (!is_due(run_id)) return true;
    const auto done = publish(run_id);
    if (done) {
        troubles_.erase(run_id);
        return true;
    }
    const bool lost = is_share_lost(done.error());
    remember(lost ? "" : run_id, done.error());
    return !lost;
}

std::optional<MonotonicTime> Publisher::next_due() const {
    const auto first = std::ranges::min_element(
        troubles_, {}, [](const auto& trouble) { return trouble.second.due; });
    return first == troubles_.end() ? std::nullopt : std::optional{first->second.due};
}

bool Publisher::destination_ready() {
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
    const Delivery delivery{destination_, mark_, [this] { listener_.progress(); }};
    AXISCAL_TRY(const auto receipt, deliver_entry(entry, delivery, clock_.utc_ns()));
    if (receipt) {
        // Only what arrived proves that the destination is back: a full disk passes its check.
        if (troubles_.erase("") > 0) listener_.destination_back();
        listener_.published(*receipt);
    }
    AXISCAL_TRY([[maybe_unused]] const auto place, archive_entry(entry, delivery.progress));
    return {};
}

void Publisher::remember(const std::string& run_id, const Error& why) {
    auto& trouble = troubles_[run_id];
    const bool first = trouble.last_words.empty();
    trouble.pause = first ? settings_.retry : std::min(2 * trouble.pause, 16 * settings_.retry);
    trouble.due = clock_.now() + trouble.pause;
    const auto words = publishing_text(why);
    if (words != trouble.last_words) listener_.waiting(run_id, why);
    trouble.last_words = words;
}

} // namespace axiscal
