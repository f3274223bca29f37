// The file of paired browsers as a disk may give it back, and Cookie headers as anybody may send
// them.

#include "acquisition/console/paired_text.hpp"
#include "acquisition/console/pairing.hpp"
#include "acquisition/console/session_cookie.hpp"
#include "tests/fuzz/judge.hpp"

using namespace axiscal;

namespace {

void judge_file(std::string_view text) {
    auto paired = paired_of_text(text);
    if (!paired) return fuzz::require(!paired.error().detail.empty(), "a refusal has a reason");
    fuzz::require(paired->size() <= most_paired, "no more are read than may be paired");
    fuzz::require(paired_text(*paired) == text, "what is read is written as it was");
    for (const PairedBrowser& browser : *paired)
        fuzz::require(browser.until_utc_ns() > 0, "an end lies behind its beginning");
    PairingDesk desk{[](std::span<std::uint8_t>) { return false; }, *std::move(paired)};
    fuzz::require(desk.find(text, {}) == nullptr, "a file of hashes lets nobody in");
}

void judge_cookies(std::string_view cookies) {
    const std::string_view token = token_in_cookies(cookies);
    if (token.empty()) return;
    fuzz::require(token.size() == token_letters, "a token has its length");
    const std::string set = set_cookie_text(token, std::chrono::seconds{1}, true);
    fuzz::require(token_in_cookies(set) == token, "a cookie is read as it was set");
    fuzz::require(set.find_first_of("\r\n") == std::string::npos, "a cookie stays one header");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    judge_file(fuzz::as_text(data, size));
    judge_cookies(fuzz::as_text(data, size));
    return 0;
}
