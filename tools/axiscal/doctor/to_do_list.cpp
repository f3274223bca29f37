#include "tools/axiscal/doctor/to_do_list.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <tuple>
#include <utility>

namespace axiscal {
namespace {

struct Pair {
    std::string_view does, undoes;
};
constexpr std::array undone{
    Pair{"systemctl enable --now ", "systemctl disable --now "},
    Pair{"systemctl start ", "systemctl stop "},
    Pair{"systemctl mask ", "systemctl unmask "},
    Pair{"adduser ", "deluser "},
    Pair{"timedatectl set-ntp true", "timedatectl set-ntp false"},
};

struct AreaSource {
    std::string_view area;
    ToDoSource source;
};
constexpr std::array area_sources{
    AreaSource{"clock", ToDoSource::clock}, AreaSource{"disk", ToDoSource::disk},
    AreaSource{"share", ToDoSource::outbox}, AreaSource{"wire", ToDoSource::instrument},
    AreaSource{"port", ToDoSource::trigger}};

/// The shell's line that a way to mend begins with; empty where it begins with words.
std::string command_in(const std::string& mend) {
    if (!mend.starts_with("sudo ") && !mend.starts_with("axiscal ")) return "";
    return mend.substr(0, std::min(mend.find(", "), mend.find("; ")));
}

std::string undo_of(const std::string& command) {
    for (const Pair& pair : undone)
        if (const auto at = command.find(pair.does); at != std::string::npos)
            return std::string{command}.replace(at, pair.does.size(), pair.undoes);
    return "";
}

/// "wire" and "laser" of a finding that begins with `"laser"`; empty of any other.
std::string quoted_name(const std::string& what) {
    if (!what.starts_with('"')) return "";
    const auto end = what.find('"', 1);
    return end == std::string::npos ? "" : what.substr(1, end - 1);
}

ToDo entry_of(const Finding& finding, std::size_t number) {
    ToDo entry;
    entry.id = "doctor/" + finding.area + "/" + std::to_string(number);
    entry.rank = finding.health == Health::broken ? ToDoRank::stop : ToDoRank::note;
    const auto known = std::ranges::find(area_sources, finding.area, &AreaSource::area);
    entry.source = known == area_sources.end() ? ToDoSource::doctor : known->source;
    entry.seen = finding.what;
    entry.next = finding.mend;
    entry.command = command_in(finding.mend);
    entry.undo = undo_of(entry.command);
    return entry;
}

bool is_about(const Finding& finding, const ToDo& entry) {
    const std::string name = quoted_name(finding.what);
    if (finding.area == "wire") return !name.empty() && entry.id == "instrument/" + name;
    return finding.area == "certificate" && !name.empty() && entry.id == "due/" + name;
}

bool says_the_same(const Finding& finding, const ToDo& entry) {
    return finding.what.find(entry.seen) != std::string::npos ||
           entry.seen.find(finding.what) != std::string::npos;
}

void add(const Finding& finding, std::vector<ToDo>& list) {
    const auto known =
        std::ranges::find_if(list, [&](const ToDo& entry) { return is_about(finding, entry); });
    if (known != list.end()) {
        if (finding.mend.empty()) return;
        known->next = finding.mend;
        known->command = command_in(finding.mend);
        known->undo = undo_of(known->command);
        return;
    }
    if (std::ranges::none_of(list,
                             [&](const ToDo& entry) { return says_the_same(finding, entry); }))
        list.push_back(entry_of(finding, list.size()));
}

std::string upper_name(ToDoRank rank) {
    constexpr std::array<const char*, 3> words{"STOP", "LOOK", "note"};
    return words[static_cast<std::size_t>(rank)];
}

} // namespace

std::vector<ToDo> with_findings(std::vector<ToDo> list, const std::vector<Finding>& findings) {
    for (const Finding& finding : findings)
        if (finding.health != Health::good) add(finding, list);
    std::ranges::stable_sort(list, {}, [](const ToDo& entry) {
        return std::tuple{entry.rank, entry.source};
    });
    return list;
}

std::string to_do_text(const std::vector<ToDo>& list) {
    if (list.empty()) return "To do        nothing\n";
    std::string text = "To do\n";
    for (const ToDo& entry : list) {
        text += "  " + upper_name(entry.rank) + "  " + entry.seen +
                (entry.since_utc.empty() ? "" : " (since " + entry.since_utc + ")") + "\n";
        text += "        -> " + entry.next + "\n";
        if (!entry.command.empty() && entry.next.find(entry.command) == std::string::npos)
            text += "           " + entry.command + "\n";
        if (!entry.undo.empty()) text += "           undo: " + entry.undo + "\n";
    }
    return text;
}

} // namespace axiscal
