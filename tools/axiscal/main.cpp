// The command line. Each command is documented where its arguments are read: `axiscal COMMAND
// --help`.
#include "config/measure.hpp"
#include "tools/axiscal/arguments/options.hpp"

#include <algorithm>
#include <iostream>

namespace axiscal {
namespace {

constexpr const char* footer = R"(A run, from start to certificate:
  axiscal check-config /etc/axiscal/station.toml     is the station file right?
  axiscal doctor                                     is this PC right? how is it mended?
  axiscal devices                                    what is plugged in? are laser and sensors there?
  axiscal align                                      align the beam; kept for the certificate
  axiscal program --config station.toml --out .      part program for the CNC; load and start it:
                                                     the axis goes to its datum and waits
  axiscal preflight                                  is all as it must be? axiscal arm asks the same
  axiscal arm --program X-whole.ngc                  tie the reading there; the CNC goes on by itself
  axiscal watch                                      next target, reading, temperatures, time left
)";

/// The first word is no command: says so, with the nearest one there is.
void hint_at_command(const CLI::App& app, const std::string& word) {
    std::vector<std::string> known;
    for (const CLI::App* command : app.get_subcommands({}))
        known.push_back(command->get_name());
    if (std::ranges::find(known, word) != known.end()) return;
    const std::string near = nearest_word(word, known);
    std::cerr << "'" << word << "' is no command"
              << (near.empty() ? "" : "; did you mean '" + near + "'?") << "\n";
}

int run(int argc, char** argv) {
    CLI::App app{"axiscal: calibrate a machine-tool axis, from the laser to the certificate",
                 "axiscal"};
    Options options;
    Command chosen;
    teach(app, footer,
          {exit_ok, exit_failed, exit_usage, exit_refused, exit_forbidden, exit_no_contact,
           exit_incomplete, exit_disagrees, exit_changed, exit_unwell});
    app.require_subcommand(1);
    app.set_version_flag("--version", AXISCAL_VERSION);
    add_run_commands(app, options, chosen);
    add_rest_commands(app, options, chosen);
    add_probing_commands(app, options, chosen);
    add_instrument_commands(app, options, chosen);
    add_tape_commands(app, options, chosen);
    add_paper_commands(app, options, chosen);
    for (CLI::App* command : app.get_subcommands({}))
        command->add_flag("--json", options.json, "print JSON for programs");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (argc > 1 && argv[1][0] != '-') hint_at_command(app, argv[1]);
        return app.exit(error) == 0 ? exit_ok : exit_usage;
    }
    return chosen();
}

} // namespace
} // namespace axiscal

int main(int argc, char** argv) {
    try {
        return axiscal::run(argc, argv);
    } catch (const std::exception& bug) {
        std::cerr << "axiscal: " << bug.what() << "\n";
        return axiscal::exit_failed;
    }
}
