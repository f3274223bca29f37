#include "tools/axiscal/find_run.hpp"

#include "acquisition/runfile/run_file.hpp"
#include "acquisition/runfile/run_order.hpp"
#include "acquisition/station/station_loader.hpp"

#include <filesystem>
#include <vector>

namespace axiscal {
namespace {

Result<std::string> runs_folder_of(const std::string& station_file) {
    const auto station = load_station(station_file);
    if (!station)
        return fail(Fault::refused, station.error().front().describe() +
                                        "; name the run's file, or another --config");
    return station->config.state_directory + "/runs";
}

} // namespace

Result<std::string> find_run(const std::string& run, const std::string& station_file) {
    std::error_code error;
    if (!run.empty() && std::filesystem::exists(run, error)) return run;
    AXISCAL_TRY(const std::string folder, runs_folder_of(station_file));
    if (!run.empty()) {
        std::string path = folder + "/" + run + std::string{run_file_ending};
        if (std::filesystem::exists(path, error)) return path;
        return fail(Fault::not_found,
                    "there is no file " + run + " and no run of this name in " + folder);
    }
    const std::vector<RunSummary> runs = list_run_files(folder);
    const RunSummary* newest = newest_run(runs, {});
    if (newest == nullptr)
        return fail(Fault::not_found, "no run was measured yet: there is none in " + folder);
    return newest->path;
}

} // namespace axiscal
