#include "drivers/link/blocking_files.hpp"

#include "drivers/asio_scheduler.hpp"

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>

#include <array>
#include <cerrno>
#include <fcntl.h>
#include <optional>
#include <unistd.h>

namespace axiscal {
namespace {

tl::unexpected<Error> failed(const std::string& path, int error_number) {
    const bool missing = error_number == ENOENT || error_number == ENODEV || error_number == ENXIO;
    return fail(missing ? Fault::not_found : Fault::io, path,
                std::error_code{error_number, std::generic_category()});
}

Result<FileText> read_file(const std::string& path) {
    FileText file;
    file.begun_at = monotonic_now();
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return failed(path, errno);
    std::array<char, 4096> buffer{};
    const ssize_t count = ::read(descriptor, buffer.data(), buffer.size());
    const int error_number = errno;
    ::close(descriptor);
    if (count < 0) return failed(path, error_number);
    file.read_at = monotonic_now();
    file.text.assign(buffer.data(), static_cast<std::size_t>(count));
    return file;
}

} // namespace

struct BlockingFiles::Pending {
    Pending(std::string of, const boost::asio::any_io_executor& loop)
        : path{std::move(of)}
        , done{loop, boost::asio::steady_timer::time_point::max()} {}
    std::string path;
    boost::asio::steady_timer done; ///< cancelled when the answer is there
    std::optional<Result<FileText>> answer;
};

BlockingFiles::BlockingFiles(boost::asio::any_io_executor loop)
    : loop_{std::move(loop)}
    , thread_{&BlockingFiles::serve, this} {}

BlockingFiles::~BlockingFiles() {
    {
        const std::lock_guard lock{mutex_};
        stopping_ = true;
    }
    wake_.notify_all();
    thread_.join();
}

Task<Result<FileText>> BlockingFiles::read(std::string path) {
    const auto pending = std::make_shared<Pending>(std::move(path), loop_);
    {
        const std::lock_guard lock{mutex_};
        requests_.push_back(pending);
    }
    wake_.notify_all();
    co_await pending->done.async_wait(boost::asio::as_tuple(boost::asio::use_awaitable));
    if (!pending->answer) co_return fail(Fault::io, "given up: " + pending->path);
    co_return *std::move(pending->answer);
}

std::shared_ptr<BlockingFiles::Pending> BlockingFiles::next_request() {
    std::unique_lock lock{mutex_};
    wake_.wait(lock, [this] { return stopping_ || !requests_.empty(); });
    if (stopping_) return nullptr;
    auto pending = std::move(requests_.front());
    requests_.pop_front();
    return pending;
}

void BlockingFiles::serve() {
    while (auto pending = next_request()) {
        auto answer = read_file(pending->path);
        // The last reference goes with the handler: timers die on the loop.
        boost::asio::post(loop_,
                          [pending = std::move(pending), answer = std::move(answer)]() mutable {
                              pending->answer = std::move(answer);
                              pending->done.cancel();
                          });
    }
}

} // namespace axiscal
