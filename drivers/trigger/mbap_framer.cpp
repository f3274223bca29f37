#include "drivers/trigger/mbap_framer.hpp"

namespace axiscal {
namespace {

constexpr std::size_t least_length = 2, most_length = 254;
constexpr std::uint8_t first_exception_function = 0x80;

} // namespace

void MbapFramer::feed(std::span<const std::uint8_t> bytes) {
    held_.insert(held_.end(), bytes.begin(), bytes.end());
}

std::optional<std::vector<std::uint8_t>> MbapFramer::next() {
    if (broken_) return std::nullopt;
    if (held_.size() >= 4 && (held_[2] != 0 || held_[3] != 0)) broken_ = true;
    if (broken_ || held_.size() < mbap_prefix) return std::nullopt;
    const auto length = static_cast<std::size_t>(held_[4] << 8 | held_[5]);
    if (length < least_length || length > most_length) broken_ = true;
    if (held_.size() > mbap_header &&
        (held_[mbap_header] == 0 || held_[mbap_header] >= first_exception_function))
        broken_ = true;
    if (broken_ || held_.size() < mbap_prefix + length) return std::nullopt;
    const auto end = held_.begin() + static_cast<std::ptrdiff_t>(mbap_prefix + length);
    std::vector<std::uint8_t> frame(held_.begin(), end);
    held_.erase(held_.begin(), end);
    return frame;
}

} // namespace axiscal
