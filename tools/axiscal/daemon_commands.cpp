#include "tools/axiscal/daemon_commands.hpp"

#include "acquisition/live/to_do.hpp"
#include "analysis/quantity/counted.hpp"
#include "config/json_text.hpp"
#include "config/version.hpp"
#include "tools/axiscal/daemon_reply.hpp"
#include "tools/axiscal/exit_code.hpp"
#include "tools/axiscal/status_text.hpp"
#include "tools/axiscal/terminal/terminal.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <fstream>
#include <iostream>
#include <thread>
#include <utility>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

constexpr auto repaint =
    std::chrono::milliseconds{250}; // a reading twice a second, asking included

std::string checks_text(const Json& checks) {
    std::string text;
    for (const Json& check : checks) {
        const bool passed = check.at("passed") == true;
        const std::string reason = check.at("override").get<std::string>();
        const bool warning = check.value("warning", false);
        const std::string word = warning          ? "WARNING   "
                                 : passed         ? "ok        "
                                 : reason.empty() ? "FAILS     "
                                                  : "overridden";
        std::string name = check.at("name").get<std::string>();
        name.resize(std::max<std::size_t>(name.size(), 13), ' ');
        text.append("  ").append(word).append("  ").append(name).append(" ");
        text.append(check.at("verdict").get<std::string>()).append("\n");
        if (!passed && !reason.empty())
            text.append("              because: ").append(reason).append("\n");
    }
    return text;
}

/// Prints the station's own sentence for a refused call.
int refused(const Reply& reply) {
    const Json body = Json::parse(reply.body, nullptr, false);
    if (body.is_object() && body.contains("checks")) {
        std::cerr << "Not armed: not every pre-flight check holds.\n"
                  << checks_text(body["checks"]) << mend_or_override("NAME") << "\n";
        return exit_forbidden;
    }
    return tell_refusal(reply);
}

bool all_hold(const Json& checks) {
    for (const Json& check : checks)
        if (check.at("passed") == false && check.at("override") == "") return false;
    return true;
}

/// Asks, prints, and turns the answer into an exit code.
template <class Show> int ask(const Result<Reply>& reply, bool json, Show show) {
    if (!reply) return tell_no_contact(reply.error());
    if (reply->status >= 300) return refused(*reply);
    if (json) return std::cout << reply->body << std::flush, exit_ok;
    std::cout << show(Json::parse(reply->body)) << std::flush;
    return exit_ok;
}

int exit_code_of(const Json& run, bool until_published) {
    if (run.is_null()) return exit_ok;
    if (run.at("state") != "complete") return exit_incomplete;
    return until_published && run.at("certificate") == "" ? exit_failed : exit_ok;
}

int outcome(const Json& status, bool until_published) {
    const Json& run = status.at("run");
    if (run.is_null()) return std::cout << "No run is open.\n", exit_ok;
    const bool complete = run.at("state") == "complete";
    std::cout << "Run " << run.at("id").get<std::string>() << " is "
              << run.at("state").get<std::string>();
    if (complete && !run.at("certificate").get<std::string>().empty())
        std::cout << "; certificate in " << run.at("certificate").get<std::string>();
    if (!run.at("sentence").get<std::string>().empty())
        std::cout << ": " << run.at("sentence").get<std::string>();
    std::cout << "\n";
    return exit_code_of(run, until_published);
}

/// How `watch` shows one status after the other.
class Frames {
public:
    Frames(bool json, bool until_published)
        : json_{json}
        , until_published_{until_published}
        , screen_{!json && output_is_screen()}
        , colour_{output_takes_colour()} {}

