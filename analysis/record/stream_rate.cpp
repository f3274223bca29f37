#include "analysis/record/stream_rate.hpp"

#include <cmath>

namespace axiscal {

double nominal_rate_hz(double periods, Duration span) {
    if (!(periods > 0) || span <= Duration{}) return 0;
    const double value = periods / seconds_of(span);
    const double unit = std::pow(10, std::floor(std::log10(value)) - 2);
    return std::round(value / unit) * unit;
}

double nominal_rate_hz(const StreamSamples& stream) {
    if (stream.at.size() < 2) return 0;
    auto periods = static_cast<double>(stream.at.size() - 1);
    for (const StreamGap& gap : stream.gaps)
        if (gap.at > 0) periods += static_cast<double>(gap.missing);
    return nominal_rate_hz(periods, stream.at.back() - stream.at.front());
}

} // namespace axiscal
