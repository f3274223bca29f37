#include "acquisition/runfile/stored_drift.hpp"

#include "acquisition/runfile/run_file.hpp"
#include "acquisition/runfile/run_file_open.hpp"
#include "acquisition/runfile/run_order.hpp"

#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

namespace axiscal {

std::string WantedDrift::key() const {
    return of_bar ? "circular.uncertainty.eve_run" : "uncertainty.eve_run";
}

std::string WantedDrift::order() const {
    return of_bar ? "'axiscal drift --of ballbar'" : "'axiscal drift'";
}

Result<StoredDrift> find_drift(const std::string& folder, const WantedDrift& wanted) {
    std::vector<RunSummary> tests = list_run_files(folder);
    std::erase_if(tests, [&](const RunSummary& run) {
        const bool of_it = wanted.of_bar ? run.bar == wanted.of : !run.bar && run.axis == wanted.of;
        const bool counts = run.kind == TestKind::drift && run.complete && run.evaluated && of_it;
        return !counts || (wanted.which != "latest" && run.run_id != wanted.which);
    });
    const RunSummary* found = newest_run(tests, {});
    if (!found)
        return fail(Fault::not_found, wanted.key() + " = \"" + wanted.which +
                                          "\" names no complete drift test of " +
                                          (wanted.of_bar ? "ballbar " : "axis ") + wanted.of +
                                          " in " + folder + "; " + wanted.order() + " makes one");
    AXISCAL_TRY(StoredResult stored, read_stored_result(found->path));
    AXISCAL_TRY(const auto database, open_run_file(found->path));
    AXISCAL_TRY(const auto duration_ns, database->integer_of("SELECT duration_ns FROM drift"));
    AXISCAL_TRY(const auto place, database->value_of("SELECT place_m FROM drift"));
    const auto* place_m = std::get_if<double>(&place);
    if (place_m == nullptr)
        return fail(Fault::bad_run_file,
                    found->path + ": the drift test does not say how long it lasted, and where");
    return StoredDrift{found->run_id, std::move(stored.document), Duration{duration_ns},
                       metre(*place_m)};
}

} // namespace axiscal
