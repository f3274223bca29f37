// The command that lets browsers in.
#include "tools/axiscal/arguments/options.hpp"

namespace axiscal {
namespace {

constexpr const char* pair_footer = R"(Examples:
  axiscal pair "tablet 2"
  axiscal pair --list
  axiscal pair --end "tablet 2"
The code counts for five minutes and once; a further call makes the earlier one void. Five wrong codes end it.
A browser stays paired until it is ended, or has ordered nothing for 30 days. See docs/pairing.md.)";

} // namespace

void add_pair_command(CLI::App& app, Options& options, Command& chosen) {
    auto* pair = app.add_subcommand(
        "pair",
        "Show a code that lets one browser operate the station; who is paired, and its end");
    auto* name =
        pair->add_option("NAME", options.pair.name,
                         "what its orders are logged by, as in \"tablet 2\"; left out: page");
    auto* list =
        pair->add_flag("--list", options.pair.list, "which browsers are paired")->excludes(name);
    auto* end = pair->add_option("--end", options.pair.end_name, "end every pairing of this name")
                    ->excludes(name)
                    ->excludes(list);
    pair->add_flag("--end-all", options.pair.end_all, "end every pairing")
        ->excludes(name)
        ->excludes(list)
        ->excludes(end);
    teach(*pair, pair_footer, {exit_ok, exit_usage, exit_forbidden, exit_no_contact});
    pair->callback([&] {
        chosen = [&] { return command_pair(client_of(options), options.pair, options.json); };
    });
    daemon_options(*pair, options);
}

} // namespace axiscal