    void show(const std::string& body, const Json& status) {
        if (json_)
            std::cout << body;
        else if (screen_)
            std::cout << new_screen + screen_text(status_parts(status), size_of_screen(), colour_);
        else if (const std::string news = news_of(status); news != std::exchange(last_, news))
            std::cout << progress_line(status) << "\n";
        std::cout << std::flush;
    }
    /// The last word, once there is nothing to wait for.
    [[nodiscard]] int end(const Json& status) const {
        return json_ ? exit_code_of(status.at("run"), until_published_)
                     : outcome(status, until_published_);
    }

private:
    /// In a log a line is worth a new point or a new sentence.
    static std::string news_of(const Json& status) {
        const Json& run = status.at("run");
        return run.is_null() ? "" : json_text(run.at("step")) + json_text(run.at("sentence"));
    }
    bool json_, until_published_, screen_, colour_;
    std::string last_;
};

/// Still something to wait for: an open run, or a certificate that is not written yet.
bool goes_on(const Json& status, bool until_published) {
    if (status.at("run_open") == true) return true;
    const Json& run = status.at("run");
    return until_published && !run.is_null() && run.at("state") == "complete" &&
           run.at("certificate") == "" && run.at("sentence") == "";
}

Result<std::uint64_t> seed_of(const std::string& path, const std::string& text) {
    std::uint64_t number = 0;
    const auto end = text.data() + text.size();
    if (std::from_chars(text.data(), end, number).ptr != end)
        return fail(Fault::bad_request, path + ": its seed '" + text + "' is no number");
    return number;
}

/// What the header comment of a generated program says: "seed=123 pass=whole".
Result<void> read_program_header(const std::string& path, Json& body) {
    std::ifstream file{path};
    if (!file) return fail(Fault::io, "cannot read the program " + path);
    std::string line;
    for (int i = 0; i < 20 && std::getline(file, line); ++i) {
        const auto value_of = [&](const std::string& key) {
            const auto at = line.find(key + "=");
            if (at == std::string::npos) return std::string{};
            const auto begin = at + key.size() + 1;
            return line.substr(begin, line.find_first_of(" )\r\n", begin) - begin);
        };
        if (const std::string seed = value_of("seed"); !seed.empty() && seed != "none") {
            AXISCAL_TRY(body["seed"], seed_of(path, seed));
        }
        if (const std::string pass = value_of("pass"); !pass.empty())
            return body["pass"] = pass, Result<void>{};
    }
    return fail(Fault::bad_request,
                path + " is not a program of 'axiscal program': its header names no pass");
}

/// After an update the old daemon may still be at work.
std::string other_version(const std::string& of_daemon) {
    if (of_daemon == software_version()) return "";
    return "axiscald is version " + of_daemon + ", this axiscal " + software_version() +
           ": sudo systemctl restart axiscald\n";
}

} // namespace

int command_status(const StationClient& client, bool json) {
    return ask(client.get("/v1/status"), json, [](const Json& status) {
        return status_text(status) + other_version(status.value("version", software_version()));
    });
}

int command_watch(const StationClient& client, bool json, bool until_published) {
    Frames frames{json, until_published};
    for (;;) {
        const auto reply = client.get("/v1/status");
        if (!reply) return tell_no_contact(reply.error());
        if (reply->status >= 300) return refused(*reply);
        const Json status = Json::parse(reply->body);
        frames.show(reply->body, status);
        if (!std::cout) return exit_failed; // nobody can read it any more; main tells why
        if (!goes_on(status, until_published)) return frames.end(status);
        std::this_thread::sleep_for(repaint);
    }
}

int command_arm(const StationClient& client, const ArmOrder& order, bool json) {
    Json body{{"pass", order.pass},
              {"datum_by_cnc", order.datum_by_cnc},
              {"statements", order.statements}};
    if (!order.overrides.empty()) body["overrides"] = order.overrides;
    if (!order.options.empty()) body["options"] = order.options;
    if (!order.by.empty()) body["by"] = order.by;
    if (order.datum_mm) body["datum_mm"] = *order.datum_mm;
    if (!order.program.empty())
        if (const auto read = read_program_header(order.program, body); !read)
            return std::cerr << read.error().detail << "\n", exit_refused;
    if (order.seed) body["seed"] = *order.seed;
    return ask(client.post("/v1/run", json_text(body)), json, [](const Json& reply) {
        return "Armed: run " + reply.at("run").get<std::string>() +
               ". The part program that waits at its datum goes on by itself (start it now if it "
               "was not started); 'axiscal watch' shows the progress.\n";
    });
}

