#pragma once
// The parts of things_to_do() by where the trouble is, and the words that they share. Internal to
// to_do*.cpp. Pure.

#include "acquisition/live/station_interface.hpp"
#include "acquisition/live/to_do.hpp"
#include "analysis/quantity/result.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace axiscal::to_do_parts {

/// A sentence that names the way out, cut in two.
struct Divided {
    std::string seen;
    std::string next; ///< empty: it names none
};
/// fault_sentence() at its colon: "The laser beam was lost", "Restore the beam, move to ...".
Divided divided(Fault fault);
/// `sentence` as describe() wrote it of `fault`, without the way out that the fault's own words
/// name; that is `next`.
Divided divided(Fault fault, const std::string& sentence);
/// At a colon before an order: "2 points skipped", "'axiscal retake' takes what is missing".
Divided divided_at_order(const std::string& sentence);
/// Time of the latest note that has `words`; empty: none of those kept has them.
std::string told_at(const std::vector<std::string>& notes, std::string_view words);

// to_do_run.cpp
void add_disk(const StationStatus& status, const DiskTrouble& disk, std::vector<ToDo>& list);
void add_run(const StationStatus& status, std::vector<ToDo>& list);
void add_drift(const StationStatus& status, std::vector<ToDo>& list);
void add_trigger(const StationStatus& status, std::vector<ToDo>& list);

// to_do_instruments.cpp
void add_instruments(const StationStatus& status, std::vector<ToDo>& list);
/// Of instruments and channels in use whose certificate's last day is past.
void add_due(const StationStatus& status, std::vector<ToDo>& list);

// to_do_papers.cpp
void add_checks(const JudgedChecks& judged, std::vector<ToDo>& list);
void add_findings(const StationStatus& status,
                  const std::vector<OpenFinding>& findings,
                  std::vector<ToDo>& list);
void add_outbox(const OutboxView& outbox, std::vector<ToDo>& list);

} // namespace axiscal::to_do_parts
