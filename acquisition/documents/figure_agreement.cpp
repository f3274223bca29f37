#include "acquisition/documents/figure_agreement.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal {
namespace {

using Json = nlohmann::ordered_json;

bool met_freezing_air(const RunRecord& run) {
    const auto is_air = [&](int channel) {
        return std::ranges::any_of(run.channels, [&](const ChannelRecord& record) {
            return record.id == channel && record.kind == ChannelKind::temperature &&
                   record.medium == Medium::air;
        });
    };
    return std::ranges::any_of(run.environment, [&](const EnvironmentReading& reading) {
        return reading.value < 0 && is_air(reading.channel);
    });
}

} // namespace

bool FigureAgreement::holds(double written, double anew) const {
    return std::fabs(written - anew) <=
           absolute + relative * std::max(std::fabs(written), std::fabs(anew));
}

FigureAgreement agreement_of(const RunRecord& run) {
    const bool arc_sine = run.rotary && run.rotary->method == AngleMethod::indexing_table;
    const bool sine = run.uncertainty && run.uncertainty->misalignment_angle;
    return arc_sine || sine || met_freezing_air(run) ? rounding_of_the_library : same_bits;
}

std::vector<std::string>
disagreements(const Json& written, const Json& anew, const FigureAgreement& agreement) {
    std::vector<std::string> places;
    for (const auto& step : Json::diff(anew, written)) {
        const auto place = step.at("path").get<std::string>();
        const Json::json_pointer at{place};
        const bool two_figures = step.at("op") == "replace" && written.at(at).is_number_float() &&
                                 anew.at(at).is_number_float();
        if (!two_figures ||
            !agreement.holds(written.at(at).get<double>(), anew.at(at).get<double>()))
            places.push_back(place);
    }
    return places;
}

} // namespace axiscal