int command_preflight(const StationClient& client, const ArmOrder& order, bool json) {
    Json body{
        {"pass", order.pass}, {"statements", order.statements}, {"overrides", order.overrides}};
    if (!order.options.empty()) body["options"] = order.options;
    const auto reply = client.post("/v1/preflight", json_text(body));
    bool holds = true;
    const int code =
        ask(reply, json, [](const Json& answer) { return checks_text(answer.at("checks")); });
    if (code == exit_ok) holds = all_hold(Json::parse(reply->body).at("checks"));
    return code != exit_ok || holds ? code : static_cast<int>(exit_forbidden);
}

namespace {

Json body_of(const RevisionOrder& order) {
    Json body{{"reason", order.reason}};
    if (!order.by.empty()) body["by"] = order.by;
    if (order.target) body["target"] = *order.target - 1;
    if (order.cycle) body["cycle"] = *order.cycle - 1;
    if (!order.direction.empty())
        body["direction"] = order.direction == "up" ? "positive" : "negative";
    return body;
}

std::string retake_text(const Json& answer) {
    std::string text = "To be taken again, after the points that are left:\n";
    for (const Json& point : answer.at("points"))
        text += "  P" + std::to_string(point.at("target").get<int>() + 1) +
                (point.at("direction") == "positive" ? " up" : " down") + ", cycle " +
                std::to_string(point.at("approach").get<int>() + 1) + "\n";
    return text + "The requests count on from the last one. 'axiscal program --retake RUN.axiscal' "
                  "writes the part program.\n";
}

} // namespace

int command_retake(const StationClient& client, const RevisionOrder& order, bool json) {
    return ask(client.post("/v1/run/retake", json_text(body_of(order))), json, retake_text);
}

int command_exclude(const StationClient& client, const RevisionOrder& order, bool json) {
    return ask(
        client.post("/v1/run/exclude", json_text(body_of(order))), json, [](const Json& answer) {
            const auto excluded = answer.at("excluded").get<long>();
            return counted(excluded, "reading") +
                   (excluded == 1
                        ? " is left out of every figure; it stays in the file and is drawn.\n"
                        : " are left out of every figure; they stay in the file and are "
                          "drawn.\n");
        });
}

int command_answer(const StationClient& client, const FindingAnswer& answer, bool json) {
    Json body{{"finding", answer.finding}, {"text", answer.text}};
    if (!answer.by.empty()) body["by"] = answer.by;
    return ask(client.post("/v1/run/answer", json_text(body)), json, [](const Json&) {
        return std::string{"The answer stands in the run file; a new certificate bears it.\n"};
    });
}

int command_trigger(const StationClient& client, bool json) {
    return ask(client.post("/v1/run/trigger", ""), json, [](const Json&) {
        return std::string{"The next point is being captured, marked manual.\n"};
    });
}

int command_reading(const StationClient& client, double seconds_of_arc, bool json) {
    const Json body{{"arcsec", seconds_of_arc}};
    return ask(client.post("/v1/run/reading", json_text(body)), json,
               [](const Json&) { return std::string{"The reading is taken.\n"}; });
}

int command_abort(const StationClient& client,
                  const std::string& reason,
                  const std::string& by,
                  bool json) {
    Json body = Json::object();
    if (!reason.empty()) body["reason"] = reason;
    if (!by.empty()) body["by"] = by;
    return ask(client.post("/v1/run/abort", json_text(body)), json, [](const Json& ended) {
        if (ended.value("run", "") == "complete")
            return "The run is complete: " + ended.value("reason", "") + "\n";
        return std::string{"The run is closed as incomplete; its file is kept.\n"};
    });
}

} // namespace axiscal
