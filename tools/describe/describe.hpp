#pragma once
// What a program takes from its command line, told as JSON: the man pages and the shell completion of the packages are made
// from the very words of --help (tools/package.d/pages.py).

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <string>

namespace axiscal {

/// `{"names":["-h","--help"] or ["RUN"],"positional","value":"TEXT:{up,down}" or "","default","required","text"}`.
inline nlohmann::ordered_json describe_option(const CLI::Option& option) {
    nlohmann::ordered_json described;
    described["names"] = nlohmann::json::array();
    for (const std::string& name : option.get_snames())
        described["names"].push_back("-" + name);
    for (const std::string& name : option.get_lnames())
        described["names"].push_back("--" + name);
    if (option.get_positional()) described["names"].push_back(option.get_name(true));
    described["positional"] = option.get_positional();
    described["value"] = option.get_items_expected_max() == 0 ? "" : option.get_type_name();
    described["default"] = option.get_default_str();
    described["required"] = option.get_required();
    described["text"] = option.get_description();
    return described;
}

/// `{"name","text","footer","options":[...],"commands":[...]}`; hidden options are left out. Options of a group without a name
/// of its own belong to the command that holds the group.
inline nlohmann::ordered_json describe_command(const CLI::App& command) {
    nlohmann::ordered_json described{{"name", command.get_name()},
                                {"text", command.get_description()},
                                {"footer", command.get_footer()},
                                {"options", nlohmann::json::array()},
                                {"commands", nlohmann::json::array()}};
    for (const CLI::Option* option : command.get_options())
        if (!option->get_group().empty()) described["options"].push_back(describe_option(*option));
    for (const CLI::App* inner : command.get_subcommands(nullptr)) {
        nlohmann::ordered_json held = describe_command(*inner);
        if (!inner->get_name().empty())
            described["commands"].push_back(std::move(held));
        else
            for (auto& option : held["options"])
                described["options"].push_back(std::move(option));
    }
    return described;
}

/// Adds the hidden option --describe, which prints all that `app` takes and ends the program with 0. `app` lives as long as
/// its options.
inline void describe_on_request(CLI::App& app) {
    app.add_flag_callback("--describe", [&app] {
        throw CLI::CallForVersion(describe_command(app).dump(2), 0);
    })->group("");
}

} // namespace axiscal
