// What the run, the drift test, the disk under them and the CNC's port need.
#include "acquisition/live/to_do_parts.hpp"

#include "analysis/quantity/counted.hpp"

#include <utility>

namespace axiscal::to_do_parts {
namespace {

/// An open run that was refused a point: the CNC waits.
ToDo refused_point(const StationStatus& status, const RunStatus& run) {
    const Fault fault = fault_from_name(run.last_fault);
    Divided words = divided(fault, run.last_sentence);
    ToDo entry{"run/" + run.last_fault,
               ToDoRank::stop,
               ToDoSource::run,
               std::move(words.seen),
               told_at(status.notes, run.last_sentence),
               std::move(words.next),
               {},
               {}};
    // A disk that fails now is told by add_disk(); what is left of an earlier failure holds nobody.
    if (fault == Fault::not_durable) entry.rank = ToDoRank::look, entry.source = ToDoSource::disk;
    if (entry.next.empty())
        entry.next = "Mend it and let the CNC ask again; 'axiscal abort' ends the run.";
    return entry;
}

/// It was skipped by the CNC; the machine says how it is taken all the same.
ToDo warning_of(const StationStatus& status, const RunStatus& run) {
    constexpr std::string_view sign = "Warning: "; // the rank says it
    std::string sentence = run.last_sentence;
    if (sentence.starts_with(sign)) sentence.erase(0, sign.size());
    Divided words = divided_at_order(sentence);
    return {"run/warning",
            ToDoRank::look,
            ToDoSource::run,
            std::move(words.seen),
            told_at(status.notes, run.last_sentence),
            std::move(words.next),
            run.skipped > 0 ? "axiscal retake --reason TEXT" : "",
            {}};
}

ToDo ended_early(const StationStatus& status, const RunStatus& run) {
    const bool by_fault = !run.last_fault.empty();
    return {"run/incomplete",
            by_fault ? ToDoRank::look : ToDoRank::note,
            ToDoSource::run,
            "Run " + run.run_id + " is closed as incomplete: " + run.last_sentence,
            told_at(status.notes, "Run " + run.run_id + " is closed as incomplete"),
            "'axiscal arm' opens a run",
            "axiscal arm",
            {}};
}

/// Complete, with what a person should know all the same.
ToDo remark_on(const StationStatus& status, const RunStatus& run) {
    return {"run/remark",
            ToDoRank::look,
            ToDoSource::run,
            run.last_sentence,
            told_at(status.notes, run.last_sentence),
            "'axiscal result' shows what it did.",
            "axiscal result " + run.file,
            {}};
}

ToDo no_certificate(const StationStatus& status,
                    const std::string& run_id,
                    const std::string& file,
                    const std::string& why) {
    const std::string seen = "No certificate for run " + run_id + ": " + why;
    return {"certificate/" + run_id,
            ToDoRank::look,
            ToDoSource::run,
            seen,
            told_at(status.notes, "No certificate for run " + run_id + ": "),
            "'axiscal export " + file + "' tries again.",
            "axiscal export " + file,
            {}};
}

/// The plan itself is done: without the retakes the run is complete as it was.
bool only_retakes_are_left(const RunStatus& run) {
    return run.retakes_left > 0 && run.skipped == 0 && run.steps - run.step == run.retakes_left;
}

ToDo retakes_of(const RunStatus& run) {
    return {"run/retakes",
            ToDoRank::look,
            ToDoSource::run,
            std::to_string(run.retakes_left) + " of " + counted(run.retakes_asked, "retake") +
                " left",
            {},
            "'axiscal program --retake RUN.axiscal' writes the part program.",
            "axiscal program --retake " + run.file,
            only_retakes_are_left(run) ? "axiscal abort" : ""};
}

} // namespace

void add_disk(const StationStatus& status, const DiskTrouble& disk, std::vector<ToDo>& list) {
    if (disk.seen.empty()) return;
    list.push_back({"run/not_durable",
                    ToDoRank::stop,
                    ToDoSource::disk,
                    disk.seen,
                    told_at(status.notes, disk.seen),
                    disk.next,
                    {},
                    {}});
    if (disk.next.empty())
        list.back().next = "'axiscal doctor' tries the disk and says how to mend it.";
}

void add_run(const StationStatus& status, std::vector<ToDo>& list) {
    if (!status.run) return;
    const RunStatus& run = *status.run;
    if (status.run_open && run.retakes_left > 0) list.push_back(retakes_of(run));
    if (run.last_sentence.empty()) return;
    if (status.run_open)
        list.push_back(run.last_fault.empty() ? warning_of(status, run)
                                              : refused_point(status, run));
    else if (run.state == "incomplete")
        list.push_back(ended_early(status, run));
    else if (run.certificate.empty() && fault_from_name(run.last_fault) != Fault::not_durable)
        list.push_back(no_certificate(status, run.run_id, run.file, run.last_sentence));
    else
        list.push_back(remark_on(status, run));
}

/// Its sentence may be the reason why it ended: only the note says that no certificate was made.
void add_drift(const StationStatus& status, std::vector<ToDo>& list) {
    if (!status.drift || !status.drift->certificate.empty()) return;
    const DriftView& drift = *status.drift;
    ToDo entry = no_certificate(status, drift.run_id, drift.file, drift.sentence);
    if (!entry.since_utc.empty()) list.push_back(std::move(entry));
}

void add_trigger(const StationStatus& status, std::vector<ToDo>& list) {
    const ToDoRank rank = status.run_open ? ToDoRank::stop : ToDoRank::look;
    if (!status.trigger_note.empty())
        list.push_back({"trigger/port",
                        rank,
                        ToDoSource::trigger,
                        status.trigger_note,
                        told_at(status.notes, status.trigger_note),
                        "'axiscal doctor' tries the port and says how to mend it.",
                        "axiscal doctor",
                        {}});
    constexpr const char* silent = "The CNC's heartbeat has stopped.";
    if (status.cnc_silent)
        list.push_back({"trigger/silent",
                        rank,
                        ToDoSource::trigger,
                        silent,
                        told_at(status.notes, silent),
                        "Look whether the CNC is on, its program runs and its cable is in.",
                        {},
                        {}});
}

} // namespace axiscal::to_do_parts
