#pragma once
// Files that are on disk when the call returns, and names that are taken once. Thread-safe: no
// state. Every error is Fault::io with the path and the system's word.

#include "analysis/quantity/result.hpp"

#include <cerrno>
#include <cstddef>
#include <string>
#include <string_view>
#include <sys/types.h>
#include <system_error>

namespace axiscal {

/// Owns one file descriptor.
class FileHandle {
public:
    explicit FileHandle(int descriptor)
        : descriptor_{descriptor} {}
    ~FileHandle();
    FileHandle(const FileHandle&) = delete;
    FileHandle& operator=(const FileHandle&) = delete;
    FileHandle(FileHandle&& other) noexcept
        : descriptor_{std::exchange(other.descriptor_, -1)} {}
    FileHandle& operator=(FileHandle&&) = delete;
    explicit operator bool() const { return descriptor_ >= 0; }
    [[nodiscard]] int get() const { return descriptor_; }
    /// Closes now; a share reports a failed write here at the latest.
    [[nodiscard]] bool close();

private:
    int descriptor_;
};

/// Fault::io: "<what> <path>" with errno as cause.
tl::unexpected<Error> fail_io(std::string_view what, const std::string& path, int error = errno);

/// How much of a file to read at once: all that it says it holds, from 4 KiB (a file of /proc says
/// 0) to 1 MiB. A buffer that is larger than the file costs its zeroing, page by page.
std::size_t block_for(const FileHandle& file);

Result<void> sync_file(const std::string& path);
/// Makes names in the folder durable. A share that cannot sync folders (EINVAL) is no error.
Result<void> sync_folder(const std::string& path);
/// Creates or replaces the content, synced; the name itself needs sync_folder.
Result<void> write_synced(const std::string& path, std::string_view content);
/// Creates or replaces the file in one step, synced with its name: whoever opens it finds the whole
/// content, or the one before; on failure nothing is left of the new one. A link stays a link. What
/// is no plain file (a terminal, /dev/stdout) is written to.
Result<void> replace_synced(const std::string& path, std::string_view content);
/// The same for a file that few may read: it has `mode` from the first moment, whatever was there
/// had, and a link of its name is replaced, not followed.
Result<void> put_synced(const std::string& path, std::string_view content, mode_t mode);
/// May files grow in this folder? Writes and syncs as much as a run file needs to be gone on with,
/// and removes it.
Result<void> try_folder(const std::string& folder);
/// Gives an empty file this length in zeros, synced, so that what is written over them needs no new
/// blocks. Where they do not fit, or it is not empty, it stays as it was.
void reserve_zeros(const std::string& path, std::size_t bytes);
/// Renames a file or folder to a name that must be free. @errors Fault::refused if it is taken.
Result<void> move_to_free_name(const std::string& from, const std::string& to);
/// What a person can do about an error of the disk that carries `folder`; empty where the system's
/// word says all there is.
std::string way_out(const std::error_code& cause, const std::string& folder);
/// Folder part of a path; "." when there is none.
std::string folder_of(const std::string& path);

} // namespace axiscal
