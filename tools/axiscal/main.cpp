// The command line. Each command is documented where its arguments are read: `axiscal COMMAND
// --help`.
#include "config/measure.hpp"
#include "config/standard_streams.hpp"
#include "config/version.hpp"
#include "tools/axiscal/arguments/encoding.hpp"
#include "tools/axiscal/arguments/options.hpp"
#include "tools/describe/describe.hpp"

#include <algorithm>
#include <clocale>
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
  axiscal result                                     E, A, R, B, M, each with its uncertainty
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

/// A word behind the command is none of its options: says so for the first, with the nearest.
void hint_at_option(const CLI::App& app, const std::vector<std::string>& words) {
    const auto commands = app.get_subcommands(
        [&](const CLI::App* command) { return command->get_name() == words.front(); });
    if (commands.empty()) return;
    std::vector<std::string> known;
    for (const CLI::Option* option : commands.front()->get_options())
        for (const std::string& name : option->get_lnames())
            known.push_back("--" + name);
    for (const std::string& word : words) {
        const std::string name = word.substr(0, word.find('='));
        if (!name.starts_with("--") || std::ranges::find(known, name) != known.end()) continue;
        if (const std::string near = nearest_word(name, known); !near.empty())
            std::cerr << "'" << name << "' is no option of axiscal " << words.front()
                      << "; did you mean '" << near << "'?\n";
        return;
    }
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
    app.set_version_flag("--version", software_version());
    describe_on_request(app);
    add_run_commands(app, options, chosen);
    add_rest_commands(app, options, chosen);
    add_pair_command(app, options, chosen);
    add_probing_commands(app, options, chosen);
    add_instrument_commands(app, options, chosen);
    add_tape_commands(app, options, chosen);
    add_paper_commands(app, options, chosen);
    add_station_commands(app, options, chosen);
    for (CLI::App* command : app.get_subcommands({}))
        command->add_flag("--json", options.json, "print JSON for programs");
    const std::vector<std::string> words{argv + std::min(argc, 1), argv + argc};
    if (const auto complaint = complaint_of_encoding(words))
        return std::cerr << *complaint << "\n", exit_usage;
    try {
        app.parse(argc, argv);
    } catch (const CLI::FileError& error) {
        return std::cerr << error.what() << "\n", exit_failed;
    } catch (const CLI::ParseError& error) {
        if (!words.empty() && !words.front().starts_with('-')) {
            hint_at_command(app, words.front());
            hint_at_option(app, words);
        }
        return app.exit(error) == 0 ? exit_ok : exit_usage;
    }
    return chosen();
}

} // namespace
} // namespace axiscal

int main(int argc, char** argv) {
    axiscal::open_standard_streams();
    // Columns of a letter (wcwidth) alone: numbers keep their decimal point. Part of the C library.
    std::setlocale(LC_CTYPE, "C.UTF-8");
    axiscal::StandardOutput output;
    int code = axiscal::exit_failed;
    try {
        code = axiscal::run(argc, argv);
    } catch (const std::exception& bug) {
        std::cerr << "axiscal: " << bug.what() << "\n";
    }
    return output.end("axiscal", code);
}
