#include "acquisition/publish/share.hpp"

#include "acquisition/runfile/digest.hpp"
#include "acquisition/runfile/durable_file.hpp"
#include "acquisition/runfile/receipt.hpp"
#include "acquisition/runfile/run_file.hpp"
#include "analysis/quantity/time.hpp"
#include "config/json_text.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <strings.h>

namespace axiscal {
namespace {

namespace fs = std::filesystem;

constexpr int most_folders = 1000; // of one run id
constexpr std::size_t mark_digits = 8;

/// One entry on its way.
struct Journey {
    const OutboxEntry& entry;
    const Delivery& delivery;
    std::vector<PublishedFile> files;
};

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

/// What the run file says of its end, so that it can be held against the receipt for ever; none for
/// an entry that holds no run file that can be read.
std::optional<ClosingMark> closing_in(const OutboxEntry& entry) {
    for (const auto& name : entry.files)
        if (name.ends_with(run_file_ending))
            if (auto mark = last_closing_mark(entry.folder + "/" + name)) return *std::move(mark);
    return std::nullopt;
}

std::string part_name(const std::string& name, const std::string& mark) {
    return "." + name + "." + mark + ".part";
}

// A share may keep names apart by case or not; a rename onto the other case could replace a file.
bool same_name(const std::string& one, const std::string& other) {
    return ::strcasecmp(one.c_str(), other.c_str()) == 0;
}

Result<void>
sweep(const Journey& journey, const std::string& folder, const std::vector<std::string>& names) {
    for (const auto& file : journey.files) {
        const auto part = part_name(file.name, journey.delivery.mark);
        if (std::ranges::find(names, part) != names.end())
            AXISCAL_CHECK(
                journey.delivery.destination.remove_file((fs::path{folder} / part).string()));
    }
    return {};
}

/// Files that still have to go into this folder; none when something stands in the way.
using Missing = std::optional<std::vector<PublishedFile>>;

Result<Missing> missing_in(const Journey& journey, const std::string& folder) {
    auto names = journey.delivery.destination.names_in(folder);
    if (!names && names.error().fault == Fault::refused) return Missing{};
    if (!names) return tl::unexpected<Error>(names.error());
    AXISCAL_CHECK(sweep(journey, folder, *names));
    std::vector<PublishedFile> missing;
    for (const auto& file : journey.files) {
        const auto there = std::ranges::find_if(
            *names, [&](const std::string& name) { return same_name(name, file.name); });
        if (there == names->end()) {
            missing.push_back(file);
            continue;
        }
        if (*there != file.name) return Missing{};
        const auto hash = journey.delivery.destination.sha256_of(folder + "/" + file.name,
                                                                 journey.delivery.progress);
        if (!hash && hash.error().fault != Fault::refused)
            return tl::unexpected<Error>(hash.error());
        if (!hash || *hash != file.sha256) return Missing{};
    }
    return Missing{std::move(missing)};
}

struct Place {
    std::string folder;
    std::vector<PublishedFile> missing;
};

/// The first folder of this run's names in which no file stands in the way; made if new.
Result<Place> choose_folder(const Journey& journey) {
    for (int copy = 1; copy <= most_folders; ++copy) {
        auto folder = journey.entry.run_id;
        if (copy > 1) folder += "-" + std::to_string(copy);
        AXISCAL_TRY(const bool made, journey.delivery.destination.make_folder(folder));
        if (made) return Place{std::move(folder), journey.files};
        AXISCAL_TRY(auto missing, missing_in(journey, folder));
        if (missing) return Place{std::move(folder), *std::move(missing)};
    }
    return fail(Fault::refused, journey.delivery.destination.place() +
                                    " is full of other runs named " + journey.entry.run_id);
}

// Read back under the temporary name, so that no wrong byte ever bears the final one.
Result<void>
copy_file(const Journey& journey, const PublishedFile& file, const std::string& folder) {
    const auto part = folder + "/" + part_name(file.name, journey.delivery.mark);
    AXISCAL_TRY(const auto read_back,
                journey.delivery.destination.write_and_read_back(
                    journey.entry.folder + "/" + file.name, part, journey.delivery.progress));
    if (read_back != file.sha256)
        return fail(Fault::checksum, journey.delivery.destination.place() + "/" + part +
                                         " came back from the share with other content");
    return journey.delivery.destination.move_to_free_name(part, folder + "/" + file.name);
}

Result<void> copy_missing(const Journey& journey, const Place& place) {
    for (const auto& file : place.missing)
        AXISCAL_CHECK(copy_file(journey, file, place.folder));
    return {};
}

/// Fills a folder and returns it. Where somebody took one of the names while we wrote, the next
/// folder gets the whole result; what this one has got of it stays.
Result<std::string> fill_folder(const Journey& journey) {
    constexpr int most_tries = 3; // a name that is taken each time is no chance: told, tried later
    for (int tries = 1;; ++tries) {
        AXISCAL_TRY(auto place, choose_folder(journey));
        auto copied = copy_missing(journey, place);
        if (copied) return std::move(place.folder);
        if (copied.error().fault != Fault::refused || tries == most_tries)
            return tl::unexpected<Error>(copied.error());
    }
}

} // namespace

Result<PublishReceipt>
copy_entry(const OutboxEntry& entry, const Delivery& delivery, std::int64_t utc_ns) {
    AXISCAL_TRY(auto files, describe_files(entry, delivery.progress));
    Journey journey{entry, delivery, std::move(files)};
    AXISCAL_TRY(const auto folder, fill_folder(journey));
    AXISCAL_CHECK(delivery.destination.sync_folder(folder));
    AXISCAL_CHECK(delivery.destination.sync_folder(""));
    return PublishReceipt{entry.run_id, delivery.destination.place() + "/" + folder,
                          iso8601_utc(utc_ns), std::move(journey.files), closing_in(entry)};
}

Result<std::optional<PublishReceipt>>
deliver_entry(OutboxEntry& entry, const Delivery& delivery, std::int64_t utc_ns) {
    if (entry.has_receipt) return std::nullopt;
    AXISCAL_TRY(auto receipt, copy_entry(entry, delivery, utc_ns));
    AXISCAL_CHECK(write_receipt(entry, receipt));
    entry.has_receipt = true;
    return std::optional{std::move(receipt)};
}

std::string mark_of(const std::string& outbox) {
    std::string machine;
    std::getline(std::ifstream{"/etc/machine-id"}, machine);
    std::error_code error;
    const auto path = fs::weakly_canonical(outbox, error);
    return sha256_hex(machine + "\n" + (error ? outbox : path.string())).substr(0, mark_digits);
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
    document["closing"] = closing_json(receipt.closing);
    return json_text(document);
}

Result<void> write_receipt(const OutboxEntry& entry, const PublishReceipt& receipt) {
    const auto unfinished = entry.folder + "/.receipt.part";
    const auto final_name = entry.folder + "/" + std::string{receipt_file_name};
    AXISCAL_CHECK(write_synced(unfinished, receipt_json(receipt) + "\n"));
    AXISCAL_CHECK(move_to_free_name(unfinished, final_name));
    return sync_folder(entry.folder);
}

} // namespace axiscal
