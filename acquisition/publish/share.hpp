#pragma once
// Carries one outbox entry to the destination folder, which may be a slow or vanishing network
// share: every call may block, so only the publisher's own process makes them. No state.

#include "acquisition/publish/outbox.hpp"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace axiscal {

struct PublishedFile {
    std::string name, sha256;
    std::uint64_t bytes = 0;
};

struct PublishReceipt {
    std::string run_id;
    std::string folder; ///< <destination>/<run-id>, or with a number where that name was taken
    std::string published_utc;
    std::vector<PublishedFile> files;
};

/// Called while bytes move, so that a watchdog sees a slow share apart from a dead one.
using Progress = std::function<void()>;

/// Every file of the entry is at the destination under its final name, written once, synced, read
/// back and equal by SHA-256. A file appears only whole (before: .<name>.part). What lies there
/// already with the same content counts as published; other content is never overwritten: a new
/// folder <run-id>-2, -3 ... is taken. Calling again after any interruption goes on.
/// @errors Fault::io with the path and what to do; Fault::checksum when the share gives back other
/// bytes.
Result<PublishReceipt> copy_entry(const OutboxEntry& entry,
                                  const std::string& destination,
                                  std::int64_t utc_ns,
                                  const Progress& progress = {});

/// Writes receipt.json into the entry, synced.
Result<void> write_receipt(const OutboxEntry& entry, const PublishReceipt& receipt);

/// The receipt as JSON text, "axiscal.receipt/1".
std::string receipt_json(const PublishReceipt& receipt);

/// A destination is a folder that exists: making it could fill an unmounted mount point.
Result<void> check_destination(const std::string& destination);

} // namespace axiscal
