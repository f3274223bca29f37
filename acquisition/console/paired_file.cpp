#include "acquisition/console/paired_file.hpp"

#include "acquisition/console/paired_text.hpp"
#include "acquisition/runfile/durable_file.hpp"

#include <cerrno>
#include <fcntl.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

namespace axiscal {
namespace {

constexpr mode_t mode_of_paired = 0600;

tl::unexpected<Error> refuse_paired(const std::string& path, const std::string& why) {
    return fail(Fault::refused, "the file of paired browsers " + path + " " + why +
                                    ". No browser is paired; 'axiscal pair' pairs one and writes "
                                    "the file anew");
}

/// Whether nobody but the service can have put a browser there.
bool is_private(const struct stat& found) {
    return S_ISREG(found.st_mode) && (found.st_mode & 07777U & ~mode_of_paired) == 0 &&
           (found.st_uid == ::geteuid() || found.st_uid == 0);
}

/// One byte more than fits means too much.
Result<std::string> whole_text(const FileHandle& file, const std::string& path) {
    constexpr std::size_t enough = 8192; // 16 lines of 190 bytes
    std::string text(enough, '\0');
    std::size_t filled = 0;
    while (filled < enough) {
        const auto got = ::read(file.get(), text.data() + filled, enough - filled);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return fail_io("cannot read", path);
        if (got == 0) break;
        filled += static_cast<std::size_t>(got);
    }
    text.resize(filled);
    return text;
}

} // namespace

bool random_bytes(std::span<std::uint8_t> bytes) {
    while (!bytes.empty()) {
        const auto got = ::getrandom(bytes.data(), bytes.size(), 0);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return false;
        bytes = bytes.subspan(static_cast<std::size_t>(got));
    }
    return true;
}

Result<std::vector<PairedBrowser>> read_paired(const std::string& path) {
    // Not to wait for the other end of a pipe that somebody made there.
    const FileHandle file{::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC)};
    if (!file && errno == ENOENT) return std::vector<PairedBrowser>{};
    if (!file && errno == ELOOP) return refuse_paired(path, "is a link");
    if (!file) return fail_io("cannot open the file of paired browsers", path);
    struct stat found {};
    if (::fstat(file.get(), &found) != 0) return fail_io("cannot look at", path);
    if (!is_private(found))
        return refuse_paired(path, "is not a plain file of the service's own with mode 0600");
    AXISCAL_TRY(const std::string text, whole_text(file, path));
    auto paired = paired_of_text(text);
    if (!paired) return refuse_paired(path, "is damaged: " + paired.error().detail);
    return paired;
}

Result<void> write_paired(const std::string& path, const std::vector<PairedBrowser>& paired) {
    return put_synced(path, paired_text(paired), mode_of_paired);
}

} // namespace axiscal
