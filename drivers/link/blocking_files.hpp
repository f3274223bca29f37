#pragma once
// Small files of sysfs whose reading may block for a second, on a thread of their own.

#include "drivers/scheduler.hpp"

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

namespace axiscal {

struct FileText {
    std::string text;
    MonotonicTime begun_at, read_at; ///< on the thread, around open and read
};

/// `read` is called on the loop and served on the thread, one file after the other. Construction
/// and destruction belong to the loop; destruction waits for the file in hand. It must be destroyed
/// before the loop is.
class BlockingFiles {
public:
    explicit BlockingFiles(boost::asio::any_io_executor loop);
    ~BlockingFiles();
    BlockingFiles(const BlockingFiles&) = delete;
    BlockingFiles& operator=(const BlockingFiles&) = delete;

    /// The first 4096 bytes.
    /// @errors Fault::not_found when there is no such file, Fault::io for any other failure.
    Task<Result<FileText>> read(std::string path);

private:
    struct Pending;
    void serve();
    std::shared_ptr<Pending> next_request();

    boost::asio::any_io_executor loop_;
    std::mutex mutex_; ///< guards requests_ and stopping_
    std::condition_variable wake_;
    std::deque<std::shared_ptr<Pending>> requests_; ///< shared with the waiting coroutine
    bool stopping_ = false;
    std::thread thread_;
};

} // namespace axiscal
