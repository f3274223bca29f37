#pragma once
// The folder of runs as a station that starts sees it: a closed run is known by its first bytes, so
// that of a thousand stored ones only those are opened that may be open, and the newest. Blocking
// calls.

#include "acquisition/runfile/run_file.hpp"
#include "acquisition/runfile/run_order.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

/// "20261121T100007Z", the instant as names of runs bear it. Sorts as time does.
std::string instant_in_name(std::int64_t utc_ns);
/// The last instant of that shape in a name; empty where it bears none.
std::string instant_of_name(std::string_view name);

struct StoredRuns {
    std::vector<RunSummary> looked_into; ///< those that may be open; by name
    std::vector<std::string> folded;     ///< paths of the closed ones, not opened; by name
    /// The one that was opened last (run_order.hpp). A name that bears an instant is believed not to
    /// be earlier than its run; every name without one is looked into. A clock that was set back
    /// since the newest run is seen by that run's triple, in the present boot: then the names within
    /// what it was set back by are looked into as well. Of an earlier boot a run in the future tells
    /// it, and the latest name that is not in the future is looked into. Not seen is a clock that
    /// was set forth again since, or in an earlier boot long enough ago.
    std::optional<RunSummary> newest;
    std::size_t unreadable = 0; ///< that may be open and could not be looked into
};

/// Tidies the folder as tidy_run_files() and sorts what is in it. No runs when there is no folder.
///
/// Folded is what SQLite's file format (1.3) shows in its header: write and read version (bytes 18
/// and 19) are 1, and the file change counter (24 to 27) is 3 or more. The header transaction of a
/// new run makes it 1; it becomes 2 with the WAL (versions 2), before any row is added, and 3 when
/// the closed run is folded (versions 1). An opened WAL stays in the header until then, so a run
/// that was left at any other step is not taken for a folded one; neither is a file with a -wal,
/// -shm or -journal beside it.
///
/// With a descriptor that is closed, POSIX gives up every lock of the process on that file. So no
/// file is read that this process may have open as a run: that one has its -wal beside it. What
/// else reads stored runs in the same process does so on the same thread.
/// @errors as tidy_run_files().
Result<StoredRuns> look_through_runs(const std::string& folder, const PresentBoot& present = {});

} // namespace axiscal
