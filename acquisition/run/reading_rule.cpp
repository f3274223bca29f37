#include "acquisition/run/reading_rule.hpp"

#include "acquisition/capture/wording.hpp"
#include "acquisition/run/live_position.hpp"
#include "analysis/rotary/rotary_position.hpp"

#include <cmath>
#include <cstdlib>
#include <utility>

namespace axiscal {
namespace {

class AlongTheAxis final : public ReadingRule {
public:
    explicit AlongTheAxis(LaserSetup laser)
        : laser_{std::move(laser)} {}

    [[nodiscard]] Result<Length> position_of(const DatumRecord& datum,
                                             Length reading,
                                             double scale_minus_1,
                                             Length /*target*/) const override {
        return live_position(laser_, datum, reading, scale_minus_1);
    }
    [[nodiscard]] int sign() const override { return laser_.sign; }
    [[nodiscard]] Length least_reading_of_way(Length way) const override { return way; }
    [[nodiscard]] Length way_of_reading(Length change) const override { return change; }
    [[nodiscard]] bool sees_every_place() const override { return true; }
    [[nodiscard]] std::string hint(Length /*beside*/) const override { return {}; }

private:
    LaserSetup laser_;
};

/// The artefact may stand at any of its positions: a reading shows a place near the target alone.
class AgainstArtefact final : public ReadingRule {
public:
    AgainstArtefact(RotarySetup setup, int sign)
        : setup_{std::move(setup)}
        , sign_{sign} {}

    [[nodiscard]] Result<Length> position_of(const DatumRecord& datum,
                                             Length reading,
                                             double scale_minus_1,
                                             Length target) const override {
        const int index = artefact_index(setup_, datum.coordinate, target);
        return rotary_position(setup_, sign_, datum, reading, scale_minus_1, index);
    }
    [[nodiscard]] int sign() const override { return sign_; }
    [[nodiscard]] Length least_reading_of_way(Length way) const override {
        return axiscal::least_reading_of_way(setup_, way);
    }
    [[nodiscard]] Length way_of_reading(Length change) const override {
        return change / reading_per_coordinate(setup_);
    }
    [[nodiscard]] bool sees_every_place() const override { return false; }
    [[nodiscard]] std::string hint(Length beside) const override;

private:
    RotarySetup setup_;
    int sign_;
};

/// What is off by whole steps is the table, not the axis.
std::string AgainstArtefact::hint(Length beside) const {
    constexpr double share_of_step = 0.1;
    if (setup_.method == AngleMethod::polygon) return {};
    const double steps = beside.in(mm) / setup_.step_deg;
    const auto whole = std::lround(steps);
    if (whole == 0 || std::abs(steps - static_cast<double>(whole)) > share_of_step) return {};
    return "; this is what an indexing table shows that stands " +
           counted(std::labs(whole), "step") +
           (whole > 0 ? " short of its position" : " beyond its position");
}

} // namespace

std::shared_ptr<const ReadingRule> along_the_axis(LaserSetup laser) {
    return std::make_shared<const AlongTheAxis>(std::move(laser));
}

std::shared_ptr<const ReadingRule> against_artefact(RotarySetup setup, int sign) {
    return std::make_shared<const AgainstArtefact>(std::move(setup), sign);
}

std::shared_ptr<const ReadingRule> positions_of(const RunRecord& header) {
    return header.rotary ? against_artefact(*header.rotary, header.laser.sign)
                         : along_the_axis(header.laser);
}

} // namespace axiscal
