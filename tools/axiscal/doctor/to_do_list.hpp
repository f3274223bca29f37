#pragma once
// The station's list of what to do, with what only a look from outside shows (rights, rules of
// udev, kernel, ports), in words for a terminal. Pure.

#include "acquisition/live/to_do.hpp"
#include "tools/axiscal/doctor/judges.hpp"

#include <string>
#include <vector>

namespace axiscal {

/// A finding about something that the station's list has already only gives that entry the doctor's
/// way to mend it. What is good is left out.
/// @param list  of the station; empty where it does not answer
std::vector<ToDo> with_findings(std::vector<ToDo> list, const std::vector<Finding>& findings);

/// "STOP  The laser beam was lost. (since ...)", below it the next action, its command, what undoes
/// it; "To do        nothing" of an empty list.
std::string to_do_text(const std::vector<ToDo>& list);

} // namespace axiscal
