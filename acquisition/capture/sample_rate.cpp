#include "acquisition/capture/sample_rate.hpp"

#include <cmath>

namespace axiscal {
namespace {

constexpr Duration span = std::chrono::seconds{1};

double three_digits(double value) {
    if (!(value > 0)) return 0;
    const double unit = std::pow(10, std::floor(std::log10(value)) - 2);
    return std::round(value / unit) * unit;
}

} // namespace

void SampleRate::take(const Sample& sample) {
    if (!began_ || sample.at < *began_) {
        began_ = sample.at;
        n_ = 0;
        return;
    }
    ++n_;
    if (sample.at - *began_ < span) return;
    last_hz_ = three_digits(static_cast<double>(n_) / seconds_of(sample.at - *began_));
    began_ = sample.at;
    n_ = 0;
}

double SampleRate::hz() const {
    return last_hz_;
}

} // namespace axiscal
