#include "acquisition/console/pairing.hpp"

#include "acquisition/console/access.hpp"
#include "acquisition/console/session_cookie.hpp"
#include "acquisition/runfile/digest.hpp"
#include "analysis/quantity/counted.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace axiscal {
namespace {

constexpr std::int64_t day_ns = Duration{std::chrono::hours{24}}.count();

tl::unexpected<Error> no_random_bytes() {
    return fail(Fault::internal, "the computer gives no random bytes; nobody can be paired now");
}

/// A clock that was set back makes nobody older.
bool holds(const PairedBrowser& browser, const PairingTime& now) {
    return now.utc_ns < browser.until_utc_ns();
}

} // namespace

std::int64_t PairedBrowser::until_utc_ns() const {
    return last_order_utc_ns.value_or(since_utc_ns) + pairing_lasts.count();
}

Result<std::string> random_code(const RandomBytes& random) {
    constexpr std::uint32_t codes = 100'000'000;
    // Numbers above the last whole hundred million would make low codes likelier.
    constexpr std::uint32_t fair = UINT32_MAX / codes * codes;
    constexpr int most_draws = 64; // each is fair with 98 %
    for (int draw = 0; draw < most_draws; ++draw) {
        std::array<std::uint8_t, 4> bytes{};
        if (!random(bytes)) break;
        std::uint32_t number = 0;
        for (const std::uint8_t byte : bytes)
            number = number << 8U | byte;
        if (number >= fair) continue;
        const std::string digits = std::to_string(number % codes);
        return std::string(8 - digits.size(), '0') + digits;
    }
    return no_random_bytes();
}

PairingDesk::PairingDesk(RandomBytes random, std::vector<PairedBrowser> kept)
    : random_{std::move(random)}
    , paired_{std::move(kept)} {}

void PairingDesk::forget_old(const PairingTime& now) {
    std::erase_if(paired_, [&](const PairedBrowser& browser) { return !holds(browser, now); });
}

Result<void> PairingDesk::room_for_one() const {
    if (paired_.size() < most_paired) return {};
    return fail(Fault::busy, "16 browsers are paired, which is as many as may be: axiscal pair "
                             "--list shows them, axiscal pair --end NAME ends one");
}

Result<PairingCode> PairingDesk::offer(const std::string& name, const PairingTime& now) {
    code_.reset();
    forget_old(now);
    AXISCAL_CHECK(room_for_one());
    AXISCAL_TRY(std::string digits, random_code(random_));
    code_ = OpenCode{std::move(digits), name.empty() ? std::string{usual_page_name} : name,
                     now.at + code_lasts};
    return PairingCode{code_->digits, code_->name, now.utc_ns + code_lasts.count()};
}

tl::unexpected<Error> PairingDesk::count_wrong_code() {
    const int left = most_wrong_codes - ++code_->wrong;
    if (left > 0)
        return fail(Fault::refused,
                    "the code is wrong; " + counted(left, "try", "tries") + " left");
    code_.reset();
    return fail(Fault::refused, "the code was wrong five times and is void: ask for a new one at "
                                "the station with 'axiscal pair'");
}

Result<OpenedSession> PairingDesk::open(std::string_view digits, const PairingTime& now) {
    if (code_ && now.at >= code_->until) code_.reset();
    if (!code_)
        return fail(Fault::refused, "no code is valid now, for each counts for five minutes and "
                                    "once: ask for a new one at the station with 'axiscal pair'");
    if (!same_secret(digits, code_->digits)) return count_wrong_code();
    const std::string name = std::exchange(code_, std::nullopt)->name;
    forget_old(now);
    AXISCAL_CHECK(room_for_one());
    std::array<std::uint8_t, token_bytes> bytes{};
    if (!random_(bytes)) return no_random_bytes();
    const std::string token = base64url(bytes);
    paired_.push_back({sha256_hex(token), name, now.utc_ns});
    return OpenedSession{token, name, paired_.back().until_utc_ns()};
}

const PairedBrowser* PairingDesk::find(std::string_view token, const PairingTime& now) const {
    if (token.empty()) return nullptr;
    const std::string hash = sha256_hex(token);
    const PairedBrowser* found = nullptr; // all are looked at, whichever it is
    for (const PairedBrowser& browser : paired_)
        if (same_secret(hash, browser.token_hash) && holds(browser, now)) found = &browser;
    return found;
}

bool PairingDesk::note_order(std::string_view token, const PairingTime& now) {
    const PairedBrowser* found = find(token, now);
    if (found == nullptr) return false;
    PairedBrowser& browser = paired_[static_cast<std::size_t>(found - paired_.data())];
    const auto before = std::exchange(browser.last_order_utc_ns, now.utc_ns);
    return !before || *before / day_ns != now.utc_ns / day_ns;
}

std::vector<PairedBrowser> PairingDesk::paired(const PairingTime& now) const {
    std::vector<PairedBrowser> holding = paired_;
    std::erase_if(holding, [&](const PairedBrowser& browser) { return !holds(browser, now); });
    return holding;
}

std::size_t PairingDesk::end_token(std::string_view token) {
    const std::string hash = sha256_hex(token);
    return std::erase_if(paired_, [&](const PairedBrowser& browser) {
        return same_secret(hash, browser.token_hash);
    });
}

std::size_t PairingDesk::end_name(std::string_view name) {
    return std::erase_if(paired_,
                         [&](const PairedBrowser& browser) { return browser.name == name; });
}

std::size_t PairingDesk::end_all() {
    code_.reset(); // who is not to operate any more is not let in by it either
    return std::exchange(paired_, {}).size();
}

} // namespace axiscal
