#include "acquisition/run/principal_positions.hpp"

#include "acquisition/capture/wording.hpp"
#include "acquisition/run/target_positions.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal {
namespace {

constexpr Length quarter = 90.0_mm, turn = 360.0_mm;
constexpr Length near = 1.0_nm; // decimal coordinates in binary

std::vector<Length> principal_positions(Length low, Length high) {
    std::vector<Length> positions;
    const auto first = static_cast<int>(std::ceil((low - near) / quarter));
    const auto last = static_cast<int>(std::floor((high + near) / quarter));
    for (int k = first; k <= last; ++k)
        positions.push_back(quarter * k);
    return positions;
}

/// Nearest place of the grid; below 0 where there is none as near as its random part may be.
int place_at(Length position, Length first, Length interval, int count) {
    const int place = std::clamp(static_cast<int>(std::lround((position - first) / interval)), 0,
                                 std::max(count - 1, 0));
    const Length beside = abs(position - first - interval * place);
    return beside <= interval * random_share + near ? place : -1;
}

/// 0 and 360 degrees are one place.
bool stands_at(Length target, Length position) {
    return std::fabs(std::remainder((target - position) / turn, 1.0)) <= near / turn;
}

int places_up_to(Length first, Length high, Length interval) {
    const Length reach = interval * random_share;
    int count = 0;
    while (true) {
        const Length place = first + interval * count;
        if (place + (is_principal_position(place) ? Length{} : reach) > high + near) return count;
        ++count;
    }
}

long covered(Length first, Length low, Length high, Length interval) {
    const int count = places_up_to(first, high, interval);
    return std::ranges::count_if(principal_positions(low, high), [&](Length position) {
        return count > 0 && place_at(position, first, interval, count) >= 0;
    });
}

} // namespace

bool is_principal_position(Length coordinate) {
    return abs(coordinate - quarter * std::round(coordinate / quarter)) <= near;
}

Length first_for_principal_positions(Length low, Length high, Length interval, int least_places) {
    const Length usual =
        target_step * std::ceil((low + interval * random_share) / target_step - 1e-6);
    Length best = usual;
    long most = covered(usual, low, high, interval);
    for (const Length position : principal_positions(low, high)) {
        // The lowest place of a grid through this position that its own random part leaves inside.
        Length first = position - interval * std::floor((position - low + near) / interval);
        if (!is_principal_position(first) && first < usual - near) first += interval;
        if (places_up_to(first, high, interval) < least_places) continue;
        const long found = covered(first, low, high, interval);
        if (found > most || (found == most && first < best)) best = first, most = found;
    }
    return best;
}

void take_principal_positions(
    std::vector<Length>& targets, Length first, Length interval, Length low, Length high) {
    const int count = static_cast<int>(targets.size());
    for (const Length position : principal_positions(low, high))
        if (const int place = place_at(position, first, interval, count); place >= 0)
            targets[static_cast<std::size_t>(place)] = position;
}

std::string
missing_principal_positions(const std::vector<Length>& targets, Length low, Length high) {
    std::string missing;
    for (const Length position : principal_positions(low, high)) {
        const bool taken = std::ranges::any_of(
            targets, [&](Length target) { return stands_at(target, position); });
        if (!taken) missing += (missing.empty() ? "" : ", ") + plain_number(position.in(mm), 0);
    }
    return missing;
}

} // namespace axiscal
