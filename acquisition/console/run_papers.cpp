#include "acquisition/console/run_papers.hpp"

#include "acquisition/runfile/durable_file.hpp"
#include "acquisition/runfile/run_file.hpp"

#include <algorithm>
#include <array>
#include <fcntl.h>
#include <string_view>
#include <sys/stat.h>
#include <unistd.h>

namespace axiscal {
namespace {

constexpr int most_copies = 20; // of one certificate in "published"; none is usual
constexpr std::int64_t ns_per_s = 1'000'000'000;

FileStamp stamp_of_status(const struct stat& status) {
    if (!S_ISREG(status.st_mode)) return {};
    return {status.st_mtim.tv_sec * ns_per_s + status.st_mtim.tv_nsec, status.st_size,
            status.st_ino};
}

Result<void> read_into(std::string& bytes, const FileHandle& file) {
    std::size_t got = 0;
    while (got < bytes.size()) {
        const ::ssize_t part = ::read(file.get(), bytes.data() + got, bytes.size() - got);
        if (part < 0 && errno == EINTR) continue;
        if (part < 0) return fail(Fault::io, "it cannot be read", {errno, std::generic_category()});
        if (part == 0) break;
        got += static_cast<std::size_t>(part);
    }
    if (got != bytes.size()) return fail(Fault::io, "it became shorter while it was read");
    return {};
}

bool holds_certificate(const std::string& folder) {
    return stamp_of(folder + "/certificate.json").is_there();
}

} // namespace

FileStamp stamp_of(const std::string& path) {
    struct stat status {};
    if (::lstat(path.c_str(), &status) != 0) return {};
    return stamp_of_status(status);
}

Result<std::string> read_whole(const std::string& path, std::size_t most) {
    // A pipe of that name would hold up its opening.
    const FileHandle file{
        ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY)};
    struct stat status {};
    if (!file || ::fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode)) {
        if (!file && errno == EACCES) return fail(Fault::io, "the station may not read it");
        return fail(Fault::not_found, "it is not there");
    }
    if (static_cast<std::uint64_t>(status.st_size) > most)
        return fail(Fault::refused, "it is larger than " + std::to_string(most >> 20U) + " MiB");
    std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
    AXISCAL_CHECK(read_into(bytes, file));
    return bytes;
}

std::vector<PaperFolder> paper_folders(const std::string& state_directory,
                                       const std::string& name) {
    std::vector<PaperFolder> folders;
    const std::string published = state_directory + "/published/" + name;
    if (holds_certificate(published)) folders.push_back({published, true});
    for (int copy = 2; copy <= most_copies; ++copy) {
        const std::string place = published + "-" + std::to_string(copy);
        if (!holds_certificate(place)) break;
        folders.push_back({place, true});
    }
    const std::string waiting = state_directory + "/outbox/" + name;
    if (holds_certificate(waiting)) folders.push_back({waiting, false});
    std::ranges::reverse(folders);
    return folders;
}

std::vector<PaperFile> papers_in(const std::string& folder, const std::string& run) {
    std::vector<PaperFile> papers;
    const std::array<std::string, 4> names{"certificate.pdf", "certificate.json", "certificate.csv",
                                           run + std::string{run_file_ending}};
    for (const std::string& name : names) {
        const FileStamp stamp = stamp_of(folder + "/" + name);
        if (stamp.is_there()) papers.push_back({name, stamp.bytes});
    }
    return papers;
}

} // namespace axiscal
