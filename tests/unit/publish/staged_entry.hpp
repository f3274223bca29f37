#pragma once
// Entries of an outbox whose files are in memory.

#include "acquisition/publish/outbox.hpp"
#include "tests/support/scratch_folder.hpp"

#include <string>
#include <vector>

namespace axiscal::testing {

struct OutboxFile {
    std::string name, content;
};

/// Begun, filled and finished; the entry's folder.
inline Result<std::string> stage_entry(const std::string& outbox,
                                       const std::string& run_id,
                                       const std::vector<OutboxFile>& files) {
    const auto staging = begin_entry(outbox, run_id);
    if (!staging) return staging;
    for (const auto& [name, content] : files)
        write_bytes(*staging + "/" + name, content);
    return finish_entry(outbox, run_id);
}

} // namespace axiscal::testing
