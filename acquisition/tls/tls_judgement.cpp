#include "acquisition/tls/tls_judgement.hpp"

#include "acquisition/tls/tls_loading.hpp"

#include <filesystem>
#include <optional>
#include <pwd.h>
#include <string>
#include <sys/stat.h>
#include <unistd.h>

namespace axiscal {
namespace {

constexpr const char* service_user = "axiscal";
constexpr std::int64_t second_ns = 1'000'000'000;

/// By the rights that stand at the file or folder. @param right  4: reads, 1: enters
bool has_right(const passwd& user, const std::string& path, unsigned right) {
    struct stat found {};
    if (::stat(path.c_str(), &found) != 0) return true; // what is missing is told elsewhere
    const unsigned mode = found.st_mode;
    if (found.st_uid == user.pw_uid) return ((mode >> 6U) & right) != 0;
    if (found.st_gid == user.pw_gid) return ((mode >> 3U) & right) != 0;
    return (mode & right) != 0;
}

/// Whether the user of the service gets at it. Asked where root checks, who reads everything.
bool service_reads(const passwd& user, const std::string& path) {
    std::error_code unknown;
    const std::filesystem::path whole = std::filesystem::canonical(path, unknown);
    if (unknown) return true;
    for (auto folder = whole.parent_path(); folder != folder.root_path();
         folder = folder.parent_path())
        if (!has_right(user, folder.string(), 1)) return false;
    return has_right(user, whole.string(), 4);
}

std::optional<passwd> user_of_service() {
    if (::geteuid() != 0) return std::nullopt;
    const passwd* const known = ::getpwnam(service_user); // NOLINT(concurrency-mt-unsafe)
    return known == nullptr ? std::nullopt : std::optional{*known};
}

Refusal refusal_at(const StationConfig& station, bool of_key, std::string sentence) {
    const ConsoleConfig& console = station.console;
    return {station.file, of_key ? console.key_line : console.certificate_line,
            of_key ? "console.key" : "console.certificate", std::move(sentence)};
}

void judge_for_the_service(const StationConfig& station, TlsJudgement& judged) {
    const auto user = user_of_service();
    if (!user) return;
    for (const bool of_key : {false, true}) {
        const std::string& path = of_key ? station.console.key : station.console.certificate;
        if (!service_reads(*user, path))
            judged.notes.push_back(
                refusal_at(station, of_key,
                           path + " is read by root, but not by the user axiscal of the service: "
                                  "sudo chgrp axiscal it, chmod 0640, and let that group enter "
                                  "its folder"));
    }
}

} // namespace

TlsJudgement judge_tls(const StationConfig& station, std::int64_t utc_ns) {
    TlsJudgement judged;
    if (!station.console.speaks_tls()) return judged;
    const Result<TlsModule*> module = load_tls_module();
    if (!module) {
        judged.refusals.push_back(refusal_at(station, false, module.error().detail));
        return judged;
    }
    const TlsFiles files{station.console.certificate, station.console.key};
    for (TlsFinding& finding : (*module)->judge(files, utc_ns / second_ns)) {
        auto& list = finding.refuses ? judged.refusals : judged.notes;
        list.push_back(refusal_at(station, finding.of_key, std::move(finding.sentence)));
    }
    if (judged.refusals.empty()) judge_for_the_service(station, judged);
    return judged;
}

} // namespace axiscal
