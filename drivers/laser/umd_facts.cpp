#include "drivers/laser/umd_facts.hpp"

#include <array>
#include <cstdio>

namespace axiscal {
namespace {

constexpr int code_rate = 8, code_firmware = 10, code_head = 20, code_flags = 112;
constexpr std::int64_t flag_eight_bit_phase = 2;
/// Code 112 comes once in a 32-record cycle: two cycles without it mean it is not sent.
constexpr int records_to_wait_for_flags = 64;
/// uMD1: the bits that are clear in a phase of 0..511 (-512..511 with sign).
constexpr std::int64_t umd1_error_bits = 0x7E00;

} // namespace

void UmdFacts::learn(std::int64_t code, std::int64_t data) {
    // Counted only as far as it is asked for: a month of records is more than an int holds.
    if (firmware_word_ && records_since_firmware_ < records_to_wait_for_flags)
        ++records_since_firmware_;
    if (code == code_rate && data > 0) rate_Hz_ = static_cast<double>(data) / 100;
    if (code == code_firmware && data > 0) firmware_word_ = data;
    if (code == code_flags) flags_ = data;
    if (code != code_head || data < 0) return;
    homodyne_axes_ = static_cast<int>(data & 0xFF);
    const int counts = static_cast<int>((data >> 8) & 0xFF);
    if (counts > 0) told_counts_ = counts;
}

/// Each family has rates of its own: uMD0 244.14, uMD1 305.17 to 732.42, uMD2 1000 records a
/// second.
UmdFamily UmdFacts::family() const {
    if (!rate_Hz_) return UmdFamily::unknown;
    if (*rate_Hz_ < 260) return UmdFamily::umd0;
    return *rate_Hz_ < 900 ? UmdFamily::umd1 : UmdFamily::umd2;
}

std::optional<UmdHead> UmdFacts::head() const {
    if (setup_.head) return setup_.head;
    if (homodyne_axes_) return *homodyne_axes_ == 0 ? UmdHead::heterodyne : UmdHead::homodyne;
    // The uMD1 knows heterodyne heads only and never sends code 20.
    return family() == UmdFamily::umd1 ? std::optional{UmdHead::heterodyne} : std::nullopt;
}

std::optional<int> UmdFacts::counts_per_cycle() const {
    if (setup_.counts_per_cycle) return setup_.counts_per_cycle;
    if (told_counts_) return told_counts_;
    return family() == UmdFamily::umd1 ? std::optional{1} : std::nullopt;
}

/// uMD2 from v260 on (but not v3.xx, printed as 300..399) numbers whole versions, with a
/// subversion in the high word; before, the word is version x 100.
bool UmdFacts::integer_numbering() const {
    const std::int64_t version = firmware_word_.value_or(0) & 0xFFFF;
    return family() == UmdFamily::umd2 &&
           ((version >= 260 && version < 300) || version >= 400 || *firmware_word_ > 0xFFFF);
}

std::optional<UmdPhase> UmdFacts::phase() const {
    if (setup_.phase) return setup_.phase;
    if (head() == UmdHead::homodyne) return UmdPhase::none;
    if (family() == UmdFamily::umd1) return UmdPhase::masked;
    if (family() == UmdFamily::umd0) return UmdPhase::none;
    if (family() == UmdFamily::unknown || !firmware_word_) return std::nullopt;
    if (!integer_numbering())
        return *firmware_word_ == 315 ? UmdPhase::truncated : UmdPhase::eight_bit;
    if (flags_)
        return (*flags_ & flag_eight_bit_phase) != 0 ? UmdPhase::eight_bit : UmdPhase::sixteen_bit;
    if (records_since_firmware_ < records_to_wait_for_flags) return std::nullopt;
    return UmdPhase::sixteen_bit;
}

bool UmdFacts::complete() const {
    return rate_Hz_ && head() && (setup_.resolution || counts_per_cycle()) && phase();
}

std::string UmdFacts::missing() const {
    std::string text;
    if (!rate_Hz_) text += " record rate (code 8)";
    if (!head()) text += " head (code 20, or key head)";
    if (!setup_.resolution && !counts_per_cycle())
        text += " counts per cycle (code 20, or key counts_per_cycle)";
    if (!phase()) text += " phase format (code 10, or key phase)";
    return "not reported by the instrument:" + text;
}

std::string UmdFacts::contradiction() const {
    if (setup_.counts_per_cycle && told_counts_ && *setup_.counts_per_cycle != *told_counts_)
        return "counts_per_cycle = " + std::to_string(*setup_.counts_per_cycle) +
               " is configured and used, the instrument says " + std::to_string(*told_counts_);
    if (setup_.resolution && homodyne_axes_ && *homodyne_axes_ == 0)
        return "a scale (resolution) is configured, the instrument says heterodyne: it counts no "
               "A-quad-B";
    if (setup_.head && homodyne_axes_ &&
        (*setup_.head == UmdHead::homodyne) != (*homodyne_axes_ > 0))
        return "the configured head is used, the instrument says " +
               std::string{*homodyne_axes_ > 0 ? "homodyne" : "heterodyne"};
    return {};
}

std::string UmdFacts::model() const {
    switch (family()) {
    case UmdFamily::umd0: return "uMD0";
    case UmdFamily::umd1: return "uMD1";
    case UmdFamily::umd2: return "uMD2";
    case UmdFamily::unknown: break;
    }
    return "uMD";
}

std::string UmdFacts::firmware() const {
    if (!firmware_word_) return {};
    const auto word = static_cast<long long>(*firmware_word_);
    std::array<char, 32> text{};
    if (family() == UmdFamily::umd1 && word < 100)
        std::snprintf(text.data(), text.size(), "%lld", word);
    else if (integer_numbering())
        std::snprintf(text.data(), text.size(), "%lld.%02lld", word & 0xFFFF, word >> 16);
    else
        std::snprintf(text.data(), text.size(), "%.2f", static_cast<double>(word) / 100);
    return text.data();
}

double UmdFacts::metres_per_count() const {
    if (setup_.resolution) return setup_.resolution->in(metre);
    return setup_.wavelength.in(metre) / (setup_.optical_fold * *counts_per_cycle());
}

std::optional<double> umd_position(std::int64_t displacement, std::int64_t phase, UmdPhase format) {
    const auto counts = static_cast<double>(displacement);
    const auto fraction = static_cast<double>(phase);
    switch (format) {
    case UmdPhase::none: return counts;
    case UmdPhase::eight_bit: return counts - fraction / 256;
    case UmdPhase::sixteen_bit: return counts - fraction / 65536;
    case UmdPhase::masked:
        if (phase >= 0 && (phase & umd1_error_bits) != 0) return std::nullopt;
        return counts - fraction / 256;
    case UmdPhase::truncated: break;
    }
    // v3.15 cuts the count towards zero and keeps the low byte of the phase: above zero a fraction
    // comes out one count low. Within one count of zero both signs print the same: no value.
    if (phase == 0) return counts;
    if (displacement == 0) return std::nullopt;
    return counts - fraction / 256 + (displacement > 0 ? 1 : 0);
}

} // namespace axiscal
