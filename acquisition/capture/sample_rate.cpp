#include "acquisition/capture/sample_rate.hpp"

#include "analysis/record/stream_rate.hpp"

namespace axiscal {
namespace {

constexpr Duration span = std::chrono::seconds{1};

} // namespace

void SampleRate::take(const Sample& sample) {
    if (!began_ || sample.at < *began_) {
        began_ = sample.at;
        n_ = 0;
        return;
    }
    ++n_;
    if (sample.at - *began_ < span) return;
    last_hz_ = nominal_rate_hz(static_cast<double>(n_), sample.at - *began_);
    began_ = sample.at;
    n_ = 0;
}

double SampleRate::hz() const {
    return last_hz_;
}

} // namespace axiscal
