#include "acquisition/publish/folder_destination.hpp"

#include "acquisition/runfile/digest.hpp"
#include "acquisition/runfile/durable_file.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <sys/stat.h>
#include <unistd.h>

namespace axiscal {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t block = std::size_t{256} * 1024; // small enough for progress on a slow share

/// What a mounted share answers when it is gone, full or closed to writing: no other file would
/// fare better.
bool of_the_whole_share(int error) {
    constexpr std::array all{ENOSPC,    EDQUOT,       EROFS,        EIO,      ESTALE,     ETIMEDOUT,
                             EHOSTDOWN, EHOSTUNREACH, ENETUNREACH,  ENOTCONN, ECONNRESET, ENODEV,
                             EAGAIN,    ECONNABORTED, ECONNREFUSED, ENXIO,    EREMOTEIO};
    return std::ranges::find(all, error) != all.end();
}

tl::unexpected<Error>
share_fails(const std::string& what, const std::string& path, int error = errno) {
    if (of_the_whole_share(error)) return share_lost(what + " " + path, error);
    return fail_io(what, path, error);
}

/// The same judgement about errors that come from elsewhere.
Error judged(Error error) {
    if (error.fault == Fault::io && of_the_whole_share(error.cause.value()))
        return share_lost(std::move(error.detail), error.cause.value()).value();
    return error;
}

/// What rename to a free name and hard link answer where the file system has neither (rclone,
/// davfs2, vboxsf).
bool knows_no_such_call(const Error& error) {
    constexpr std::array all{EINVAL, ENOSYS, EPERM, EOPNOTSUPP, EMLINK};
    return error.fault == Fault::io && std::ranges::find(all, error.cause.value()) != all.end();
}

Result<void>
write_all(const FileHandle& to, const char* bytes, ssize_t size, const std::string& path) {
    for (ssize_t done = 0; done < size;) {
        const auto put = ::write(to.get(), bytes + done, static_cast<std::size_t>(size - done));
        if (put < 0 && errno == EINTR) continue;
        if (put < 0) return share_fails("cannot write", path);
        done += put;
    }
    return {};
}

Result<void> copy_bytes(const FileHandle& from,
                        const FileHandle& to,
                        const std::string& path,
                        const Progress& progress) {
    std::vector<char> buffer(block);
    for (;;) {
        const auto got = ::read(from.get(), buffer.data(), buffer.size());
        if (got == 0) return {};
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return fail_io("cannot read", "the outbox");
        AXISCAL_CHECK(write_all(to, buffer.data(), got, path));
        if (progress) progress();
    }
}

} // namespace

std::string FolderDestination::at(const std::string& path) const {
    return path.empty() ? root_ : root_ + "/" + path;
}

Result<void> FolderDestination::check_mount() const {
    if (const auto absent = absent_mount(root_, mounts_))
        return share_lost(absent_mount_text(*absent));
    return {};
}

Result<void> FolderDestination::check() {
    AXISCAL_CHECK(check_mount());
    std::error_code error;
    if (fs::is_directory(root_, error)) return try_refused_move();
    return share_lost("The destination " + root_ +
                      " is not there: mount the share, or make the folder where it belongs on "
                      "this PC's own disk");
}

Result<bool> FolderDestination::make_folder(const std::string& path) {
    AXISCAL_CHECK(check_mount());
    std::error_code error;
    if (fs::create_directory(at(path), error)) return true;
    std::error_code ignored;
    if (fs::exists(fs::symlink_status(at(path), ignored))) return false;
    return share_lost("cannot make " + at(path), error.value());
}

Result<std::vector<std::string>> FolderDestination::names_in(const std::string& folder) {
    std::error_code error;
    if (!fs::is_directory(at(folder), error) && !error)
        return fail(Fault::refused, at(folder) + " is no folder");
    std::vector<std::string> names;
    for (fs::directory_iterator one{at(folder), error}, end; !error && one != end;
         one.increment(error))
        names.push_back(one->path().filename().string());
    if (error) return share_fails("cannot read", at(folder), error.value());
    return names;
}

Result<std::string> FolderDestination::sha256_of(const std::string& path,
                                                 const Progress& progress) {
    std::error_code error;
    if (!fs::is_regular_file(fs::symlink_status(at(path), error)))
        return fail(Fault::refused, at(path) + " is no plain file");
    return sha256_of_file(at(path), progress).map_error(judged);
}

Result<std::string> FolderDestination::write_and_read_back(const std::string& source,
                                                           const std::string& path,
                                                           const Progress& progress) {
    const FileHandle from{::open(source.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC)};
    if (!from) return fail_io("cannot open", source);
    FileHandle to{
        ::open(at(path).c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0664)};
    if (!to) return share_fails("cannot create", at(path));
    AXISCAL_CHECK(copy_bytes(from, to, at(path), progress));
    if (::fsync(to.get()) != 0) return share_fails("cannot sync", at(path));
    // Best effort: what is read back should come from the share, not from this machine's memory.
    ::posix_fadvise(to.get(), 0, 0, POSIX_FADV_DONTNEED);
    if (!to.close()) return share_fails("the share did not take", at(path));
    return sha256_of_file(at(path), progress).map_error(judged);
}

Result<void> FolderDestination::move_to_free_name(const std::string& from, const std::string& to) {
    auto moved = axiscal::move_to_free_name(at(from), at(to)).map_error(judged);
    if (moved || !knows_no_such_call(moved.error())) return moved;
    return look_and_rename(from, to);
}

// Not by O_EXCL on the final name: an empty file would bear it for a while, and after a crash for
// ever. A program that makes the very name between look and rename loses its file. Nobody but this
// station makes names in the folder of its runs.
Result<void> FolderDestination::look_and_rename(const std::string& from, const std::string& to) {
    struct stat found {};
    if (::lstat(at(to).c_str(), &found) == 0)
        return fail(Fault::refused, at(to) + " exists already and is never overwritten");
    if (errno != ENOENT) return share_fails("cannot look for", at(to));
    if (::rename(at(from).c_str(), at(to).c_str()) == 0) return {};
    const int error = errno;
    if (of_the_whole_share(error)) return share_fails("cannot rename to", at(to), error);
    refused_ = Move{from, to};
    const auto kind = file_system_of(root_, mounts_);
    return share_lost("The file system of " + root_ + (kind.empty() ? "" : " (" + kind + ")") +
                          " lets no finished file take its name, neither by a rename nor by a "
                          "link: let axiscal-publish speak to the server itself, destination = "
                          "\"smb://server/share/folder\"",
                      error);
}

// A name that somebody took meanwhile, or a file that is gone, is the next copy's to see.
Result<void> FolderDestination::try_refused_move() {
    if (!refused_) return {};
    const Move move = *std::exchange(refused_, std::nullopt);
    struct stat found {};
    if (::lstat(at(move.from).c_str(), &found) != 0) return {};
    auto moved = move_to_free_name(move.from, move.to);
    if (!moved && moved.error().fault != Fault::refused) return moved;
    return {};
}

Result<void> FolderDestination::remove_file(const std::string& path) {
    if (::unlink(at(path).c_str()) != 0 && errno != ENOENT)
        return share_fails("cannot remove", at(path));
    return {};
}

// The root is synced last: before a receipt says so, it is still the share that has it all.
Result<void> FolderDestination::sync_folder(const std::string& path) {
    if (path.empty()) {
        AXISCAL_CHECK(check_mount());
    }
    return axiscal::sync_folder(at(path)).map_error(judged);
}

} // namespace axiscal
