#pragma once
// A full outbox is emptied by two processes: what a result costs is mostly waiting for the server,
// and each waits by itself. The second one is a fork of the publisher, which has no other thread;
// it has a session of its own, and each takes the next entry that nobody has. POSIX only.

#include "acquisition/publish/publisher.hpp"

namespace axiscal {

class UploadWorker {
public:
    using Opener = std::function<Result<std::unique_ptr<Destination>>()>;

    /// @param destination  of the publisher; used where the publisher has said nothing to it yet
    /// @param open         the destination anew, for a process that inherits a session
    UploadWorker(std::string outbox,
                 std::function<std::int64_t()> utc_ns,
                 Destination& destination,
                 Opener open,
                 PublisherListener& listener)
        : outbox_{std::move(outbox)}
        , utc_ns_{std::move(utc_ns)}
        , destination_{destination}
        , open_{std::move(open)}
        , listener_{listener} {}

    /// Its wait() feeds the listener's progress while bytes move, and kills the worker when
    /// the listener says stop: as after any interruption an entry is then tried again. What fails
    /// there is only left; nothing is told but what was published. Null when no process can be had.
    std::unique_ptr<UploadHelper> begin(const std::vector<std::string>& run_ids);

private:
    class Child;
    void work(const std::vector<std::string>& run_ids, Child& self, bool inherits) const;
    void publish_by(Destination& destination,
                    const std::vector<std::string>& run_ids,
                    Child& self) const;

    std::string outbox_;
    std::function<std::int64_t()> utc_ns_;
    Destination& destination_;
    Opener open_;
    PublisherListener& listener_;
};

} // namespace axiscal
