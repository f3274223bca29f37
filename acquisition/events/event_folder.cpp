#include "acquisition/events/event_folder.hpp"

#include "acquisition/runfile/durable_file.hpp"
#include "analysis/quantity/valid_text.hpp"
#include "config/json_text.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <utility>

namespace axiscal {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view body_ending = ".json";
constexpr std::size_t longest_event_file = std::size_t{64} * 1024; // far above a body

std::string events_of(const std::string& state_directory) {
    return state_directory + "/events";
}
std::string waiting_of(const std::string& state_directory) {
    return events_of(state_directory) + "/waiting";
}
std::string sent_of(const std::string& state_directory) {
    return events_of(state_directory) + "/sent";
}
std::string body_file(const std::string& state_directory, const std::string& id) {
    return waiting_of(state_directory) + "/" + id + std::string{body_ending};
}

std::optional<std::string> small_file(const std::string& path) {
    std::ifstream file{path, std::ios::binary};
    if (!file) return std::nullopt;
    std::string text(longest_event_file, '\0');
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (file.bad()) return std::nullopt; // a folder opens, too
    text.resize(static_cast<std::size_t>(file.gcount()));
    return text;
}

std::optional<AskedEvents> asked_events(const std::string& state_directory) {
    const auto text = small_file(events_of(state_directory) + "/asked.json");
    const auto json = nlohmann::json::parse(text.value_or(""), nullptr, false);
    if (!json.is_object() || !json.contains("station") || !json["station"].is_string())
        return std::nullopt;
    const auto holds = [&](const char* key) {
        return json.contains(key) && json[key].is_boolean() && json[key].get<bool>();
    };
    return AskedEvents{json["station"].get<std::string>(), holds("complete"), holds("fault")};
}

/// Plain names of a folder, the oldest first.
std::vector<std::string> names_by_age(const std::string& folder) {
    std::vector<std::pair<fs::file_time_type, std::string>> found;
    std::error_code error;
    for (fs::directory_iterator at{folder, error}, end; !error && at != end; at.increment(error)) {
        std::string name = at->path().filename().string();
        std::error_code gone; // taken meanwhile
        const auto changed = at->last_write_time(gone);
        if (!gone && name.front() != '.') found.emplace_back(changed, std::move(name));
    }
    std::ranges::sort(found);
    std::vector<std::string> names;
    names.reserve(found.size());
    for (auto& [changed, name] : found)
        names.push_back(std::move(name));
    return names;
}

bool is_known(const std::string& state_directory, const std::string& id) {
    std::error_code error;
    return fs::exists(body_file(state_directory, id), error) ||
           fs::exists(sent_of(state_directory) + "/" + id, error);
}

/// Room for one more. A count that was lost to a crash is too small: never too large.
Result<void> make_room(const std::string& state_directory) {
    const std::vector<std::string> waiting = waiting_events(state_directory);
    if (waiting.size() < most_waiting_events) return {};
    const std::size_t too_many = waiting.size() - most_waiting_events + 1;
    for (std::size_t i = 0; i < too_many; ++i) {
        std::error_code taken_meanwhile;
        fs::remove(body_file(state_directory, waiting[i]), taken_meanwhile);
    }
    const auto dropped = dropped_events(state_directory) + static_cast<std::int64_t>(too_many);
    return replace_synced(events_of(state_directory) + "/dropped", std::to_string(dropped) + "\n");
}

void forget_oldest_sent(const std::string& folder) {
    const std::vector<std::string> sent = names_by_age(folder);
    for (std::size_t i = 0; i + most_sent_events < sent.size(); ++i) {
        std::error_code stays;
        fs::remove(folder + "/" + sent[i], stays);
    }
}

} // namespace

Result<void> open_events(const std::string& state_directory, const AskedEvents& asked) {
    std::error_code error;
    for (const std::string& folder : {waiting_of(state_directory), sent_of(state_directory)}) {
        fs::create_directories(folder, error);
        if (error) return fail_io("cannot make", folder, error.value());
    }
    const nlohmann::ordered_json json{
        {"station", asked.station}, {"complete", asked.complete}, {"fault", asked.fault}};
    return replace_synced(events_of(state_directory) + "/asked.json", json_text(json) + "\n");
}

void close_events(const std::string& state_directory) {
    std::error_code ignored; // what stays is not added to: the next start tries again
    if (!fs::exists(events_of(state_directory), ignored)) return;
    fs::remove(events_of(state_directory) + "/asked.json", ignored);
    fs::remove_all(events_of(state_directory), ignored);
}

Result<bool> lay_event(const std::string& state_directory, const StationEvent& event) {
    const auto asked = asked_events(state_directory);
    if (!asked) return false;
    const bool wanted =
        event.about == StationEvent::About::complete ? asked->complete : asked->fault;
    const std::string id = event_id(event);
    if (!wanted || is_known(state_directory, id)) return false;
    AXISCAL_CHECK(make_room(state_directory));
    AXISCAL_CHECK(
        replace_synced(body_file(state_directory, id),
                       event_body(event, asked->station, dropped_events(state_directory))));
    return true;
}

std::vector<std::string> waiting_events(const std::string& state_directory) {
    std::vector<std::string> ids;
    for (const std::string& name : names_by_age(waiting_of(state_directory)))
        if (name.ends_with(body_ending))
            ids.push_back(name.substr(0, name.size() - body_ending.size()));
    return ids;
}

Result<std::string> waiting_body(const std::string& state_directory, const std::string& id) {
    auto text = small_file(body_file(state_directory, id));
    if (!text) return fail(Fault::not_found, "no event " + id);
    return *std::move(text);
}

Result<void> settle_event(const std::string& state_directory, const std::string& id) {
    const std::string sent = sent_of(state_directory);
    AXISCAL_CHECK(write_synced(sent + "/" + id, ""));
    AXISCAL_CHECK(sync_folder(sent));
    std::error_code error;
    fs::remove(body_file(state_directory, id), error);
    if (error) return fail_io("cannot remove", body_file(state_directory, id), error.value());
    forget_oldest_sent(sent);
    return {};
}

std::int64_t dropped_events(const std::string& state_directory) {
    const std::string text = small_file(events_of(state_directory) + "/dropped").value_or("");
    std::int64_t count = 0;
    std::from_chars(text.data(), text.data() + text.size(), count);
    return count;
}

void tell_event_trouble(const std::string& state_directory, const std::string& sentence) {
    const std::string path = events_of(state_directory) + "/trouble";
    std::error_code ignored;
    if (sentence.empty()) {
        fs::remove(path, ignored);
        return;
    }
    std::ofstream file{path, std::ios::trunc};
    file << valid_text(sentence) << '\n';
}

std::string event_trouble(const std::string& state_directory) {
    std::string text = small_file(events_of(state_directory) + "/trouble").value_or("");
    while (text.ends_with('\n'))
        text.pop_back();
    return text;
}

} // namespace axiscal
