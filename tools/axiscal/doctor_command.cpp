#include "tools/axiscal/doctor_command.hpp"

#include "config/json_text.hpp"
#include "tools/axiscal/doctor/to_do_list.hpp"
#include "tools/axiscal/exit_code.hpp"
#include "tools/axiscal/status_text.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <sys/utsname.h>
#include <utility>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 3> health_names{"good", "note", "broken"};
constexpr std::array<const char*, 3> health_words{"good", "NOTE", "BROKEN"};

std::string name_of(Health health) {
    return health_names[static_cast<std::size_t>(health)];
}

std::string running_kernel() {
    utsname kernel{};
    ::uname(&kernel);
    return kernel.release;
}

/// A tape in an instrument's place is accepted, and keeps the station from measuring.
std::vector<Finding> findings_of_accepted(const StationConfig& config, const std::string& file) {
    std::vector<Finding> found{{Health::good, "station", file + " is accepted", ""}};
    for (const InstrumentConfig& instrument : config.instruments)
        if (!instrument.tape.empty())
            found.push_back({Health::broken, "station",
                             "\"" + instrument.name + "\" plays the tape " + instrument.tape +
                                 " and is no instrument: no run can be armed",
                             "sudo editor " + file + ", remove the line tape = ..."});
    return found;
}

/// What is wrong with the station file, or that it is right.
std::vector<Finding> findings_of(const tl::expected<LoadedStation, std::vector<Refusal>>& station,
                                 const std::string& file) {
    if (station) return findings_of_accepted(station->config, file);
    if (!std::filesystem::exists(file))
        return {{Health::broken, "station", "there is no station file " + file,
                 "sudo install -m 640 -g axiscal /usr/share/axiscal/station.example.toml " + file +
                     ", then edit it"}};
    const std::string remedy = "sudo editor " + file + ", then: axiscal check-config " + file;
    std::vector<Finding> found;
    found.reserve(station.error().size());
    for (const Refusal& refusal : station.error())
        found.push_back({Health::broken, "station", refusal.describe(), remedy});
    return found;
}

void ask_daemon(const StationClient& client, CheckedSystem& checked, std::vector<ToDo>& to_do) {
    const auto reply = client.get("/v1/status");
    checked.daemon_answers = reply && reply->status < 300;
    if (!checked.daemon_answers) return;
    const Json status = Json::parse(reply->body, nullptr, false);
    if (status.is_object()) checked.daemon_version = status.value("version", "");
    to_do = to_do_of(status);
    if (status.is_object() && status.contains("trigger"))
        checked.trigger_note = status["trigger"].value("note", "");
}

StationWires wires_of(const std::string& file) {
    auto document = SettingsDocument::load(file);
    return document ? read_station_wires(*document) : StationWires{};
}

struct Examined {
    std::vector<Finding> findings; ///< of every check
    std::vector<ToDo> to_do;       ///< of the station alone
};

/// Every check in the order in which a technician would go about it. Those of the station need its
/// file.
Examined examine(const DoctorRequest& request) {
    const auto station = load_station(request.station_file);
    Examined examined;
    std::vector<Finding>& all = examined.findings;
    all = findings_of(station, request.station_file);
    const auto add = [&](std::vector<Finding> more) {
        std::ranges::move(more, std::back_inserter(all));
    };
    const std::int64_t utc_ns =
        std::chrono::nanoseconds{std::chrono::system_clock::now().time_since_epoch()}.count();
    CheckedSystem checked;
    checked.config = station ? &station->config : nullptr;
    checked.wires = wires_of(request.station_file);
    checked.service = service_account();
    const ConsoleConfig console = station ? station->config.console : ConsoleConfig{};
    const std::string socket = request.socket.empty() ? console.socket_path : request.socket;
    const StationClient client{{socket, "", ""}};
    ask_daemon(client, checked, examined.to_do);
    add(check_account(checked));
    add(check_wires(checked, request.places));
    if (station) add(check_certificates(station->config, utc_ns));
    add(check_clock(request.places));
    add(check_disk(checked));
    if (station) add(check_share(checked, utc_ns));
    if (station) add(check_webhook(checked));
    if (station) add(check_ports(checked));
    add(check_modules(checked, request.places));
    add(check_papers(request.places));
    return examined;
}

Json to_do_json(const std::vector<ToDo>& to_do) {
    Json list = Json::array();
    for (const ToDo& entry : to_do)
        list.push_back({{"id", entry.id},
                        {"rank", name_of(entry.rank)},
                        {"source", name_of(entry.source)},
                        {"seen", entry.seen},
                        {"since_utc", entry.since_utc},
                        {"next", entry.next},
                        {"command", entry.command},
                        {"undo", entry.undo}});
    return list;
}

void print(const std::vector<Finding>& findings) {
    for (const Finding& finding : findings) {
        std::cout << std::left << std::setw(8)
                  << health_words[static_cast<std::size_t>(finding.health)] << std::setw(13)
                  << finding.area << finding.what << "\n";
        if (!finding.mend.empty())
            std::cout << std::string(21, ' ') << "-> " << finding.mend << "\n";
    }
}

} // namespace

int command_doctor(const DoctorRequest& request, bool json) {
    DoctorRequest whole = request;
    if (whole.places.modules.empty()) whole.places.modules = "/lib/modules/" + running_kernel();
    const Examined examined = examine(whole);
    const std::vector<Finding>& findings = examined.findings;
    const std::vector<ToDo> to_do = with_findings(examined.to_do, findings);
    const auto broken = std::ranges::count(findings, Health::broken, &Finding::health);
    const auto notes = std::ranges::count(findings, Health::note, &Finding::health);
    if (json) {
        Json list = Json::array();
        for (const Finding& finding : findings)
            list.push_back({{"health", name_of(finding.health)},
                            {"area", finding.area},
                            {"what", finding.what},
                            {"mend", finding.mend}});
        std::cout << json_text(Json{{"findings", std::move(list)},
                                    {"broken", broken},
                                    {"notes", notes},
                                    {"to_do", to_do_json(to_do)}})
                  << "\n";
    } else {
        std::cout << to_do_text(to_do) << "\n";
        print(findings);
        std::cout << (broken == 0 ? "Nothing is broken" : std::to_string(broken) + " broken")
                  << "; " << notes << " to know\n";
    }
    return broken == 0 ? exit_ok : exit_unwell;
}

} // namespace axiscal
