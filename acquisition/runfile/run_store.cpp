#include "acquisition/runfile/run_store.hpp"

#include "acquisition/runfile/durable_file.hpp"
#include "analysis/quantity/time.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fcntl.h>
#include <filesystem>
#include <functional>
#include <set>
#include <unistd.h>
#include <utility>

namespace axiscal {
namespace {

constexpr std::string_view sqlite_magic{"SQLite format 3\0", 16};
constexpr std::size_t write_version = 18, read_version = 19, change_counter = 24, head_bytes = 28;
constexpr std::uint32_t changes_of_a_folded_run = 3; // made, WAL, folded
constexpr unsigned char rollback_journal = 1;        // 2: WAL

std::uint32_t big_endian(const unsigned char* bytes) {
    return std::uint32_t{bytes[0]} << 24U | std::uint32_t{bytes[1]} << 16U |
           std::uint32_t{bytes[2]} << 8U | std::uint32_t{bytes[3]};
}

bool is_folded(const FileHandle& folder, const std::string& name) {
    // A pipe of that name would hold up its opening.
    const FileHandle file{
        ::openat(folder.get(), name.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)};
    if (!file) return false;
    std::array<unsigned char, head_bytes> head{};
    if (::pread(file.get(), head.data(), head.size(), 0) != std::ssize(head)) return false;
    return std::equal(sqlite_magic.begin(), sqlite_magic.end(), head.begin(),
                      [](char letter, unsigned char byte) {
                          return static_cast<unsigned char>(letter) == byte;
                      }) &&
           head[write_version] == rollback_journal && head[read_version] == rollback_journal &&
           big_endian(&head[change_counter]) >= changes_of_a_folded_run;
}

std::set<std::string> names_in(const std::string& folder) {
    std::set<std::string> names;
    std::error_code error;
    for (std::filesystem::directory_iterator entry{folder, error}, end; !error && entry != end;
         entry.increment(error))
        names.insert(entry->path().filename().string());
    return names;
}

enum class Look : std::uint8_t { into, past, no_further };

/// Whether a file whose name bears `instant` can be newer than those seen, the later names being
/// among them. Where all of those lie in the future the clock was set back since: the latest name
/// that does not is looked into as well.
Look worth(const std::string& instant,
           const std::vector<RunSummary>& seen,
           const PresentBoot& present) {
    const RunSummary* newest = newest_run(seen, present.id);
    if (newest == nullptr || instant.empty() ||
        instant >= instant_in_name(earliest_utc_ns_after(*newest, present)))
        return Look::into;
    const bool all_in_the_future =
        present.id.known() && std::ranges::all_of(seen, [&](const RunSummary& run) {
            return run.opened_utc_ns > present.now.utc_ns;
        });
    if (!all_in_the_future) return Look::no_further;
    return instant > instant_in_name(present.now.utc_ns) ? Look::past : Look::into;
}

/// Those whose name says nothing first, then from the latest name on until no other can be newer.
std::optional<RunSummary> newest_of(const StoredRuns& runs, const PresentBoot& present) {
    std::vector<RunSummary> seen = runs.looked_into;
    std::vector<std::pair<std::string, std::string>> claims; // instant, path
    claims.reserve(runs.folded.size());
    for (const std::string& path : runs.folded)
        claims.emplace_back(instant_of_name(std::filesystem::path{path}.stem().string()), path);
    const auto dated = std::partition(claims.begin(), claims.end(),
                                      [](const auto& claim) { return claim.first.empty(); });
    std::sort(dated, claims.end(), std::greater{});
    for (const auto& [instant, path] : claims) {
        const Look look = worth(instant, seen, present);
        if (look == Look::no_further) break;
        if (look == Look::past) continue;
        if (auto run = summarize_run_file(path)) seen.push_back(*std::move(run));
    }
    const RunSummary* newest = newest_run(seen, present.id);
    return newest != nullptr ? std::optional{*newest} : std::nullopt;
}

} // namespace

std::string instant_in_name(std::int64_t utc_ns) {
    std::string instant = iso8601_utc(utc_ns);
    std::erase_if(instant, [](char letter) { return letter == '-' || letter == ':'; });
    return instant;
}

std::string instant_of_name(std::string_view name) {
    constexpr std::string_view shape = "00000000T000000Z";
    const auto fits = [](char letter, char wanted) {
        return wanted == '0' ? letter >= '0' && letter <= '9' : letter == wanted;
    };
    for (std::size_t left = name.size(); left >= shape.size(); --left) {
        const std::string_view word = name.substr(left - shape.size(), shape.size());
        if (std::ranges::equal(word, shape, fits)) return std::string{word};
    }
    return {};
}

Result<StoredRuns> look_through_runs(const std::string& folder, const PresentBoot& present) {
    // A closed run that somebody reads is put into one file later.
    if (auto tidied = tidy_run_files(folder); !tidied && tidied.error().fault != Fault::busy)
        return tl::unexpected<Error>(tidied.error());
    StoredRuns runs;
    const FileHandle place{::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)};
    if (!place) return runs;
    const std::set<std::string> names = names_in(folder);
    for (const std::string& name : names) {
        if (!name.ends_with(run_file_ending)) continue;
        std::string path = folder;
        path.append("/").append(name);
        const bool alone = !names.contains(name + "-wal") && !names.contains(name + "-shm") &&
                           !names.contains(name + "-journal");
        if (alone && is_folded(place, name))
            runs.folded.push_back(path);
        else if (auto summary = summarize_run_file(path))
            runs.looked_into.push_back(*std::move(summary));
        else
            ++runs.unreadable;
    }
    runs.newest = newest_of(runs, present);
    return runs;
}

} // namespace axiscal
