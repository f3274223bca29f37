#pragma once
// The station's status as words for a terminal. Pure.

#include "acquisition/live/to_do.hpp"
#include "tools/axiscal/terminal/screen.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace axiscal {

/// "to_do" of a status; empty of a daemon of before, which sends none.
std::vector<ToDo> to_do_of(const nlohmann::ordered_json& status);
/// All of it: what to do, then run, next target, reading, environment, instruments, notes.
std::string status_text(const nlohmann::ordered_json& status);
/// The same for a screen that must not scroll: fault, next and reading in its head, notes last.
ScreenParts status_parts(const nlohmann::ordered_json& status);
/// One line of progress: "P07 ↑ 3/5   37/110   e -3.2 µm   air 23.10 °C ...  left 0:42".
std::string progress_line(const nlohmann::ordered_json& status);
/// A table of the instruments with state, counters and last note.
std::string instruments_text(const nlohmann::ordered_json& instruments);
/// What comes before the sentence of a run: "FAULT" only where a fault is the reason.
std::string_view sentence_label(const nlohmann::ordered_json& run);

} // namespace axiscal
