// `axiscal tape`: what a recording holds, and how it becomes a test.
#include "acquisition/runfile/durable_file.hpp"
#include "config/json_text.hpp"
#include "tools/axiscal/complaint.hpp"
#include "tools/axiscal/exit_code.hpp"
#include "tools/axiscal/tape/tape_look.hpp"
#include "tools/axiscal/tape_commands.hpp"
#include "tools/axiscal/whole_file.hpp"

#include <filesystem>
#include <iostream>

namespace axiscal {
namespace {

/// The expectation first: a tape that its driver refuses is not kept.
int keep_tape(const TapeRequest& request, const std::string& text, bool json) {
    const std::string base = request.folder + "/" + request.name;
    for (const char* ending : {".tape", ".expected"})
        if (std::filesystem::exists(base + ending))
            return std::cerr << base << ending << " is there already: choose another --name\n",
                   exit_refused;
    ReplayRequest replay;
    replay.tape = request.tape;
    replay.rebuild = base + ".expected";
    if (const int code = command_replay(replay, json); code != exit_ok) return code;
    if (const auto written = replace_synced(base + ".tape", text); !written)
        return complain(written.error());
    std::cout << base
              << ".tape lies beside it: read the expectation line by line against the document\n";
    return exit_ok;
}

} // namespace

int command_tape(const TapeRequest& request, bool json) {
    const auto text = whole_file(request.tape);
    if (!text) return complain(text.error());
    const auto tape = parse_tape(*text);
    if (!tape)
        return std::cerr << request.tape << ": " << describe(tape.error()) << "\n", exit_refused;
    if (request.action == "keep") return keep_tape(request, *text, json);
    const auto look = look_into(*tape);
    std::cout << (json ? json_text(look) + "\n" : text_of_look(look)) << std::flush;
    return exit_ok;
}

} // namespace axiscal
