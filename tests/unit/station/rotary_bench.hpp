#pragma once
// Stations of a rotary axis: behind an indexing table, and before the faces of a polygon.

#include "station_bench.hpp"

#include <cmath>
#include <numbers>

namespace axiscal::testing {

inline constexpr double rad = std::numbers::pi / 180, arm_mm = 32.61, step_deg = 5;

/// Five targets over a quarter turn, once from each side: ten points.
inline void make_rotary(Shop& shop) {
    CycleConfig& cycle = shop.config.cycle;
    cycle.axis_kind = AxisKind::rotary;
    cycle.travel_low = mm(-3);
    cycle.travel_high = mm(95);
    cycle.interval.reset();
    cycle.target_count.reset();
    cycle.first_target.reset();
    cycle.seed.reset();
    cycle.targets = std::vector<Length>{mm(0), mm(31.2), mm(62.9), mm(70), mm(90)};
    cycle.overrun = mm(1);
    cycle.datum = mm(-2);
    cycle.near_tolerance = mm(0.2);
    cycle.approaches = 1;
    shop.config.capture.spread_limit = mm(1.0 / 3600);
    shop.config.capture.fastest = metre_per_second(50); // the table of this bench turns at once
    shop.config.axis.material_temperature.clear();
    AngleConfig& angle = shop.config.axis.angle.emplace();
    angle.setup.step_deg = step_deg;
    angle.setup.arm = mm(arm_mm);
    angle.artefact.name = "indexing table";
    angle.artefact.serial = "T-7";
    shop.axis.speed_mm_per_s = 50;
}

/// The axis with two seconds of arc of lost motion each way, and the table on it.
class TableShop : public Shop {
public:
    TableShop() {
        make_rotary(*this);
        axis.go(-2, now);
        reading_m = [this](MonotonicTime at) {
            const double rest = axis.at(at) + error_deg + 2 - position * step_deg;
            return arm_mm * 1e-3 * std::sin(rest * rad) * (1 + 2.7e-4);
        };
    }
    int position = 0;
    double error_deg = 0;
};

/// Eight faces over a turn; the readings are typed.
class PolygonShop : public Shop {
public:
    PolygonShop() {
        make_rotary(*this);
        config.cycle.travel_low = mm(-2);
        config.cycle.travel_high = mm(362);
        config.cycle.overrun = mm(2);
        config.cycle.datum.reset();
        config.cycle.targets = std::vector<Length>{};
        for (int face = 0; face < 8; ++face)
            config.cycle.targets->push_back(mm(45 * face));
        config.axis.laser = config.axis.air_temperature = {};
        config.axis.air_pressure = config.axis.air_humidity = {};
        RotarySetup& setup = config.axis.angle->setup;
        setup.method = AngleMethod::polygon;
        setup.step_deg = 45;
        setup.range_deg = 0.1;
        setup.arm = {};
        setup.deviations_arcsec = {0, 1, -2, 0, 0, 0, 0, 0.5};
        config.axis.angle->artefact.name = "polygon";
    }
    /// An axis that leads by 3 seconds of arc, seen through the polygon.
    [[nodiscard]] double arcsec_at(const PlannedPoint& point) const {
        const auto& faces = config.axis.angle->setup.deviations_arcsec;
        return 3.0 * static_cast<int>(point.direction) +
               faces[static_cast<std::size_t>(point.target_index)];
    }
};

/// A drift test of 20 s, once a second, where the axis stands.
inline std::optional<Result<std::string>> test_drift(Life& life) {
    DriftRequest request;
    request.duration = 20s;
    request.interval = 1s;
    const auto answer = life.begin_drift(request);
    life.run(25s);
    return *answer;
}

inline RevisionRequest again_of_target_2() {
    RevisionRequest request;
    request.selection.target = 2;
    request.reason = "coolant on the face";
    return request;
}

} // namespace axiscal::testing
