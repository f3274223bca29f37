#include "tools/axiscal/align_command.hpp"

#include "config/json_text.hpp"
#include "tools/axiscal/daemon_reply.hpp"
#include "tools/axiscal/exit_code.hpp"
#include "tools/axiscal/terminal/terminal.hpp"

#include <nlohmann/json.hpp>

#include <iostream>
#include <optional>
#include <poll.h>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

constexpr int repaint_ms = 250;

/// A line of standard input, or its end, within the time of one repaint.
std::optional<std::string> line_within_a_moment() {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (::poll(&input, 1, repaint_ms) <= 0) return std::nullopt;
    std::string line;
    std::getline(std::cin, line);
    return line;
}

/// Shows one answer after the other: a screen, or a line for each change.
class AlignmentFrames {
public:
    explicit AlignmentFrames(bool json)
        : json_{json}
        , screen_{!json && output_is_screen()} {
        if (!json && !screen_) std::cout << hint << std::flush;
    }
    void show(const Reply& reply) {
        if (json_) {
            std::cout << reply.body << std::flush;
            return;
        }
        const std::string text = alignment_text(Json::parse(reply.body));
        if (screen_)
            std::cout << new_screen << text << hint;
        else if (const std::string first = text.substr(0, text.find('\n')); first != last_)
            std::cout << (last_ = first) << "\n";
        std::cout << std::flush;
    }

private:
    static constexpr const char* hint = "Enter keeps this, q and Enter drops it.\n";
    bool json_, screen_;
    std::string last_;
};

Result<Reply> order(const StationClient& client,
                    const std::string& action,
                    std::optional<double> spot_offset_mm = {}) {
    Json body{{"action", action}};
    if (spot_offset_mm) body["spot_offset_mm"] = *spot_offset_mm;
    return client.post("/v1/alignment", json_text(body));
}

int print(const Result<Reply>& reply, bool json) {
    return show_reply(reply, json, alignment_text);
}

int live(const StationClient& client, const AlignOrder& wanted, bool json) {
    const auto begun = order(client, "begin");
    if (!begun || begun->status >= 300) return print(begun, json);
    AlignmentFrames frames{json};
    for (;;) {
        const auto reply = client.get("/v1/alignment");
        if (!reply || reply->status >= 300) return print(reply, json);
        frames.show(*reply);
        const auto line = line_within_a_moment();
        if (!line) continue;
        if (*line == "q") return print(order(client, "drop"), json);
        return print(order(client, "keep", wanted.spot_offset_mm), json);
    }
}

} // namespace

int command_align(const StationClient& client, const AlignOrder& wanted, bool json) {
    if (wanted.spot_offset_mm && wanted.action != "live" && wanted.action != "keep") {
        std::cerr << "--spot-offset belongs to an alignment that is kept\n";
        return exit_usage;
    }
    if (wanted.action == "live") return live(client, wanted, json);
    if (wanted.action == "show") return print(client.get("/v1/alignment"), json);
    return print(order(client, wanted.action, wanted.spot_offset_mm), json);
}

} // namespace axiscal
