#include "acquisition/publish/share.hpp"

#include "acquisition/journal/digest.hpp"
#include "acquisition/journal/durable_file.hpp"
#include "analysis/quantity/time.hpp"

#include <nlohmann/json.hpp>

#include <fcntl.h>
#include <filesystem>
#include <unistd.h>

namespace axiscal {
namespace {

namespace fs = std::filesystem;

constexpr int most_folders = 1000;                     // of one run id
constexpr std::size_t block = std::size_t{256} * 1024; // small enough for progress on a slow share

Result<std::vector<PublishedFile>> describe_files(const OutboxEntry& entry,
                                                  const Progress& progress) {
    std::vector<PublishedFile> files;
    for (const auto& name : entry.files) {
        const auto path = entry.folder + "/" + name;
        AXISCAL_TRY(auto hash, sha256_of_file(path, progress));
        std::error_code error;
        const auto bytes = fs::file_size(path, error);
        if (error) return fail_io("cannot read", path, error.value());
        files.push_back({name, std::move(hash), bytes});
    }
    if (files.empty()) return fail(Fault::refused, entry.folder + " holds nothing to publish");
    return files;
}

enum class Presence { absent, same, other };

Result<Presence>
presence_of(const PublishedFile& file, const std::string& folder, const Progress& progress) {
    const auto path = folder + "/" + file.name;
    std::error_code error;
    const auto status = fs::symlink_status(path, error);
    if (status.type() == fs::file_type::not_found) return Presence::absent;
    if (error) return fail_io("cannot look at", path, error.value());
    if (status.type() != fs::file_type::regular) return Presence::other;
    AXISCAL_TRY(const auto hash, sha256_of_file(path, progress));
    return hash == file.sha256 ? Presence::same : Presence::other;
}

/// The first folder of this run's names in which no file stands in the way; made if new.
Result<std::string> choose_folder(const OutboxEntry& entry,
                                  const std::vector<PublishedFile>& files,
                                  const std::string& destination,
                                  const Progress& progress) {
    for (int copy = 1; copy <= most_folders; ++copy) {
        auto folder = destination + "/" + entry.run_id;
        if (copy > 1) folder += "-" + std::to_string(copy);
        std::error_code error;
        fs::create_directory(folder, error);
        if (error && !fs::exists(folder)) return fail_io("cannot make", folder, error.value());
        bool fits = fs::is_directory(folder);
        for (const auto& file : files) {
            if (!fits) break;
            AXISCAL_TRY(const auto presence, presence_of(file, folder, progress));
            fits = presence != Presence::other;
        }
        if (fits) return folder;
    }
    return fail(Fault::refused, destination + " is full of other runs named " + entry.run_id);
}

Result<void> copy_bytes(const FileHandle& from, const FileHandle& to, const Progress& progress) {
    std::vector<char> buffer(block);
    for (;;) {
        const auto got = ::read(from.get(), buffer.data(), buffer.size());
        if (got == 0) return {};
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return fail_io("cannot read", "the outbox");
        for (ssize_t done = 0; done < got;) {
            const auto put =
                ::write(to.get(), buffer.data() + done, static_cast<std::size_t>(got - done));
            if (put < 0 && errno == EINTR) continue;
            if (put < 0) return fail_io("cannot write", "the share");
            done += put;
        }
        if (progress) progress();
    }
}

Result<void>
write_part(const std::string& source, const std::string& part, const Progress& progress) {
    const FileHandle from{::open(source.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC)};
    if (!from) return fail_io("cannot open", source);
    FileHandle to{
        ::open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0664)};
    if (!to) return fail_io("cannot write to the share:", part);
    if (auto copied = copy_bytes(from, to, progress); !copied)
        return fail(Fault::io, copied.error().detail + ": " + part, copied.error().cause);
    if (::fsync(to.get()) != 0) return fail_io("cannot sync", part);
    // Best effort: what is read back should come from the share, not from this machine's memory.
    ::posix_fadvise(to.get(), 0, 0, POSIX_FADV_DONTNEED);
    if (!to.close()) return fail_io("the share did not take", part);
    return {};
}

// Read back under the temporary name, so that no wrong byte ever bears the final one.
Result<void> copy_file(const OutboxEntry& entry,
                       const PublishedFile& file,
                       const std::string& folder,
                       const Progress& progress) {
    const auto part = folder + "/." + file.name + ".part";
    AXISCAL_CHECK(write_part(entry.folder + "/" + file.name, part, progress));
    AXISCAL_TRY(const auto read_back, sha256_of_file(part, progress));
    if (read_back != file.sha256)
        return fail(Fault::checksum, part + " came back from the share with other content");
    AXISCAL_CHECK(move_to_free_name(part, folder + "/" + file.name));
    return sync_folder(folder);
}

} // namespace

Result<void> check_destination(const std::string& destination) {
    std::error_code error;
    if (fs::is_directory(destination, error)) return {};
    return fail(Fault::io, "the destination " + destination +
                               " is not there: mount the share or make the folder; results wait "
                               "in the outbox");
}

Result<PublishReceipt> copy_entry(const OutboxEntry& entry,
                                  const std::string& destination,
                                  std::int64_t utc_ns,
                                  const Progress& progress) {
    AXISCAL_CHECK(check_destination(destination));
    AXISCAL_TRY(auto files, describe_files(entry, progress));
    AXISCAL_TRY(auto folder, choose_folder(entry, files, destination, progress));
    for (const auto& file : files) {
        AXISCAL_TRY(const auto presence, presence_of(file, folder, progress));
        if (presence == Presence::absent) AXISCAL_CHECK(copy_file(entry, file, folder, progress));
        std::error_code ignored; // a stale part of ours; not worth failing a complete file
        fs::remove(folder + "/." + file.name + ".part", ignored);
    }
    AXISCAL_CHECK(sync_folder(destination));
    return PublishReceipt{entry.run_id, std::move(folder), iso8601_utc(utc_ns), std::move(files)};
}

std::string receipt_json(const PublishReceipt& receipt) {
    nlohmann::ordered_json document{{"format", "axiscal.receipt/1"},
                                    {"run_id", receipt.run_id},
                                    {"published_utc", receipt.published_utc},
                                    {"folder", receipt.folder},
                                    {"files", nlohmann::ordered_json::array()}};
    for (const auto& file : receipt.files)
        document["files"].push_back(
            {{"name", file.name}, {"bytes", file.bytes}, {"sha256", file.sha256}});
    return document.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

Result<void> write_receipt(const OutboxEntry& entry, const PublishReceipt& receipt) {
    const auto unfinished = entry.folder + "/.receipt.part";
    const auto final_name = entry.folder + "/" + std::string{receipt_file_name};
    AXISCAL_CHECK(write_synced(unfinished, receipt_json(receipt) + "\n"));
    AXISCAL_CHECK(move_to_free_name(unfinished, final_name));
    return sync_folder(entry.folder);
}

} // namespace axiscal
