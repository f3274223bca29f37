#include "tools/axiscal/arguments/options.hpp"

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <system_error>

namespace axiscal {
namespace {

constexpr std::size_t columns = 100;

const char* meaning_of(ExitCode code) {
    switch (code) {
    case exit_ok: return "done";
    case exit_failed: return "a file or the disk failed";
    case exit_usage: return "wrong usage";
    case exit_refused: return "input refused (case, run file, station file)";
    case exit_forbidden: return "the station refuses (rights, busy, not armed)";
    case exit_no_contact: return "axiscald does not answer";
    case exit_incomplete: return "the run ended incomplete";
    case exit_disagrees: return "a figure of the conformance kit, or a tape, disagrees";
    case exit_changed: return "a run file or its certificate is not what was written";
    case exit_unwell: return "the doctor found something broken";
    }
    return "";
}

/// Without what an editor may have put around it: blanks, the line ends of Windows, its mark of
/// UTF-8.
std::string token_in(const std::string& path) {
    std::error_code ignored;
    const bool folder = std::filesystem::is_directory(path, ignored);
    errno = EISDIR;
    std::ifstream file;
    if (!folder) file.open(path, std::ios::binary);
    if (!file.is_open())
        throw CLI::FileError("cannot read the token file " + path + " (" +
                             std::generic_category().message(errno) + ")");
    std::string text{std::istreambuf_iterator<char>{file}, {}};
    if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
    constexpr const char* blanks = " \t\r\n\v\f";
    const auto begin = text.find_first_not_of(blanks);
    if (begin == std::string::npos) throw CLI::FileError("the token file " + path + " is empty");
    return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

} // namespace

std::string exit_codes_text(const std::vector<ExitCode>& codes) {
    std::string text, line = "Exit codes:";
    for (const ExitCode code : codes) {
        const std::string entry = " " + std::to_string(code) + " " + meaning_of(code) +
                                  (code == codes.back() ? "." : ";");
        if (line.size() + entry.size() > columns) {
            text += line + "\n";
            line.clear();
        }
        line += line.empty() ? entry.substr(1) : entry;
    }
    return text + line;
}

void teach(CLI::App& command, const std::string& text, const std::vector<ExitCode>& codes) {
    command.footer(text + "\n" + exit_codes_text(codes));
}

StationClient client_of(Options& options) {
    // NOLINTNEXTLINE(concurrency-mt-unsafe): there is one thread
    if (const char* socket = std::getenv("AXISCAL_SOCKET");
        socket != nullptr &&
        options.door.socket_path == DoorAddress{"/run/axiscal/axiscald.sock", "", ""}.socket_path)
        options.door.socket_path = socket;
    return StationClient{options.door};
}

void daemon_options(CLI::App& command, Options& options) {
    command
        .add_option("--socket", options.door.socket_path,
                    "Unix socket of axiscald (default also from AXISCAL_SOCKET)")
        ->capture_default_str();
    command.add_option("--host", options.door.host,
                       "talk TCP to ADDRESS:PORT instead; reads only, unless a token is given");
    command.add_option_function<std::string>(
        "--token-file",
        [&options](const std::string& path) { options.door.token = token_in(path); },
        "file with the bearer token (in the state directory)");
    command
        .add_option_function<int>(
            "--timeout",
            [&options](int limit_s) { options.door.patience = std::chrono::seconds{limit_s}; },
            "seconds to wait for an answer (default: 60, of an order as long as the station may "
            "take)")
        ->check(CLI::PositiveNumber);
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
    if (!split_at_equals(options.overrides, options.arm.overrides)) {
        std::cerr << "--override needs NAME=REASON, as in soak=\"the customer waits\"\n";
        return exit_usage;
    }
    if (split_at_equals(options.kind_options, options.arm.options)) return exit_ok;
    std::cerr << "--option needs NAME=VALUE, as in mirror=reversed\n";
    return exit_usage;
}

} // namespace axiscal
