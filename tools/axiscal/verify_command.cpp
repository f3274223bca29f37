// `axiscal verify`: is this run file what the station wrote, and is this its certificate?
#include "acquisition/documents/run_verify.hpp"
#include "config/json_text.hpp"
#include "tools/axiscal/exit_code.hpp"
#include "tools/axiscal/offline_commands.hpp"

#include <iostream>

namespace axiscal {

int command_verify(const std::string& run_file, const VerifyAgainst& against, bool json) {
    const auto report = verify_run(run_file, against);
    if (!report) {
        const Error& error = report.error();
        if (json)
            std::cout << json_text(nlohmann::ordered_json{{"run_file", run_file},
                                                          {"intact", false},
                                                          {"refused", describe(error)}})
                      << "\n";
        std::cerr << describe(error) << "\n";
        return error.fault == Fault::io || error.fault == Fault::not_found ? exit_failed
                                                                           : exit_refused;
    }
    if (json)
        std::cout << json_text(to_json(*report)) << "\n";
    else
        std::cout << to_text(*report) << std::flush;
    return report->intact() ? exit_ok : exit_changed;
}

} // namespace axiscal
