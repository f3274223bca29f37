#include "acquisition/runfile/complete_runs.hpp"

#include "acquisition/runfile/run_order.hpp"

#include <vector>

namespace axiscal {

Result<RunFileContents> find_complete_run(const std::string& folder, const WantedRun& wanted) {
    std::vector<RunSummary> runs = list_run_files(folder);
    std::erase_if(runs, [&](const RunSummary& run) {
        const bool counts = run.kind == wanted.kind && run.complete && run.axis == wanted.axis;
        return !counts || (wanted.which != "latest" && run.run_id != wanted.which);
    });
    const RunSummary* found = newest_run(runs, {});
    if (found != nullptr) return read_run_file_contents(found->path);
    const std::string kind{name_of(wanted.kind)};
    return fail(Fault::not_found, wanted.key + " = \"" + wanted.which + "\" names no complete " +
                                      kind + " run of axis " + wanted.axis + " in " + folder +
                                      ": measure it first by 'axiscal arm --pass " + kind +
                                      "', or name another one");
}

} // namespace axiscal
