#pragma once
// The papers of a run where they lie: outbox/NAME until the share has them, then published/NAME.
// Blocking calls: a WorkThread makes them, for "published" may lead to another disk.

#include "analysis/quantity/result.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace axiscal {

/// What tells whether a file is the one that was read before.
struct FileStamp {
    std::int64_t changed_ns = 0, bytes = -1; ///< -1: no plain file is there
    std::uint64_t number = 0; ///< of the inode: a new file may have the old one's time
    bool operator==(const FileStamp&) const = default;
    [[nodiscard]] bool is_there() const { return bytes >= 0; }
};
/// Without opening it. A link at the end of the path is no plain file.
FileStamp stamp_of(const std::string& path);

/// @errors Fault::not_found where no plain file is there; Fault::refused beyond `most` bytes;
/// Fault::io. The path is not told: the answer goes to whoever asks.
Result<std::string> read_whole(const std::string& path, std::size_t most);

/// A folder that may hold the certificate.
struct PaperFolder {
    std::string path;
    bool published = false; ///< else it waits in the outbox
};
/// Where the certificate called `name` (certificate_name()) may lie, the one to be preferred first:
/// outbox, then published and its later copies ("NAME-3" before "NAME-2" before "NAME"). Only those
/// with a certificate.json.
std::vector<PaperFolder> paper_folders(const std::string& state_directory, const std::string& name);

/// A file that a client may have.
struct PaperFile {
    std::string name; ///< certificate.pdf | certificate.json | certificate.csv | RUN.axiscal
    std::int64_t bytes = 0;
};
/// Those that are there, in this order. @param run  its id: the copy of the run file has its name
std::vector<PaperFile> papers_in(const std::string& folder, const std::string& run);

} // namespace axiscal
