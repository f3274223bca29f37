#pragma once
// Which entry is tried when, and what is said about it. Owns no wait: the process around it calls
// pass() again. For one thread.

#include "acquisition/publish/share.hpp"
#include "analysis/quantity/time.hpp"

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace axiscal {

/// Publishes entries of a list beside its owner (UploadWorker); may leave any as it was.
class UploadHelper {
public:
    UploadHelper() = default;
    virtual ~UploadHelper() = default;
    UploadHelper(const UploadHelper&) = delete;
    UploadHelper& operator=(const UploadHelper&) = delete;
    /// Index of an entry that is the owner's from now on; empty when each has somebody.
    virtual std::optional<std::size_t> claim() = 0;
    /// Until it has done what it claimed.
    virtual void wait() = 0;
};

struct PublisherSettings {
    std::string outbox;
    Duration retry = std::chrono::seconds{5}; ///< first pause; doubles up to sixteen times that
    /// May answer null. Called before anything is said to the destination in that pass.
    using Beginner = std::function<std::unique_ptr<UploadHelper>(const std::vector<std::string>&)>;
    Beginner upload_worker = nullptr; ///< null: the publisher does all
};

/// Time as the publisher needs it; a call to a share may have taken long.
struct PublisherClock {
    std::function<MonotonicTime()> now;
    std::function<std::int64_t()> utc_ns;
};

/// Told once per change of state, never per attempt.
class PublisherListener {
public:
    PublisherListener() = default;
    virtual ~PublisherListener() = default;
    PublisherListener(const PublisherListener&) = delete;
    PublisherListener& operator=(const PublisherListener&) = delete;
    virtual void published(const PublishReceipt& receipt) = 0;
    /// `run_id` is empty when it is about the destination as a whole.
    virtual void waiting(const std::string& run_id, const Error& why) = 0;
    virtual void destination_back() = 0;
    virtual void progress() = 0;
    /// false ends the pass before the next entry.
    virtual bool go_on() { return true; }
};

class Publisher {
public:
    Publisher(PublisherSettings settings,
              PublisherClock clock,
              Destination& destination,
              PublisherListener& listener)
        : settings_{std::move(settings)}
        , clock_{std::move(clock)}
        , destination_{destination}
        , listener_{listener} {}

    /// Tries every entry that is due; a destination that is lost ends the pass. Returns how many
    /// entries wait now.
    std::size_t pass();
    /// When the next waiting entry is due; empty when nothing waits.
    [[nodiscard]] std::optional<MonotonicTime> next_due() const;

private:
    struct Trouble {
        std::string last_words;
        Duration pause{};
        MonotonicTime due{};
    };
    bool destination_ready();
    [[nodiscard]] std::unique_ptr<UploadHelper>
    upload_worker_for(const std::vector<std::string>& run_ids) const;
    // Each returns false when the pass ends here: the destination is lost, or the listener says
    // stop.
    bool publish_beside(UploadHelper& helper, const std::vector<std::string>& run_ids);
    bool publish_all(const std::vector<std::string>& run_ids);
    bool attend_to(const std::string& run_id);
    [[nodiscard]] bool is_due(const std::string& run_id) const;
    Result<void> publish(const std::string& run_id);
    void remember(const std::string& run_id, const Error& why);

    PublisherSettings settings_;
    PublisherClock clock_;
    Destination& destination_;
    PublisherListener& listener_;
    std::string mark_;                        ///< of the outbox, as this pass found it
    std::map<std::string, Trouble> troubles_; ///< by run id; "" is the destination
};

} // namespace axiscal
