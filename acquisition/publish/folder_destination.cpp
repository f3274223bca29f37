#include "acquisition/publish/folder_destination.hpp"

#include "acquisition/journal/digest.hpp"
#include "acquisition/journal/durable_file.hpp"

#include <algorithm>
#include <array>
#include <fcntl.h>
#include <filesystem>
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

Result<void> FolderDestination::check() {
    std::error_code error;
    if (fs::is_directory(root_, error)) return {};
    return share_lost("The destination " + root_ +
                      " is not there: mount the share or make the folder");
}

Result<bool> FolderDestination::make_folder(const std::string& path) {
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
    if (!to) return share_fails("cannot write to the share:", at(path));
    AXISCAL_CHECK(copy_bytes(from, to, at(path), progress));
    if (::fsync(to.get()) != 0) return share_fails("cannot sync", at(path));
    // Best effort: what is read back should come from the share, not from this machine's memory.
    ::posix_fadvise(to.get(), 0, 0, POSIX_FADV_DONTNEED);
    if (!to.close()) return share_fails("the share did not take", at(path));
    return sha256_of_file(at(path), progress).map_error(judged);
}

Result<void> FolderDestination::move_to_free_name(const std::string& from, const std::string& to) {
    return axiscal::move_to_free_name(at(from), at(to)).map_error(judged);
}

Result<void> FolderDestination::remove_file(const std::string& path) {
    if (::unlink(at(path).c_str()) != 0 && errno != ENOENT)
        return share_fails("cannot remove", at(path));
    return {};
}

Result<void> FolderDestination::sync_folder(const std::string& path) {
    return axiscal::sync_folder(at(path)).map_error(judged);
}

} // namespace axiscal
