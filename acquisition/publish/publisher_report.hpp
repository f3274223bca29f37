#pragma once
// What the publisher says to whoever asks: a small file beside the outbox, read by axiscald for
// `axiscal status`; and the lock that tells it runs, once an outbox. Files only, no state.

#include "acquisition/runfile/durable_file.hpp"

#include <string>

namespace axiscal {

struct PublisherReport {
    std::string destination;
    std::string state;     ///< "idle", "publishing", "waiting", or "nowhere" without a destination
    std::string reason;    ///< one sentence, while waiting
    std::string since_utc; ///< of state and reason
};

/// Replaces <outbox>/../publisher.json ("axiscal.publisher/1"), not synced: after a power cut the
/// publisher speaks again.
Result<void> write_report(const std::string& outbox, const PublisherReport& report);

/// Held for the life of the process: <outbox>/../publisher.lock.
/// @errors Fault::busy when another publisher works on this outbox; Fault::io.
Result<FileHandle> lock_outbox(const std::string& outbox);

} // namespace axiscal
