#include "tools/axiscal/arguments/options.hpp"
#include "tools/axiscal/exit_code.hpp"

#include <cstdlib>
#include <fstream>
#include <iostream>

namespace axiscal {

StationClient client_of(Options& options) {
    // NOLINTNEXTLINE(concurrency-mt-unsafe): there is one thread
    if (const char* socket = std::getenv("AXISCAL_SOCKET");
        socket != nullptr &&
        options.door.socket_path == DoorAddress{"/run/axiscal/axiscald.sock", "", ""}.socket_path)
        options.door.socket_path = socket;
    if (std::ifstream file{options.token_file}; !options.token_file.empty())
        std::getline(file, options.door.token);
    return StationClient{options.door};
}

void daemon_options(CLI::App& command, Options& options) {
    command
        .add_option("--socket", options.door.socket_path,
                    "Unix socket of axiscald (default also from AXISCAL_SOCKET)")
        ->capture_default_str();
    command.add_option("--host", options.door.host,
                       "talk TCP to ADDRESS:PORT instead; reads only, unless a token is given");
    command.add_option("--token-file", options.token_file,
                       "file with the bearer token (in the state directory)");
}

bool split_at_equals(const std::vector<std::string>& given,
                     std::map<std::string, std::string>& into) {
    for (const std::string& word : given) {
        const auto equals = word.find('=');
        if (equals == std::string::npos) return false;
        into[word.substr(0, equals)] = word.substr(equals + 1);
    }
    return true;
}

int split_statements(Options& options) {
    if (!split_at_equals(options.statements, options.arm.statements)) {
        std::cerr << "--state-that needs KEY=TEXT, as in operator=\"Shift 2\"\n";
        return exit_usage;
    }
    if (split_at_equals(options.overrides, options.arm.overrides)) return exit_ok;
    std::cerr << "--override needs NAME=REASON, as in soak=\"the customer waits\"\n";
    return exit_usage;
}

} // namespace axiscal
