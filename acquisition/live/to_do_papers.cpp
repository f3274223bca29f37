// What the pre-flight checks, the certificate and the share need.
#include "acquisition/live/to_do_parts.hpp"

#include <algorithm>
#include <utility>

namespace axiscal::to_do_parts {
namespace {

ToDo entry_of(const PreflightRecord& check, const JudgedChecks& judged) {
    const ToDoRank failed = judged.refused_arming ? ToDoRank::stop : ToDoRank::look;
    ToDo entry{"preflight/" + check.name,
               check.passed ? ToDoRank::note : failed,
               check.name == "clock" ? ToDoSource::clock : ToDoSource::preflight,
               check.verdict,
               judged.utc,
               mend_or_override(check.name),
               "axiscal preflight",
               {}};
    if (check.passed) entry.next = "Mend it, or let the certificate say so.";
    return entry;
}

/// The verdict of "instruments" lists what stands here already, one by one: these entries take its
/// rank. @returns whether there is one
bool is_told(const PreflightRecord& check, ToDoRank rank, std::vector<ToDo>& list) {
    if (check.name != "instruments" || check.passed) return false;
    bool told = false;
    for (ToDo& entry : list) {
        if (!entry.id.starts_with("instrument/") || entry.rank == ToDoRank::note) continue;
        entry.rank = std::min(entry.rank, rank);
        told = true;
    }
    return told;
}

ToDo waiting_for_publisher(std::string seen, ToDoRank rank, const OutboxView& outbox) {
    return {"outbox",
            rank,
            ToDoSource::outbox,
            std::move(seen),
            outbox.since_utc,
            "Start axiscal-publish, now and after each restart of this computer.",
            "sudo systemctl enable --now axiscal-publish",
            "sudo systemctl disable --now axiscal-publish"};
}

} // namespace

void add_checks(const JudgedChecks& judged, std::vector<ToDo>& list) {
    for (const PreflightRecord& check : judged.checks) {
        const bool asks = !check.passed && check.override_reason.empty();
        if (!asks && !check.warning) continue;
        ToDo entry = entry_of(check, judged);
        if (!is_told(check, entry.rank, list)) list.push_back(std::move(entry));
    }
}

void add_findings(const StationStatus& status,
                  const std::vector<OpenFinding>& findings,
                  std::vector<ToDo>& list) {
    for (const OpenFinding& finding : findings)
        list.push_back({"finding/" + finding.error,
                        ToDoRank::look,
                        ToDoSource::finding,
                        finding.seen + " " + finding.probably,
                        told_at(status.notes, finding.seen),
                        finding.look_at,
                        "axiscal answer " + finding.error + " TEXT",
                        {}});
}

void add_outbox(const OutboxView& outbox, std::vector<ToDo>& list) {
    if (!outbox.publisher_runs && !outbox.alarm.empty())
        return list.push_back(waiting_for_publisher(outbox.alarm, ToDoRank::look, outbox));
    if (!outbox.publisher_runs && outbox.waiting > 0 && !outbox.destination.empty())
        return list.push_back(
            waiting_for_publisher("axiscal-publish does not run", ToDoRank::note, outbox));
    const bool waits = outbox.waiting > 0 && !outbox.reason.empty();
    if (outbox.alarm.empty() && !waits) return;
    list.push_back({"outbox",
                    outbox.alarm.empty() ? ToDoRank::note : ToDoRank::look,
                    ToDoSource::outbox,
                    outbox.alarm.empty() ? outbox.reason : outbox.alarm,
                    outbox.since_utc,
                    "Look at the share: what waits is safe on this computer and leaves by itself "
                    "once the share takes it; 'axiscal doctor' tries it.",
                    "axiscal doctor",
                    {}});
}

} // namespace axiscal::to_do_parts
