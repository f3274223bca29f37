#pragma once
// Which entry is tried when, and what is said about it. Owns no clock and no wait: the process
// around it calls pass() again. For one thread.

#include "acquisition/publish/share.hpp"
#include "analysis/quantity/time.hpp"

#include <map>
#include <optional>
#include <string>

namespace axiscal {

struct PublisherSettings {
    std::string outbox, destination;
    Duration retry = std::chrono::seconds{5}; ///< first pause; doubles up to sixteen times that
};

/// Told once per change of state, never per attempt.
class PublisherListener {
public:
    virtual ~PublisherListener() = default;
    virtual void published(const PublishReceipt& receipt) = 0;
    /// `run_id` is empty when it is about the destination as a whole.
    virtual void waiting(const std::string& run_id, const Error& why) = 0;
    virtual void destination_back() = 0;
    virtual void progress() = 0;
};

class Publisher {
public:
    Publisher(PublisherSettings settings, PublisherListener& listener)
        : settings_{std::move(settings)}
        , listener_{listener} {}

    /// Tries every entry that is due. Returns how many entries still wait.
    std::size_t pass(MonotonicTime now, std::int64_t utc_ns);
    /// When the next waiting entry is due; empty when nothing waits.
    [[nodiscard]] std::optional<MonotonicTime> next_due() const;

private:
    struct Trouble {
        std::string last_words;
        Duration pause{};
        MonotonicTime due{};
    };
    bool destination_ready(MonotonicTime now);
    [[nodiscard]] bool is_due(const std::string& run_id, MonotonicTime now) const;
    Result<void> publish(OutboxEntry entry, std::int64_t utc_ns);
    void remember(const std::string& run_id, const Error& why, MonotonicTime now);

    PublisherSettings settings_;
    PublisherListener& listener_;
    std::map<std::string, Trouble> troubles_; ///< by run id; "" is the destination
};

} // namespace axiscal
