#include "acquisition/measurement/straightness/across_rule.hpp"

#include "acquisition/capture/wording.hpp"

#include <string>

namespace axiscal {
namespace {

class AcrossRule final : public ReadingRule {
public:
    AcrossRule(const StraightnessSetup& setup, Length range)
        : sign_{setup.sign}
        , factor_{setup.factor}
        , range_{range} {}

    [[nodiscard]] Result<Length> position_of(const DatumRecord& datum,
                                             Length reading,
                                             double /*scale_minus_1*/,
                                             Length target) const override;
    [[nodiscard]] int sign() const override { return sign_; }
    [[nodiscard]] Length least_reading_of_way(Length /*way*/) const override { return {}; }
    [[nodiscard]] Length way_of_reading(Length /*change*/) const override { return {}; }
    [[nodiscard]] bool sees_every_place() const override { return false; }
    [[nodiscard]] std::string hint(Length /*beside*/) const override { return {}; }
    [[nodiscard]] bool shows_place() const override { return false; }
    [[nodiscard]] Length deviation_of(const DatumRecord& datum,
                                      Length reading,
                                      Length /*position*/,
                                      Length /*target*/) const override {
        return deviation(datum, reading);
    }

private:
    [[nodiscard]] Length deviation(const DatumRecord& datum, Length reading) const {
        return (reading - datum.reading) * (sign_ * factor_);
    }
    [[nodiscard]] std::string beyond_range(Length deviation, Length way) const;

    int sign_;
    double factor_;
    Length range_;
};

Result<Length> AcrossRule::position_of(const DatumRecord& datum,
                                       Length reading,
                                       double /*scale_minus_1*/,
                                       Length target) const {
    const Length seen = deviation(datum, reading);
    if (abs(seen) <= range_) return target;
    return fail(Fault::outside_window, beyond_range(seen, abs(target - datum.coordinate)));
}

/// Nearly always the optics are not aligned to the axis: the deviation grows with the way.
std::string AcrossRule::beyond_range(Length deviation, Length way) const {
    const std::string leaves =
        " leaves the range of the optics (+- " + in_mm(range_) + "): align the mirror.";
    if (way <= Length{}) return "A deviation of " + in_mm(deviation) + leaves;
    return "A slope of " + plain_number(deviation.in(um) / way.in(mm), 2) + " um/mm over " +
           in_mm(way) + leaves;
}

} // namespace

std::shared_ptr<const ReadingRule> across_the_axis(const StraightnessSetup& setup, Length range) {
    return std::make_shared<const AcrossRule>(setup, range);
}

} // namespace axiscal
