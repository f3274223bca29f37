// `axiscal verify`: is this run file what the station wrote, and is this its certificate?
#include "acquisition/publish/run_verify.hpp"
#include "tools/axiscal/exit_code.hpp"
#include "tools/axiscal/offline_commands.hpp"

#include <iostream>

namespace axiscal {

int command_verify(const std::string& run_file, const std::string& certificate, bool json) {
    const auto report = verify_run(run_file, certificate);
    if (!report) {
        const Error& error = report.error();
        if (json)
            std::cout << nlohmann::ordered_json{{"run_file", run_file},
                                                {"intact", false},
                                                {"refused", describe(error)}}
                             .dump()
                      << "\n";
        std::cerr << describe(error) << "\n";
        return error.fault == Fault::io || error.fault == Fault::not_found ? exit_failed
                                                                           : exit_refused;
    }
    if (json)
        std::cout << to_json(*report).dump() << "\n";
    else
        std::cout << to_text(*report) << std::flush;
    return report->intact() ? exit_ok : exit_changed;
}

} // namespace axiscal
