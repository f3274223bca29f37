#include "drivers/link/file_link.hpp"

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>

namespace axiscal {
namespace {

class FileLink final : public ByteLink {
public:
    FileLink(BlockingFiles& files, std::shared_ptr<bool> taken, std::string folder)
        : files_{files}
        , taken_{std::move(taken)}
        , folder_{std::move(folder)} {}
    ~FileLink() override { *taken_ = false; }
    FileLink(const FileLink&) = delete;
    FileLink& operator=(const FileLink&) = delete;

    Task<Result<TimedBytes>> read_some(MonotonicTime /*deadline*/) override {
        std::string path = folder_ + "/" + name_;
        const auto file = co_await files_.read(std::move(path));
        if (!file) co_return tl::unexpected<Error>(file.error());
        const auto bytes = std::as_bytes(std::span{file->text});
        TimedBytes text{std::vector<std::byte>(bytes.begin(), bytes.end()), file->read_at};
        co_return text;
    }
    Task<Result<void>> write_all(std::vector<std::byte> bytes,
                                 MonotonicTime /*deadline*/) override {
        name_.clear();
        for (const std::byte byte : bytes)
            name_ += std::to_integer<char>(byte);
        co_return Result<void>{};
    }

private:
    BlockingFiles& files_;
    std::shared_ptr<bool> taken_;
    std::string folder_, name_;
};

} // namespace

std::unique_ptr<ByteLink> FileLinks::open(std::string folder) {
    auto reader = std::ranges::find_if(readers_, [](const Reader& one) { return !*one.taken; });
    if (reader == readers_.end()) {
        auto files = std::make_unique<BlockingFiles>(loop_);
        readers_.push_back({std::move(files), std::make_shared<bool>(false)});
        reader = std::prev(readers_.end());
    }
    *reader->taken = true;
    return std::make_unique<FileLink>(*reader->files, reader->taken, std::move(folder));
}

} // namespace axiscal
