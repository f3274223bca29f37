#include "acquisition/runfile/durable_file.hpp"

#include <algorithm>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <sys/stat.h>
#include <unistd.h>

namespace axiscal {

FileHandle::~FileHandle() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

bool FileHandle::close() {
    return ::close(std::exchange(descriptor_, -1)) == 0;
}

tl::unexpected<Error> fail_io(std::string_view what, const std::string& path, int error) {
    return fail(Fault::io, std::string{what} + " " + path,
                std::error_code{error, std::generic_category()});
}

std::size_t block_for(const FileHandle& file) {
    constexpr off_t least = 4096, most = 1 << 20;
    struct stat found {};
    if (::fstat(file.get(), &found) != 0) return most;
    return static_cast<std::size_t>(std::clamp(found.st_size, least, most));
}

Result<void> sync_file(const std::string& path) {
    const FileHandle file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
    if (!file || ::fsync(file.get()) != 0) return fail_io("cannot sync", path);
    return {};
}

Result<void> sync_folder(const std::string& path) {
    const FileHandle folder{::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)};
    if (!folder) return fail_io("cannot open folder", path);
    if (::fsync(folder.get()) != 0 && errno != EINVAL && errno != ENOTSUP)
        return fail_io("cannot sync folder", path);
    return {};
}

void reserve_zeros(const std::string& path, std::size_t bytes) {
    const FileHandle file{::open(path.c_str(), O_WRONLY | O_CLOEXEC)};
    struct stat found {};
    if (!file || ::fstat(file.get(), &found) != 0 || found.st_size != 0) return;
    // Not posix_fallocate: a block that was never written costs the file system's journal a commit
    // when it is.
    const std::string zeros(bytes, '\0');
    const bool whole = ::write(file.get(), zeros.data(), bytes) == static_cast<ssize_t>(bytes) &&
                       ::fdatasync(file.get()) == 0;
    if (!whole && ::ftruncate(file.get(), 0) != 0) return; // the next writer meets the disk's error
}

namespace {

Result<void> write_all(FileHandle& file, const std::string& path, std::string_view content) {
    while (!content.empty()) {
        const auto written = ::write(file.get(), content.data(), content.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return fail_io("cannot write", path);
        content.remove_prefix(static_cast<std::size_t>(written));
    }
    if (::fsync(file.get()) != 0) return fail_io("cannot sync", path);
    if (!file.close()) return fail_io("cannot close", path);
    return {};
}

} // namespace

Result<void> write_synced(const std::string& path, std::string_view content) {
    FileHandle file{::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0664)};
    if (!file) return fail_io("cannot create", path);
    return write_all(file, path, content);
}

Result<void> put_synced(const std::string& path, std::string_view content, mode_t mode) {
    const std::string unfinished = path + ".new";
    ::unlink(unfinished.c_str());
    FileHandle file{
        ::open(unfinished.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode)};
    if (!file) return fail_io("cannot create", unfinished);
    AXISCAL_CHECK(write_all(file, unfinished, content));
    if (::rename(unfinished.c_str(), path.c_str()) != 0) return fail_io("cannot rename to", path);
    return sync_folder(folder_of(path));
}

namespace {

/// Where a new content is put together: beside the file itself, whatever links lead there.
std::string name_beside(const std::filesystem::path& file) {
    return (file.parent_path() / ("." + file.filename().string() + ".new")).string();
}

/// The file itself, there or not: a link to a disk that is not mounted leads somewhere, too.
std::filesystem::path end_of_links(std::filesystem::path path) {
    constexpr int most = 40; // as the kernel's
    std::error_code none;
    for (int i = 0; i < most && std::filesystem::is_symlink(path, none); ++i)
        path = path.parent_path() / std::filesystem::read_symlink(path, none);
    return path;
}

Result<void> write_through(const std::string& path, std::string_view content) {
    std::ofstream stream{path, std::ios::binary};
    if (stream << content << std::flush) return {};
    return fail_io("cannot write", path);
}

} // namespace

Result<void> replace_synced(const std::string& path, std::string_view content) {
    std::error_code ignored;
    const auto found = std::filesystem::status(path, ignored);
    if (std::filesystem::exists(found) && !std::filesystem::is_regular_file(found))
        return write_through(path, content);
    const std::filesystem::path file = end_of_links(path);
    const std::string unfinished = name_beside(file);
    const auto written = write_synced(unfinished, content);
    if (written && ::rename(unfinished.c_str(), file.c_str()) == 0)
        return sync_folder(folder_of(file.string()));
    const int reason = written ? errno : written.error().cause.value();
    ::unlink(unfinished.c_str());
    return fail_io("cannot write", path, reason);
}

Result<void> try_folder(const std::string& folder) {
    constexpr std::size_t enough = 262'144; // index and first pages of a WAL, with some to spare
    const std::string path = folder + "/.trial.axiscal.new"; // swept by tidy_run_files
    auto written = write_synced(path, std::string(enough, 'x'));
    ::unlink(path.c_str());
    return written;
}

Result<void> move_to_free_name(const std::string& from, const std::string& to) {
    if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return {};
    if (errno == EEXIST)
        return fail(Fault::refused, to + " exists already and is never overwritten");
    if (errno != EINVAL && errno != ENOSYS) return fail_io("cannot rename to", to);
    // A file system without this rename (NFS): a hard link never replaces either.
    if (::link(from.c_str(), to.c_str()) != 0) return fail_io("cannot take the name", to);
    if (::unlink(from.c_str()) != 0) return fail_io("cannot remove", from);
    return {};
}

std::string way_out(const std::error_code& cause, const std::string& folder) {
    if (cause == std::errc::no_space_on_device || cause.value() == EDQUOT) {
        std::error_code unknown;
        const auto space = std::filesystem::space(folder, unknown);
        constexpr std::uintmax_t mb = 1'000'000;
        return "The disk of " + folder + " is full" +
               (unknown ? "" : " (" + std::to_string(space.available / mb) + " MB are free)") +
               ": free some 100 MB there; runs under published have been copied to the share and "
               "may "
               "go.";
    }
    if (cause == std::errc::read_only_file_system || cause == std::errc::permission_denied)
        return folder + " cannot be written: mount its disk for writing, and let it belong to the "
                        "user of axiscald.";
    if (cause == std::errc::io_error)
        return "The disk of " + folder +
               " reports an error of its own (see dmesg): copy the runs to another one.";
    return {};
}

std::string folder_of(const std::string& path) {
    const auto folder = std::filesystem::path{path}.parent_path().string();
    return folder.empty() ? "." : folder;
}

} // namespace axiscal
