#pragma once
// Finished results wait in <state>/outbox/<run-id>/ until the publisher has a receipt for them.
// Functions on files, no state; a name without a dot in front appears only with all its content,
// synced. Flat: an entry holds files, no folders.

#include "acquisition/publish/destination.hpp"
#include "acquisition/publish/mount_points.hpp"
#include "acquisition/runfile/durable_file.hpp"
#include "analysis/quantity/result.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

inline constexpr std::string_view receipt_file_name = "receipt.json";

struct OutboxEntry {
    std::string run_id;
    std::string folder;             ///< <outbox>/<run-id>
    std::vector<std::string> files; ///< names to be published, sorted; without the receipt
    bool has_receipt = false;
};

/// Waits until nobody else fills this folder, and holds it until the handle goes, also by the end
/// of the process: two programs on one run would each find the other's half. The folder is made
/// where it is missing. A share that locks no folders is not held. @errors Fault::io.
Result<FileHandle> hold_outbox(const std::string& outbox);
/// Makes an empty folder of a temporary name (also anew after a crash) to be filled by the caller,
/// perhaps in another process. The outbox itself is made where it is missing.
/// @errors Fault::bad_request for a run id that is no plain file name; Fault::refused when an entry
/// of that name waits already; Fault::io.
Result<std::string> begin_entry(const std::string& outbox, const std::string& run_id);
/// Syncs every file and the folder and gives it its name; returns the entry's folder.
/// @errors Fault::refused when an entry of that name waits already; Fault::io.
Result<std::string> finish_entry(const std::string& outbox, const std::string& run_id);

/// Names of the waiting entries, sorted. Empty when there is no outbox yet.
std::vector<std::string> entry_names(const std::string& outbox);
/// @errors Fault::not_found when that entry is gone; Fault::refused for what is no plain file.
Result<OutboxEntry> read_entry(const std::string& outbox, const std::string& run_id);

/// Moves an entry that has its receipt to <outbox>/../published/<run-id>; returns where it lies.
/// Where the name is taken a number is added. On disk after sync_outbox(): until then a power cut
/// may undo the move, and it is made again. Where `published` leads to another disk the entry is
/// copied, synced, read back and compared under a hidden name, which then becomes its own; only
/// then it leaves the outbox. Interrupted anywhere it may be called again.
/// @errors Fault::refused without a receipt; Fault::checksum when the other disk gives back other
/// bytes; Fault::io, also where that disk is not mounted.
Result<std::string> archive_entry(const OutboxEntry& entry,
                                  const Progress& progress = {},
                                  const MountPlaces& mounts = {});
/// Makes moves between the outbox and its archive durable.
Result<void> sync_outbox(const std::string& outbox);

} // namespace axiscal
