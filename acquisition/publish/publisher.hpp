#pragma once
// Which entry is tried when, and what is said about it. Owns no wait: the process around it calls
// pass() again. For one thread.

#include "acquisition/publish/share.hpp"
#include "analysis/quantity/time.hpp"

#include <functional>
#include <map>
#include <optional>
#include <string>

namespace axiscal {

struct PublisherSettings {
    std::string outbox;
    Duration retry = std::chrono::seconds{5}; ///< first pause; doubles up to sixteen times that
    /// Begins with these entries beside the caller and answers how to wait for its end
    /// (SecondHand). It may leave any entry as it was.
    using Beginner = std::function<std::function<void()>(const std::vector<std::string>&)>;
    Beginner second_hand = nullptr; ///< null: one hand does all
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
    struct Shares {
        std::vector<std::string> own, others;
    };
    bool destination_ready();
    [[nodiscard]] Shares shared_out(const std::vector<std::string>& run_ids) const;
    /// @returns false when the pass ends here: the destination is lost, or the listener says stop.
    bool publish_all(const std::vector<std::string>& run_ids);
    [[nodiscard]] bool is_due(const std::string& run_id) const;
    Result<void> publish(const std::string& run_id);
    void remember(const std::string& run_id, const Error& why);

    PublisherSettings settings_;
    PublisherClock clock_;
    Destination& destination_;
    PublisherListener& listener_;
    std::map<std::string, Trouble> troubles_; ///< by run id; "" is the destination
};

} // namespace axiscal
