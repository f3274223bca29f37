#pragma once
// <state>/events: what waits for the receiver of the webhook, a file each, and the names of what it
// has. Functions on files, no state; a name without a dot in front has all its content, synced.
//
//   asked.json     what the station file asks for; without it nothing is laid down
//   waiting/<id>.json  the body of a POST
//   sent/<id>      empty: the receiver has taken it
//   dropped        how many were dropped since the folder was made; not there: none
//   trouble        one sentence of axiscal-notify, while something waits

#include "acquisition/events/station_event.hpp"
#include "analysis/quantity/result.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace axiscal {

/// Where more wait, the oldest are dropped: who is told at last wants to know how things stand now.
inline constexpr std::size_t most_waiting_events = 256;
/// Names kept of events that were taken; one that is made again after so many is sent again.
inline constexpr std::size_t most_sent_events = 4096;

struct AskedEvents {
    std::string station; ///< its name
    bool complete = false, fault = false;
};

/// Makes the folder. Called at the daemon's start. @errors Fault::io.
Result<void> open_events(const std::string& state_directory, const AskedEvents& asked);
/// Without [webhook]: nothing waits any more.
void close_events(const std::string& state_directory);

/// Durable on return. Nothing is done where nobody asked for such an event, or where it waits or
/// was taken already. @returns whether it was laid down. @errors Fault::io.
Result<bool> lay_event(const std::string& state_directory, const StationEvent& event);

/// Their ids, the oldest first.
std::vector<std::string> waiting_events(const std::string& state_directory);
/// @errors Fault::not_found when it was dropped meanwhile; Fault::io.
Result<std::string> waiting_body(const std::string& state_directory, const std::string& id);
/// The receiver has it. Its name is on the disk before it leaves: a crash in between repeats it.
Result<void> settle_event(const std::string& state_directory, const std::string& id);

std::int64_t dropped_events(const std::string& state_directory);
/// Empty: it goes well. Not synced: it is said again.
void tell_event_trouble(const std::string& state_directory, const std::string& sentence);
std::string event_trouble(const std::string& state_directory);

} // namespace axiscal
