#pragma once
// A full outbox is emptied by two processes: what a result costs is mostly waiting for the server,
// and each waits by itself. The second one is a fork of the publisher, which has no other thread;
// it has a session of its own and ends with its entries. POSIX only.

#include "acquisition/publish/publisher.hpp"

#include <memory>

namespace axiscal {

class SecondHand {
public:
    using Opener = std::function<Result<std::unique_ptr<Destination>>()>;

    /// @param open  the destination anew: that of the publisher belongs to its process
    SecondHand(std::string outbox,
               std::function<std::int64_t()> utc_ns,
               Opener open,
               PublisherListener& listener)
        : outbox_{std::move(outbox)}
        , utc_ns_{std::move(utc_ns)}
        , open_{std::move(open)}
        , listener_{listener} {}

    /// Begins with these entries. The answer waits for the end, feeds the listener's progress while
    /// bytes move, and kills the second hand when the listener says stop: as after any interruption
    /// an entry is then tried again. What fails there is only left; nothing is told but what was
    /// published. Empty when no process can be had.
    std::function<void()> begin(const std::vector<std::string>& run_ids);

private:
    void work(const std::vector<std::string>& run_ids, int heartbeat) const;

    std::string outbox_;
    std::function<std::int64_t()> utc_ns_;
    Opener open_;
    PublisherListener& listener_;
};

} // namespace axiscal
