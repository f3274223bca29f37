#include "analysis/circle/arc_of_points.hpp"

#include "analysis/circle/circle_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace axiscal {
namespace circle {
namespace {

constexpr double whole_turn = 2 * std::numbers::pi;

/// Which of `sectors` equal sectors an angle of atan2 falls into.
std::size_t sector_of(double angle, std::size_t sectors) {
    const double turns = angle / whole_turn + 0.5;
    const auto sector = static_cast<std::size_t>(turns * static_cast<double>(sectors));
    return std::min(sector, sectors - 1);
}

/// First and last angle of a sector.
struct Sector {
    double first = 8, last = -8; ///< beyond any angle: empty
    std::size_t first_index = 0, last_index = 0;
};

} // namespace

WidestGap
widest_gap(std::span<const double> x, std::span<const double> y, double center_x, double center_y) {
    // as many sectors as points: the widest gap cannot hide inside one, and nothing is sorted
    std::vector<Sector> sectors(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double angle = std::atan2(y[i] - center_y, x[i] - center_x);
        Sector& sector = sectors[sector_of(angle, sectors.size())];
        if (angle < sector.first) {
            sector.first = angle;
            sector.first_index = i;
        }
        if (angle > sector.last) {
            sector.last = angle;
            sector.last_index = i;
        }
    }
    const auto is_empty = [](const Sector& sector) { return sector.last < sector.first; };
    std::erase_if(sectors, is_empty);
    WidestGap widest;
    for (std::size_t i = 0; i < sectors.size(); ++i) {
        const Sector& before = i == 0 ? sectors.back() : sectors[i - 1];
        const double turn = i == 0 ? whole_turn : 0;
        const double gap = sectors[i].first + turn - before.last;
        if (gap > widest.angle_rad) widest = {gap, before.last_index, sectors[i].first_index};
    }
    return widest;
}

std::vector<std::size_t> nearest_of_sectors(std::span<const double> x,
                                            std::span<const double> y,
                                            double center_x,
                                            double center_y) {
    constexpr std::size_t sectors = 64;
    struct Nearest {
        double squared = -1; // none yet
        std::size_t index = 0;
    };
    std::array<Nearest, sectors> nearest{};
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double dx = x[i] - center_x, dy = y[i] - center_y, squared = dx * dx + dy * dy;
        Nearest& best = nearest[sector_of(std::atan2(dy, dx), sectors)];
        if (best.squared < 0 || squared < best.squared) best = {squared, i};
    }
    std::vector<std::size_t> indices;
    for (const Nearest& best : nearest)
        if (best.squared >= 0) indices.push_back(best.index);
    return indices;
}

} // namespace circle

double arc_of_points_deg(std::span<const double> x,
                         std::span<const double> y,
                         double center_x,
                         double center_y) {
    if (x.empty()) return 0;
    const circle::WidestGap gap = circle::widest_gap(x, y, center_x, center_y);
    return std::max(0.0, 360 - gap.angle_rad * 180 / std::numbers::pi);
}

} // namespace axiscal
