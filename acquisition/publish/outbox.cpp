#include "acquisition/publish/outbox.hpp"

#include "acquisition/journal/durable_file.hpp"

#include <algorithm>
#include <filesystem>

namespace axiscal {
namespace {

namespace fs = std::filesystem;

constexpr int most_same_names = 1000; // more of one run id is a fault of the caller

Result<void> check_run_id(const std::string& run_id) {
    constexpr std::string_view allowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                         "0123456789._-";
    const bool plain = !run_id.empty() && run_id.size() <= 200 && run_id.front() != '.' &&
                       run_id.find_first_not_of(allowed) == std::string::npos;
    if (plain) return {};
    return fail(Fault::bad_request, "run id \"" + run_id +
                                        "\" cannot be a folder's name: letters, digits, . _ - "
                                        "only, not beginning with a dot");
}

std::string staging_folder(const std::string& outbox, const std::string& run_id) {
    return outbox + "/." + run_id + ".staging";
}

Result<std::vector<fs::path>> plain_files_of(const std::string& folder) {
    std::error_code error;
    std::vector<fs::path> files;
    for (fs::directory_iterator at{folder, error}, end; !error && at != end; at.increment(error)) {
        if (fs::symlink_status(at->path(), error).type() != fs::file_type::regular)
            return fail(Fault::refused, at->path().string() + " is no plain file: remove it");
        files.push_back(at->path());
    }
    if (error) return fail_io("cannot read", folder, error.value());
    std::ranges::sort(files);
    return files;
}

} // namespace

Result<std::string> begin_entry(const std::string& outbox, const std::string& run_id) {
    AXISCAL_CHECK(check_run_id(run_id));
    const auto staging = staging_folder(outbox, run_id);
    std::error_code error;
    fs::remove_all(staging, error);
    if (!error) fs::create_directories(staging, error);
    if (error) return fail_io("cannot make", staging, error.value());
    return staging;
}

Result<std::string> finish_entry(const std::string& outbox, const std::string& run_id) {
    AXISCAL_CHECK(check_run_id(run_id));
    const auto staging = staging_folder(outbox, run_id);
    AXISCAL_TRY(const auto files, plain_files_of(staging));
    for (const auto& file : files)
        AXISCAL_CHECK(sync_file(file.string()));
    AXISCAL_CHECK(sync_folder(staging));
    auto folder = outbox + "/" + run_id;
    AXISCAL_CHECK(move_to_free_name(staging, folder));
    AXISCAL_CHECK(sync_folder(outbox));
    return folder;
}

Result<std::string> stage_entry(const std::string& outbox,
                                const std::string& run_id,
                                const std::vector<OutboxFile>& files) {
    AXISCAL_TRY(const auto staging, begin_entry(outbox, run_id));
    for (const auto& [name, content] : files)
        AXISCAL_CHECK(write_synced((fs::path{staging} / name).string(), content));
    return finish_entry(outbox, run_id);
}

Result<OutboxEntry> read_entry(const std::string& outbox, const std::string& run_id) {
    OutboxEntry entry{run_id, outbox + "/" + run_id, {}, false};
    std::error_code error;
    if (!fs::is_directory(entry.folder, error))
        return fail(Fault::not_found, "no entry " + entry.folder);
    AXISCAL_TRY(const auto files, plain_files_of(entry.folder));
    for (const auto& file : files) {
        const auto name = file.filename().string();
        if (name == receipt_file_name) entry.has_receipt = true;
        if (name != receipt_file_name && name.front() != '.') entry.files.push_back(name);
    }
    return entry;
}

std::vector<std::string> entry_names(const std::string& outbox) {
    std::vector<std::string> names;
    std::error_code error;
    for (fs::directory_iterator at{outbox, error}, end; !error && at != end; at.increment(error)) {
        auto name = at->path().filename().string();
        if (name.front() != '.' && at->is_directory(error)) names.push_back(std::move(name));
    }
    std::ranges::sort(names);
    return names;
}

std::vector<OutboxEntry> list_entries(const std::string& outbox) {
    std::vector<OutboxEntry> entries;
    for (const auto& name : entry_names(outbox)) {
        auto entry = read_entry(outbox, name);
        entries.push_back(entry ? *std::move(entry)
                                : OutboxEntry{name, (fs::path{outbox} / name).string(), {}, false});
    }
    return entries;
}

Result<std::string> archive_entry(const OutboxEntry& entry) {
    if (!entry.has_receipt)
        return fail(Fault::refused, entry.folder + " has no receipt and stays where it is");
    const auto outbox = fs::path{entry.folder}.parent_path();
    const auto published = (outbox.parent_path() / "published").string();
    std::error_code error;
    fs::create_directories(published, error);
    if (error) return fail_io("cannot make", published, error.value());
    for (int copy = 1; copy <= most_same_names; ++copy) {
        auto place = published + "/" + entry.run_id;
        if (copy > 1) place += "-" + std::to_string(copy);
        if (fs::exists(place, error)) continue;
        AXISCAL_CHECK(move_to_free_name(entry.folder, place));
        return place;
    }
    return fail(Fault::refused, published + " is full of " + entry.run_id);
}

Result<void> sync_outbox(const std::string& outbox) {
    AXISCAL_CHECK(sync_folder((fs::path{outbox}.parent_path() / "published").string()));
    return sync_folder(outbox);
}

} // namespace axiscal
