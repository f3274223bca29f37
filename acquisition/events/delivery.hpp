#pragma once
// Brings what waits in the folder of events to the receiver: one attempt at each in a pass, then a
// pause that grows. What sends, the clock and chance are handed in.

#include "acquisition/events/webhook_signature.hpp"
#include "analysis/quantity/time.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace axiscal {

struct WebhookPost {
    std::string id, signatures, body; ///< webhook-id, webhook-signature
    std::int64_t utc_s = 0;           ///< webhook-timestamp: of this attempt
};

struct WebhookAnswer {
    int status = 0;                      ///< of HTTP; 0: there was no answer
    std::string trouble;                 ///< why there was none
    std::optional<Duration> retry_after; ///< what the receiver asks for
};

struct DeliveryParts {
    std::function<WebhookAnswer(const WebhookPost&)> post; ///< blocks, for a bounded time
    std::function<std::int64_t()> utc_s;
    std::function<double()> chance;   ///< from 0 to below 1
    std::function<bool()> go_on = {}; ///< false: asked to end; empty: never
};

/// The pauses after passes that leave something: 5 s, 30 s, 2 min, then 5 min; each with up to a
/// fifth more by chance, so that stations do not come all at once. They begin anew with whatever
/// is delivered. At most an hour where the receiver asks for more.
class EventDelivery {
public:
    EventDelivery(std::string state_directory, std::vector<WebhookKey> keys, DeliveryParts parts);

    /// The oldest first. One that is refused holds up no other; without an answer, and where the
    /// receiver asks for time (429, 503), the others are not tried either.
    /// @returns how many wait still.
    std::size_t pass();
    /// Until the next pass.
    [[nodiscard]] Duration pause();
    /// Delivered since it was made.
    [[nodiscard]] std::size_t delivered() const { return delivered_; }
    /// One sentence on the last attempt that failed; empty: none did in the last pass.
    [[nodiscard]] const std::string& trouble() const { return trouble_; }

private:
    enum class Outcome : std::uint8_t { taken, refused, away };
    Outcome attempt(const std::string& id);
    Outcome judge(const std::string& id, const WebhookAnswer& answer);
    [[nodiscard]] bool goes_on() const { return !parts_.go_on || parts_.go_on(); }

    std::string state_directory_;
    std::vector<WebhookKey> keys_;
    DeliveryParts parts_;
    std::size_t delivered_ = 0, passes_in_vain_ = 0;
    std::string trouble_;
    std::optional<Duration> asked_pause_;
};

} // namespace axiscal
