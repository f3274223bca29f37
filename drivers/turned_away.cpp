#include "drivers/turned_away.hpp"

#include <algorithm>

namespace axiscal {
namespace {

constexpr std::size_t most_told = 4;
constexpr Duration day = std::chrono::hours{24};

} // namespace

std::optional<std::string> TurnedAway::take(const std::string& address, MonotonicTime now) {
    if (address.empty()) return std::nullopt; // it has hung up already
    if (!since_ || now - *since_ >= day) {
        told_.clear();
        since_ = now;
    }
    if (told_.size() == most_told || std::ranges::find(told_, address) != told_.end())
        return std::nullopt;
    told_.push_back(address);
    std::string words = address + " away";
    if (told_.size() == most_told) words += "; further addresses are counted, not named, for a day";
    return words;
}

} // namespace axiscal
