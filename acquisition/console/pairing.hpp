#pragma once
// Who may operate the station from a browser: codes that are shown at the station, and the browsers
// that have borne one. Time and random bytes are handed in. Pure. See docs/pairing.md.

#include "analysis/quantity/result.hpp"
#include "analysis/quantity/time.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace axiscal {

inline constexpr std::size_t most_paired = 16;
inline constexpr int most_wrong_codes = 5;
inline constexpr Duration code_lasts = std::chrono::minutes{5};
inline constexpr Duration pairing_lasts = std::chrono::hours{30 * 24}; ///< without an order
inline constexpr std::string_view usual_page_name = "page";

/// A code ends by the clock that nobody sets, a pairing by the calendar: it outlives the daemon.
struct PairingTime {
    MonotonicTime at;
    std::int64_t utc_ns = 0;
};

/// Fills every byte; false: there are none.
using RandomBytes = std::function<bool(std::span<std::uint8_t>)>;

struct PairingCode {
    std::string digits; ///< eight
    std::string name;   ///< what the browser's orders are logged by
    std::int64_t until_utc_ns = 0;
};

struct PairedBrowser {
    std::string token_hash; ///< SHA-256 in hex; the token itself is nowhere
    std::string name;
    std::int64_t since_utc_ns = 0;
    std::optional<std::int64_t> last_order_utc_ns = {};

    [[nodiscard]] std::int64_t until_utc_ns() const;
    bool operator==(const PairedBrowser&) const = default;
};

struct OpenedSession {
    std::string token; ///< base64url, for the browser alone
    std::string name;
    std::int64_t until_utc_ns = 0;
};

/// Eight digits, each code as likely as any other. @errors Fault::internal without random bytes.
Result<std::string> random_code(const RandomBytes& random);

/// Loop-bound.
class PairingDesk {
public:
    explicit PairingDesk(RandomBytes random, std::vector<PairedBrowser> kept = {});

    /// A new code; an earlier one is void. @param name  empty: "page"
    /// @errors Fault::busy while as many are paired as may be; Fault::internal.
    Result<PairingCode> offer(const std::string& name, const PairingTime& now);
    /// Takes the code, which is void then. @errors Fault::refused for a wrong code, an old one or
    /// none, with what to do; Fault::busy as offer(); Fault::internal.
    Result<OpenedSession> open(std::string_view digits, const PairingTime& now);
    /// Null: nobody. The next call of another function ends the pointer.
    [[nodiscard]] const PairedBrowser* find(std::string_view token, const PairingTime& now) const;
    /// The browser of `token` has ordered something. True when the day that is kept has changed:
    /// what is on disk may be a day old, not older.
    bool note_order(std::string_view token, const PairingTime& now);
    /// All that are paired, oldest first.
    [[nodiscard]] std::vector<PairedBrowser> paired(const PairingTime& now) const;

    // Each returns how many pairings it has ended.
    std::size_t end_token(std::string_view token);
    std::size_t end_name(std::string_view name); ///< every browser of that name
    std::size_t end_all();

private:
    struct OpenCode {
        std::string digits, name;
        MonotonicTime until;
        int wrong = 0;
    };
    void forget_old(const PairingTime& now);
    [[nodiscard]] Result<void> room_for_one() const;
    tl::unexpected<Error> count_wrong_code();

    RandomBytes random_;
    std::vector<PairedBrowser> paired_;
    std::optional<OpenCode> code_;
};

} // namespace axiscal
