#pragma once
// A station that measures the straightness of its axis: a Wollaston prism before the laser.

#include "acquisition/measurement/straightness/straightness_config.hpp"
#include "config/settings.hpp"
#include "tests/unit/station/station_bench.hpp"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace axiscal::testing {

inline constexpr double factor_across = 36;

/// Five targets, once from each side: ten points, the same that Shop::plan() gives.
class StraightnessShop : public Shop {
public:
    StraightnessShop() {
        config.cycle.interval.reset();
        config.cycle.target_count.reset();
        config.cycle.first_target.reset();
        config.cycle.seed.reset();
        config.cycle.targets = std::vector<Length>{mm(70), mm(270), mm(470), mm(670), mm(870)};
        config.cycle.approaches = 1;
        state_table("across = \"Y\"\nsign = 1\nfactor = 36\n");
        axis.go(0, now);
        reading_m = [this](MonotonicTime at) {
            return deviation_um(axis.at(at)) * 1e-6 / factor_across;
        };
    }
    /// What [straightness] says from now on.
    void state_table(const std::string& keys) {
        auto document = SettingsDocument::parse("[straightness]\n" + keys, "station.toml").value();
        Settings table = document.root().table("straightness");
        KindSection section{TestKind::straightness, table,
                            read_straightness_section(table, config)};
        EXPECT_TRUE(document.finish().empty()) << keys;
        config.kind_sections.clear();
        config.kind_sections.push_back(std::move(section));
    }
    /// Of the motion at a coordinate, in micrometres: a bow of 10 um on a slope.
    std::function<double(double)> deviation_um = [](double x_mm) {
        const double share = x_mm / 1000;
        return 20 * share + 40 * share * (1 - share);
    };
};

inline ArmRequest order_of_straightness() {
    ArmRequest request;
    request.kind = TestKind::straightness;
    request.pass = "straightness";
    return request;
}

} // namespace axiscal::testing
