#include "acquisition/runfile/run_order.hpp"

#include <algorithm>
#include <tuple>

namespace axiscal {
namespace {

bool is_earlier_by_clock(const RunSummary& one, const RunSummary& other) {
    return std::tie(one.opened_utc_ns, one.path) < std::tie(other.opened_utc_ns, other.path);
}

bool is_earlier_in_its_boot(const RunSummary& one, const RunSummary& other) {
    return std::tie(one.opened_at, one.opened_utc_ns, one.path) <
           std::tie(other.opened_at, other.opened_utc_ns, other.path);
}

} // namespace

const RunSummary* newest_run(const std::vector<RunSummary>& runs, const BootId& present_boot) {
    const auto latest = std::ranges::max_element(runs, is_earlier_by_clock);
    if (latest == runs.end()) return nullptr;
    const bool present = std::ranges::any_of(
        runs, [&](const RunSummary& run) { return is_same_boot(run.boot_id, present_boot); });
    const BootId& boot = present ? present_boot : latest->boot_id;
    if (!boot.known()) return &*latest;
    const RunSummary* newest = nullptr;
    for (const RunSummary& run : runs)
        if (is_same_boot(run.boot_id, boot) &&
            (newest == nullptr || is_earlier_in_its_boot(*newest, run)))
            newest = &run;
    return newest;
}

std::int64_t earliest_utc_ns_after(const RunSummary& newest, const PresentBoot& present) {
    const bool same_boot = is_same_boot(newest.boot_id, present.id);
    if (!same_boot || newest.opened_at > present.now.before) return newest.opened_utc_ns;
    return std::min(newest.opened_utc_ns, present.now.utc_ns_at(newest.opened_at));
}

} // namespace axiscal
