// `axiscal budget`: what U of a run is made of, and where each of its inputs comes from.
#include "acquisition/documents/evaluate.hpp"
#include "config/json_text.hpp"
#include "tools/axiscal/budget_text.hpp"
#include "tools/axiscal/exit_code.hpp"
#include "tools/axiscal/find_run.hpp"
#include "tools/axiscal/offline_commands.hpp"

#include <iostream>

namespace axiscal {
namespace {

Result<void> print_budget(const BudgetRequest& request, bool json) {
    AXISCAL_TRY(const std::string path, find_run(request.run, request.station_file));
    AXISCAL_TRY(const TestResult result, evaluate_run_file(path));
    AXISCAL_TRY(const nlohmann::ordered_json summary, budget_summary(result));
    std::cout << (json ? json_text(summary) + "\n" : budget_text(summary)) << std::flush;
    return {};
}

} // namespace

int command_budget(const BudgetRequest& request, bool json) {
    if (const auto printed = print_budget(request, json); !printed) {
        std::cerr << describe(printed.error()) << "\n";
        return exit_refused;
    }
    return exit_ok;
}

} // namespace axiscal
