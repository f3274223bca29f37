#pragma once
// Files of the kernel (sysfs) as a link: a write names the file below a folder, the next read gives
// its text. Loop-bound; reading one may block for a second, so it is done on a thread.

#include "drivers/loop/work_thread.hpp"
#include "drivers/wire/byte_link.hpp"

#include <memory>
#include <string>
#include <vector>

namespace axiscal {

/// Links of files, one thread for each that is open at the same time. Construction and destruction
/// belong to the loop; destruction waits for the files in hand. It must be destroyed before the
/// loop is; its links may be destroyed later, but not be used.
class FileLinks {
public:
    explicit FileLinks(boost::asio::any_io_executor loop)
        : loop_{std::move(loop)} {}
    ~FileLinks();
    FileLinks(const FileLinks&) = delete;
    FileLinks& operator=(const FileLinks&) = delete;

    /// Opens nothing yet: whether a file is there is told by its reading. A text may be empty, and
    /// has 4096 bytes at most. The kernel cannot be hurried: a deadline does not end a reading.
    /// @errors of read_some: Fault::not_found when there is no such file, io for any other failure.
    std::unique_ptr<ByteLink> open(std::string folder);

private:
    struct Reader {
        std::shared_ptr<WorkThread> thread;
        std::shared_ptr<bool> taken; ///< by a link, which gives it back
    };
    boost::asio::any_io_executor loop_;
    std::vector<Reader> readers_;
};

} // namespace axiscal
