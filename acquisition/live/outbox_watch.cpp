#include "acquisition/live/outbox_watch.hpp"

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
constexpr Duration coarse = std::chrono::seconds{1};
// A result that the daemon finds when it starts may wait since long holidays; a stamp older than
// this, or of the future, is one of a clock that was wrong.
constexpr Duration longest_plausible_wait = std::chrono::hours{24 * 366};
constexpr Duration judge_outbox_every = std::chrono::seconds{10};
/// Of an outbox that was empty: a person may have put something there.
constexpr Duration look_into_an_empty_one_every = std::chrono::minutes{1};
constexpr std::uintmax_t longest_report = 16'384; // bytes; one sentence and two names

std::optional<std::int64_t> changed_ns_of(const std::string& path) {
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

bool OutboxWatch::Stamp::renew(const std::string& path, MonotonicTime now) {
    const auto there_ns = changed_ns_of(path).value_or(0);
    if (there_ns == changed_ns && settled) return false;
    if (there_ns != changed_ns) seen = now;
    changed_ns = there_ns;
    settled = now - seen > coarse;
    return true;
}

OutboxView OutboxWatch::look(const ClockTie& now) {
    scan(now);
    listen(now.after);
    looked_ = now.after;
    OutboxView view = known_;
    view.waiting = static_cast<int>(finished_.size());
    for (const auto& [name, since] : finished_)
        view.oldest_s = std::max(view.oldest_s.value_or(0), seconds_of(now.after - since));
    view.publisher_runs = publisher_runs();
    view.alarm = alarm_of(view);
    return view;
}

std::optional<std::string> OutboxWatch::judge(const ClockTie& now) {
    if (now.after - judged_ < judge_outbox_every) return std::nullopt;
    judged_ = now.after;
    const OutboxView view = look(now);
    waiting_ = view.waiting;
    if (view.alarm.empty() == alarm_.empty()) return std::nullopt;
    alarm_ = view.alarm;
    return alarm_.empty() ? "The share takes results again." : "Alarm: " + alarm_ + ".";
}

std::optional<MonotonicTime> OutboxWatch::due() const {
    if (config_.destination.empty()) return std::nullopt;
    const bool empty = waiting_ == 0 && alarm_.empty();
    return judged_ + (empty ? look_into_an_empty_one_every : judge_outbox_every);
}

void OutboxWatch::scan(const ClockTie& now) {
    if (!outbox_stamp_.renew(outbox_, now.after)) return;
    std::map<std::string, MonotonicTime> there;
    std::error_code error;
    for (std::filesystem::directory_iterator at{outbox_, error}, end; !error && at != end;
         at.increment(error)) {
        const std::string name = at->path().filename().string();
        std::error_code gone; // published meanwhile: no reason to forget the others
        if (name.starts_with(".") || !at->is_directory(gone)) continue;
        const auto known = finished_.find(name);
        there[name] = known != finished_.end() ? known->second : finished(at->path().string(), now);
    }
    if (error) outbox_stamp_.settled = false;
    if (error && error != std::errc::no_such_file_or_directory) return;
    finished_ = std::move(there);
}

/// When a new entry was finished, by the monotonic clock. Its files were all there before it got
/// its name: the folder's time is that of the last of them.
MonotonicTime OutboxWatch::finished(const std::string& folder, const ClockTie& now) const {
    const Duration age{now.utc_ns - changed_ns_of(folder).value_or(now.utc_ns)};
    if (looked_) return now.after - std::clamp(age, Duration{}, now.after - *looked_);
    return age < Duration{} || age > longest_plausible_wait ? now.after : now.after - age;
}

void OutboxWatch::listen(MonotonicTime now) {
    if (!report_stamp_.renew(report_, now)) return;
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
    std::string words = waiting_text(view.waiting) + " for the share since " +
                        rounded_age(view.oldest_s.value_or(0)) + ": ";
    if (!view.publisher_runs)
        return words + "axiscal-publish does not run (systemctl start axiscal-publish)";
    return words + (view.reason.empty() ? "axiscal-publish is at work" : view.reason);
}

std::string waiting_text(int count) {
    return std::to_string(count) + (count == 1 ? " result waits" : " results wait");
}

std::string rounded_age(double seconds) {
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
