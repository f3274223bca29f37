#include "drivers/wire/file_link.hpp"

#include "drivers/loop/asio_scheduler.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fcntl.h>
#include <iterator>
#include <unistd.h>
#include <utility>

namespace axiscal {
namespace {

tl::unexpected<Error> failed(const std::string& path, int error_number) {
    const bool missing = error_number == ENOENT || error_number == ENODEV || error_number == ENXIO;
    return fail(missing ? Fault::not_found : Fault::io, path,
                std::error_code{error_number, std::generic_category()});
}

Result<TimedBytes> read_file(const std::string& path) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return failed(path, errno);
    std::array<std::byte, 4096> buffer{};
    const ssize_t count = ::read(descriptor, buffer.data(), buffer.size());
    const int error_number = errno;
    ::close(descriptor);
    if (count < 0) return failed(path, error_number);
    return TimedBytes{std::vector<std::byte>(buffer.begin(), buffer.begin() + count),
                      monotonic_now()};
}

class FileLink final : public ByteLink {
public:
    FileLink(std::shared_ptr<WorkThread> thread,
             boost::asio::any_io_executor loop,
             std::shared_ptr<bool> taken,
             std::string folder)
        : thread_{std::move(thread)}
        , loop_{std::move(loop)}
        , taken_{std::move(taken)}
        , folder_{std::move(folder)} {}
    ~FileLink() override { *taken_ = false; }
    FileLink(const FileLink&) = delete;
    FileLink& operator=(const FileLink&) = delete;

    Task<Result<TimedBytes>> read_some(MonotonicTime /*deadline*/) override {
        std::function<Result<TimedBytes>()> job = [path = folder_ + "/" + name_] {
            return read_file(path);
        };
        return on_thread<TimedBytes>(thread_, loop_, std::move(job));
    }
    Task<Result<void>> write_all(std::vector<std::byte> bytes,
                                 MonotonicTime /*deadline*/) override {
        name_.clear();
        for (const std::byte byte : bytes)
            name_ += std::to_integer<char>(byte);
        co_return Result<void>{};
    }

private:
    std::shared_ptr<WorkThread> thread_;
    boost::asio::any_io_executor loop_;
    std::shared_ptr<bool> taken_;
    std::string folder_, name_;
};

} // namespace

FileLinks::~FileLinks() {
    for (const Reader& reader : readers_)
        reader.thread->finish();
    for (const Reader& reader : readers_)
        reader.thread->join();
}

std::unique_ptr<ByteLink> FileLinks::open(std::string folder) {
    auto reader = std::ranges::find_if(readers_, [](const Reader& one) { return !*one.taken; });
    if (reader == readers_.end()) {
        readers_.push_back({std::make_shared<WorkThread>(), std::make_shared<bool>(false)});
        reader = std::prev(readers_.end());
    }
    *reader->taken = true;
    return std::make_unique<FileLink>(reader->thread, loop_, reader->taken, std::move(folder));
}

} // namespace axiscal
