#pragma once
// What is asked for below /v1/runs, and which rows a list is to have. Pure.

#include "analysis/quantity/result.hpp"

#include <cstddef>
#include <string>
#include <string_view>

namespace axiscal {

// The calls; ID stands for the run that is asked for, PAPER for the file.
inline constexpr std::string_view runs_path = "/v1/runs";
inline constexpr std::string_view one_run_path = "/v1/runs/ID";
inline constexpr std::string_view run_paper_path = "/v1/runs/ID/PAPER";

/// Which of the calls a path is: one of the three above; empty: none.
std::string_view runs_call_of(std::string_view path);

/// What stands in a path in the places of ID and PAPER; empty where nothing does. A name to be
/// looked for among those that are there, never a path of the disk.
struct RunNamed {
    std::string id, paper;
};
RunNamed run_named_in(std::string_view path);

/// Whether a name can be that of a stored run: letters, digits and . _ - of ASCII, not beginning
/// with a dot, at most 200. Others are in no list: they need no escape anywhere.
bool is_run_name(std::string_view name);

struct RunsAsked {
    std::size_t limit = 20; ///< rows, 1 to 100
    std::string before;     ///< id: the rows behind it in the list; empty: from the newest on
    std::string text; ///< what a row must hold, in any case of ASCII letters; empty: every row
};
/// Of "/v1/runs?limit=20&before=ID&text=M-10442", each left out or not; text is percent-encoded.
/// @errors Fault::bad_request naming the field.
Result<RunsAsked> runs_asked_of(std::string_view target);

} // namespace axiscal
