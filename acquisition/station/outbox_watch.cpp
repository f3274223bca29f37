#include "acquisition/station/outbox_watch.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <sys/stat.h>
#include <unistd.h>

namespace axiscal {
namespace {

// A file system stamps changes by a coarse clock: what changed this recently may change again under
// the same stamp, and is read again.
constexpr std::int64_t coarse_ns = 1'000'000'000;
constexpr std::uintmax_t longest_report = 16'384; // bytes; one sentence and two names

std::optional<std::int64_t> changed_ns(const std::string& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) return std::nullopt;
    return std::int64_t{status.st_mtim.tv_sec} * 1'000'000'000 + status.st_mtim.tv_nsec;
}

std::string text_of(const nlohmann::json& document, const char* key) {
    const auto found = document.find(key);
    return found != document.end() && found->is_string() ? found->get<std::string>() : "";
}

} // namespace

OutboxWatch::OutboxWatch(const std::string& state_directory, PublishConfig config)
    : outbox_{state_directory + "/outbox"}
    , report_{state_directory + "/publisher.json"}
    , lock_{state_directory + "/publisher.lock"}
    , config_{std::move(config)} {}

OutboxView OutboxWatch::look(std::int64_t utc_ns) {
    scan(utc_ns);
    listen(utc_ns);
    OutboxView view = known_;
    if (oldest_ns_) view.oldest_s = std::max(0.0, static_cast<double>(utc_ns - *oldest_ns_) * 1e-9);
    view.publisher_runs = publisher_runs();
    view.alarm = alarm_of(view);
    return view;
}

void OutboxWatch::scan(std::int64_t utc_ns) {
    const auto changed = changed_ns(outbox_).value_or(0);
    if (changed == scanned_change_ns_) return;
    known_.waiting = 0;
    oldest_ns_.reset();
    std::error_code error;
    for (std::filesystem::directory_iterator at{outbox_, error}, end; !error && at != end;
         at.increment(error)) {
        if (at->path().filename().string().starts_with(".") || !at->is_directory(error)) continue;
        ++known_.waiting;
        // The entry's files were all there before it got its name: none came later.
        if (const auto finished = changed_ns(at->path().string()))
            oldest_ns_ = std::min(oldest_ns_.value_or(*finished), *finished);
    }
    const bool settled = !error && std::abs(utc_ns - changed) > coarse_ns;
    scanned_change_ns_ = settled ? changed : -1;
}

void OutboxWatch::listen(std::int64_t utc_ns) {
    const auto changed = changed_ns(report_).value_or(0);
    if (changed == read_change_ns_) return;
    read_change_ns_ = std::abs(utc_ns - changed) > coarse_ns ? changed : -1;
    std::error_code error;
    const auto size = std::filesystem::file_size(report_, error);
    nlohmann::json said = nlohmann::json::object();
    if (!error && size <= longest_report) {
        std::ifstream file{report_};
        said = nlohmann::json::parse(file, nullptr, false);
    }
    if (!said.is_object() || text_of(said, "format") != "axiscal.publisher/1")
        said = nlohmann::json::object();
    known_.destination = text_of(said, "destination");
    known_.state = text_of(said, "state");
    known_.reason = text_of(said, "reason");
    known_.since_utc = text_of(said, "since_utc");
}

/// The publisher holds its lock for life; asking takes nothing.
bool OutboxWatch::publisher_runs() const {
    const int file = ::open(lock_.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) return false;
    struct flock whole {};
    whole.l_type = F_WRLCK;
    whole.l_whence = SEEK_SET;
    const bool held = ::fcntl(file, F_OFD_GETLK, &whole) == 0 && whole.l_type != F_UNLCK;
    ::close(file);
    return held;
}

std::string OutboxWatch::alarm_of(const OutboxView& view) const {
    if (config_.destination.empty() || view.waiting == 0) return "";
    const bool old = view.oldest_s.value_or(0) > seconds_of(config_.alarm_age);
    if (!old && view.waiting < config_.alarm_count) return "";
    std::string words = waiting_words(view.waiting) + " for the share since " +
                        age_words(view.oldest_s.value_or(0)) + ": ";
    if (!view.publisher_runs)
        return words + "axiscal-publish does not run (systemctl start axiscal-publish)";
    return words + (view.reason.empty() ? "axiscal-publish is at work" : view.reason);
}

std::string waiting_words(int count) {
    return std::to_string(count) + (count == 1 ? " result waits" : " results wait");
}

std::string age_words(double seconds) {
    struct Unit {
        double seconds;
        const char* name;
    };
    constexpr std::array units{Unit{86400, " d"}, Unit{3600, " h"}, Unit{60, " min"}};
    for (const auto& unit : units)
        if (seconds >= 2 * unit.seconds)
            return std::to_string(static_cast<long>(seconds / unit.seconds)) + unit.name;
    return std::to_string(static_cast<long>(seconds)) + " s";
}

} // namespace axiscal
