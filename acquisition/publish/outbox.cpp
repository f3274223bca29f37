#include "acquisition/publish/outbox.hpp"

#include "acquisition/runfile/digest.hpp"
#include "acquisition/publish/folder_destination.hpp"

#include <algorithm>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <sys/file.h>

namespace axiscal {
namespace {

namespace fs = std::filesystem;

constexpr int most_same_names = 1000; // more of one run id is a fault of the caller
constexpr std::string_view moved_ending = ".moved";

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

std::string numbered(const std::string& path, int copy) {
    return copy > 1 ? path + "-" + std::to_string(copy) : path;
}

/// An entry on its way to an archive on another disk, where no rename leads.
struct Removal {
    const OutboxEntry& entry;
    std::string published;
    std::vector<fs::path> files; ///< of the entry, the receipt among them
    const Progress& progress;
};

/// What an earlier try brought there before it was cut off.
Result<bool> is_copy(const Removal& removal, const std::string& place) {
    for (const auto& file : removal.files) {
        const auto there = (fs::path{place} / file.filename()).string();
        std::error_code ignored;
        if (!fs::is_regular_file(there, ignored)) return false;
        AXISCAL_TRY(const auto here_hash, sha256_of_file(file.string(), removal.progress));
        AXISCAL_TRY(const auto there_hash, sha256_of_file(there, removal.progress));
        if (here_hash != there_hash) return false;
    }
    return true;
}

Result<void> copy_compared(const Removal& removal, const std::string& growing) {
    FolderDestination folder{growing};
    for (const auto& file : removal.files) {
        AXISCAL_TRY(const auto wanted, sha256_of_file(file.string(), removal.progress));
        AXISCAL_TRY(const auto got, folder.write_and_read_back(
                                        file.string(), file.filename().string(), removal.progress));
        if (got != wanted)
            return fail(Fault::checksum, growing + " came back from its disk with other content");
    }
    return sync_folder(growing);
}

// Plain renames of folders: none replaces a folder that holds anything, and a disk need know no
// other one.
Result<void> rename_folder(const std::string& from, const std::string& to) {
    if (::rename(from.c_str(), to.c_str()) != 0) return fail_io("cannot rename to", to);
    return {};
}

Result<void> grow_copy(const Removal& removal, const std::string& place) {
    const auto growing = removal.published + "/." + removal.entry.run_id + ".part";
    std::error_code error;
    fs::remove_all(growing, error); // half of an earlier try
    if (!error) fs::create_directory(growing, error);
    if (error) return fail_io("cannot make", growing, error.value());
    AXISCAL_CHECK(copy_compared(removal, growing));
    return rename_folder(growing, place);
}

/// @returns where the whole entry lies, perhaps since an earlier try.
Result<std::string> bring_over(const Removal& removal) {
    for (int copy = 1; copy <= most_same_names; ++copy) {
        auto place = numbered(removal.published + "/" + removal.entry.run_id, copy);
        std::error_code error;
        if (!fs::exists(place, error)) {
            AXISCAL_CHECK(grow_copy(removal, place));
            return place;
        }
        AXISCAL_TRY(const bool whole, is_copy(removal, place));
        if (whole) return place;
    }
    return fail(Fault::refused, removal.published + " is full of " + removal.entry.run_id);
}

/// Folders that left the outbox by name. Listed before the sync, so that whatever goes had its
/// rename on disk, also that of an upload worker; what does not go now goes with the next one.
Result<void> sweep_moved(const std::string& outbox) {
    std::vector<fs::path> moved;
    std::error_code error;
    for (fs::directory_iterator at{outbox, error}, end; !error && at != end; at.increment(error)) {
        const auto name = at->path().filename().string();
        if (name.starts_with('.') && name.ends_with(moved_ending)) moved.push_back(at->path());
    }
    AXISCAL_CHECK(sync_folder(outbox));
    for (const auto& folder : moved)
        fs::remove_all(folder, error);
    return {};
}

// By one rename: an entry is there with all its files or not at all.
Result<void> drop_entry(const OutboxEntry& entry) {
    const auto outbox = fs::path{entry.folder}.parent_path().string();
    AXISCAL_CHECK(sweep_moved(outbox)); // the name may be taken since an earlier try
    AXISCAL_CHECK(
        rename_folder(entry.folder, outbox + "/." + entry.run_id + std::string{moved_ending}));
    static_cast<void>(sweep_moved(outbox)); // it is moved, whatever is left to sweep
    return {};
}

/// A full disk of the archive holds up no other result on its way to the share.
Error of_the_archive(const Error& error) {
    return {error.fault, "it is on the share but cannot move to published: " + error.detail,
            error.cause};
}

/// An archive on a disk of its own that is not mounted is an empty folder, or a link to nothing. A
/// mount that the outbox misses, too, is not asked for: moving beside it makes nothing worse.
Result<void>
make_archive(const fs::path& outbox, const std::string& published, const MountPlaces& mounts) {
    std::error_code error;
    const auto link = fs::read_symlink(published, error);
    const auto leads_to = error ? fs::path{published} : outbox.parent_path() / link;
    const auto absent = absent_mount(leads_to.string(), mounts);
    if (absent && !absent_mount(outbox.string(), mounts))
        return fail(Fault::io, not_mounted_text(*absent));
    if (!error && !fs::exists(published, error))
        return fail(Fault::io, published + " is a link to " + link.string() +
                                   ", which is not there: mount that disk or make the folder");
    fs::create_directories(published, error);
    if (error) return fail_io("cannot make", published, error.value());
    return {};
}

Result<std::string>
move_over_disks(const OutboxEntry& entry, const std::string& published, const Progress& progress) {
    AXISCAL_TRY(auto files, plain_files_of(entry.folder));
    AXISCAL_TRY(auto place, bring_over({entry, published, std::move(files), progress}));
    AXISCAL_CHECK(sync_folder(published));
    AXISCAL_CHECK(drop_entry(entry));
    return place;
}

/// The folder itself stays: a station that starts knows by it that a certificate is still to be
/// made, and may be killed here once more.
Result<void> empty_folder(const std::string& folder) {
    std::error_code error;
    for (fs::directory_iterator left{folder, error}; !error && left != fs::end(left);
         left.increment(error)) {
        std::error_code stays;
        fs::remove_all(left->path(), stays);
        if (stays) return fail_io("cannot remove", left->path(), stays.value());
    }
    if (error) return fail_io("cannot read", folder, error.value());
    return {};
}

} // namespace

Result<FileHandle> hold_outbox(const std::string& outbox) {
    std::error_code error;
    fs::create_directories(outbox, error);
    if (error) return fail_io("cannot make", outbox, error.value());
    FileHandle folder{::open(outbox.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)};
    if (!folder) return fail_io("cannot open", outbox);
    while (::flock(folder.get(), LOCK_EX) != 0 && errno == EINTR) {
    }
    return folder;
}

Result<std::string> begin_entry(const std::string& outbox, const std::string& run_id) {
    AXISCAL_CHECK(check_run_id(run_id));
    const auto staging = staging_folder(outbox, run_id);
    std::error_code error;
    if (const auto entry = outbox + "/" + run_id; fs::exists(entry, error)) {
        fs::remove_all(staging, error); // a station that starts would try this again each time
        return fail(Fault::refused, entry + " exists already and is never overwritten");
    }
    fs::create_directories(staging, error);
    if (error) return fail_io("cannot make", staging, error.value());
    AXISCAL_CHECK(empty_folder(staging));
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

Result<std::string> archive_entry(const OutboxEntry& entry,
                                  const Progress& progress,
                                  const MountPlaces& mounts) {
    if (!entry.has_receipt)
        return fail(Fault::refused, entry.folder + " has no receipt and stays where it is");
    const auto outbox = fs::path{entry.folder}.parent_path();
    const auto published = (outbox.parent_path() / "published").string();
    AXISCAL_CHECK(make_archive(outbox, published, mounts).map_error(of_the_archive));
    std::error_code error;
    for (int copy = 1; copy <= most_same_names; ++copy) {
        auto place = numbered(published + "/" + entry.run_id, copy);
        if (fs::exists(place, error)) continue;
        const auto moved = move_to_free_name(entry.folder, place);
        if (moved) return place;
        if (moved.error().cause != std::errc::cross_device_link)
            return tl::unexpected<Error>(moved.error());
        return move_over_disks(entry, published, progress).map_error(of_the_archive);
    }
    return fail(Fault::refused, published + " is full of " + entry.run_id);
}

Result<void> sync_outbox(const std::string& outbox) {
    AXISCAL_CHECK(sync_folder((fs::path{outbox}.parent_path() / "published").string()));
    return sync_folder(outbox);
}

} // namespace axiscal
