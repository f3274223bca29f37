#include "analysis/uncertainty/figure_tally.hpp"

#include "analysis/uncertainty/lane_inline.hpp"

#include <limits>

namespace axiscal {

/// The part that is counted once a session: sums and places for all lanes of a figure at once.
struct TallyKernel {
    static AXISCAL_LANE_INLINE void add(FigureTally& tally, const Figures& sessions) {
        constexpr double last = FigureTally::buckets - 1;
        std::uint32_t* counts = tally.counts_.data();
        for (std::size_t f = 0; f < figure_count; ++f, counts += FigureTally::buckets) {
            const double* const value = sessions[f].data();
            double* const sum = tally.sum_[f].data();
            double* const squares = tally.squares_[f].data();
            const double from = tally.evaluated_[f], low = tally.low_[f], scale = tally.scale_[f];
            std::int32_t place[lanes];
            for (std::size_t l = 0; l < lanes; ++l) {
                const double off = value[l] - from;
                sum[l] += off;
                squares[l] += off * off;
                double at = (value[l] - low) * scale;
                at = at > 0 ? at : 0;
                at = at < last ? at : last;
                place[l] = static_cast<std::int32_t>(at);
            }
            for (const std::int32_t bucket : place)
                ++counts[bucket];
        }
    }
};

namespace {

void add_baseline(FigureTally& tally, const Figures& sessions) {
    TallyKernel::add(tally, sessions);
}
AXISCAL_LANE_AVX2 void add_avx2(FigureTally& tally, const Figures& sessions) {
    TallyKernel::add(tally, sessions);
}

/// The counts as a probability that grows in straight pieces from bucket edge to bucket edge.
class Cumulative {
public:
    explicit Cumulative(const std::uint32_t* counts) {
        for (std::size_t b = 0; b < FigureTally::buckets; ++b)
            below_[b + 1] = below_[b] + counts[b];
    }
    [[nodiscard]] double total() const { return below_.back(); }
    [[nodiscard]] double below(std::size_t edge) const { return below_[edge]; }
    /// Where, in buckets from the low end, `count` samples lie below. `bucket` is where the search
    /// starts and is moved on: counts are asked for in ascending order.
    double place_of(double count, std::size_t& bucket) const {
        while (bucket + 1 < FigureTally::buckets && below_[bucket + 1] < count)
            ++bucket;
        const double inside = below_[bucket + 1] - below_[bucket];
        const double part = inside > 0 ? (count - below_[bucket]) / inside : 0;
        return static_cast<double>(bucket) + std::clamp(part, 0.0, 1.0);
    }

private:
    std::array<double, FigureTally::buckets + 1> below_{};
};

Interval symmetric_of(const Cumulative& cumulative, double coverage) {
    const double tail = (1 - coverage) / 2 * cumulative.total();
    std::size_t bucket = 0;
    const double low = cumulative.place_of(tail, bucket);
    return {low, cumulative.place_of(cumulative.total() - tail, bucket)};
}

/// Tried from every bucket edge: near its least the width hardly changes with the place.
Interval shortest_of(const Cumulative& cumulative, double coverage) {
    const double held = coverage * cumulative.total();
    Interval best{0, static_cast<double>(FigureTally::buckets)};
    std::size_t bucket = 0;
    for (std::size_t edge = 0; edge < FigureTally::buckets; ++edge) {
        const double wanted = cumulative.below(edge) + held;
        if (wanted > cumulative.total()) break;
        const double low = static_cast<double>(edge);
        const double high = cumulative.place_of(wanted, bucket);
        if (high - low < best.high - best.low) best = {low, high};
    }
    return best;
}

} // namespace

FigureTally::FigureTally(const std::array<double, figure_count>& evaluated,
                         const std::vector<Figures>& pilot)
    : evaluated_(evaluated)
    , counts_(figure_count * buckets, 0) {
    constexpr double least_margin = 1e-280; // what is narrower counts as constant
    for (std::size_t f = 0; f < figure_count; ++f) {
        double low = std::numeric_limits<double>::max(), high = -low;
        for (const Figures& sessions : pilot)
            for (const double value : sessions[f]) {
                low = std::min(low, value);
                high = std::max(high, value);
            }
        const double margin = (high - low) / 2;
        low_[f] = low - margin;
        scale_[f] =
            margin > least_margin ? static_cast<double>(buckets) / (high - low + 2 * margin) : 0;
    }
}

void FigureTally::add(const Figures& sessions, LaneCode code) {
    (code == LaneCode::avx2 ? add_avx2 : add_baseline)(*this, sessions);
    ++groups_;
}

double FigureTally::mean(std::size_t figure) const {
    double sum = 0;
    for (const double part : sum_[figure])
        sum += part;
    return evaluated_[figure] + sum / trials();
}

double FigureTally::standard_deviation(std::size_t figure) const {
    double sum = 0, squares = 0;
    for (std::size_t l = 0; l < lanes; ++l) {
        sum += sum_[figure][l];
        squares += squares_[figure][l];
    }
    return std::sqrt(std::max(0.0, (squares - sum * (sum / trials())) / (trials() - 1)));
}

CoverageIntervals FigureTally::intervals(std::size_t figure, double coverage) const {
    if (scale_[figure] == 0) return {{low_[figure], low_[figure]}, {low_[figure], low_[figure]}};
    const Cumulative cumulative{counts_.data() + figure * buckets};
    const auto placed = [&](const Interval& interval) {
        return Interval{low_[figure] + interval.low / scale_[figure],
                        low_[figure] + interval.high / scale_[figure]};
    };
    return {placed(symmetric_of(cumulative, coverage)), placed(shortest_of(cumulative, coverage))};
}

} // namespace axiscal
