#pragma once
// Carries one outbox entry to its destination, which may be slow or vanish: every call may block,
// so only the publisher's own process makes them. No state.

#include "acquisition/publish/destination.hpp"
#include "acquisition/publish/outbox.hpp"
#include "acquisition/runfile/run_signature.hpp"

#include <cstdint>
#include <optional>
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
    std::optional<ClosingMark> closing = {}; ///< of the run file among them
};

/// How entries of one outbox travel.
struct Delivery {
    Destination& destination;
    std::string mark; ///< mark_of() that outbox
    Progress progress = {};
};

/// Every file of the entry is at the destination under its final name, written once, flushed, read
/// back and equal by SHA-256. A file appears only whole (before: .<name>.<mark>.part, the mark
/// being this station's own: nobody else's is touched, and a stale one is swept). What lies there
/// already with the same content counts as published; other content, also under a name that
/// differs in case only, is never overwritten: a new folder <run-id>-2, -3 ... is taken, also where
/// the other content came while we wrote. Calling again after any interruption goes on.
/// @errors share_lost() when nothing can be published now; Fault::io with the path and what to
/// do; Fault::checksum when the share gives back other bytes.
Result<PublishReceipt>
copy_entry(const OutboxEntry& entry, const Delivery& delivery, std::int64_t utc_ns);

/// Copies an entry that has no receipt and writes it into the entry; then it may be archived.
/// Returns the receipt; none where one lay there already. @errors of both.
Result<std::optional<PublishReceipt>>
deliver_entry(OutboxEntry& entry, const Delivery& delivery, std::int64_t utc_ns);

/// Writes receipt.json into the entry, synced.
Result<void> write_receipt(const OutboxEntry& entry, const PublishReceipt& receipt);

/// The receipt as JSON text, "axiscal.receipt/1".
std::string receipt_json(const PublishReceipt& receipt);

/// What tells unfinished files of this PC's outbox from everybody else's: 8 hexadecimal digits of
/// machine and path.
std::string mark_of(const std::string& outbox);

} // namespace axiscal
