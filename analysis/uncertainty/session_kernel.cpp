#include "analysis/uncertainty/session_kernel.hpp"

#include "analysis/uncertainty/lane_inline.hpp"

namespace axiscal {
namespace {

using Common = std::array<double, lanes>;

template <class Numbers> AXISCAL_LANE_INLINE void raise(Numbers& high, const Numbers& value) {
    high = value > high ? value : high;
}
template <class Numbers> AXISCAL_LANE_INLINE void lower(Numbers& low, const Numbers& value) {
    low = value < low ? value : low;
}

/// Mean and variance of every row, for the lanes from `first` on.
template <std::size_t bytes>
AXISCAL_LANE_INLINE void rows(const SessionModel& model,
                              const double* draws,
                              const Common& common,
                              std::size_t first,
                              SessionScratch& scratch) {
    using Numbers = typename lane::Vector<bytes>::numbers;
    const std::size_t n = model.approaches, m = model.targets;
    const double inverse_n = 1 / static_cast<double>(n);
    const double inverse_dof = n > 1 ? 1 / static_cast<double>(n - 1) : 0;
    const double* draw = draws + first;
    const double* residual = model.residual.data();
    Numbers shared;
    std::memcpy(&shared, &common[first], bytes);
    for (std::size_t row = 0; row < 2 * m; ++row) {
        Numbers sum{}, squares{};
        for (std::size_t j = 0; j < n; ++j, draw += lanes, ++residual) {
            Numbers value;
            std::memcpy(&value, draw, bytes);
            value = value * model.environment + *residual;
            sum += value;
            squares += value * value;
        }
        const Numbers off = sum * inverse_n; // about the measured mean: no digits are lost
        Numbers variance = (squares - sum * off) * inverse_dof;
        const Numbers mean = off + shared * model.shape[row < m ? row : row - m] + model.mean[row];
        variance = variance > 0.0 ? variance : Numbers{};
        for (std::size_t l = 0; l < lane::Vector<bytes>::width; ++l)
            variance[l] = std::sqrt(variance[l]);
        variance *= model.cover_factor;
        std::memcpy(&scratch.mean[row * lanes + first], &mean, bytes);
        std::memcpy(&scratch.spread[row * lanes + first], &variance, bytes);
    }
}

/// Extremes over the targets, for the lanes from `first` on.
template <std::size_t bytes>
AXISCAL_LANE_INLINE void extremes(const SessionModel& model,
                                  const SessionScratch& scratch,
                                  std::size_t first,
                                  Figures& out) {
    using Numbers = typename lane::Vector<bytes>::numbers;
    const std::size_t m = model.targets;
    constexpr double far = 1e300;
    const Numbers low{}, start = low - far, end = low + far;
    Numbers up_high = start, up_low = end, down_high = start, down_low = end;
    Numbers a_up_high = start, a_up_low = end, a_down_high = start, a_down_low = end;
    Numbers mid_high = start, mid_low = end, s_up{}, s_down{}, r_both{}, b_high{}, b_sum{};
    for (std::size_t i = 0; i < m; ++i) {
        Numbers up, down, up_s, down_s;
        std::memcpy(&up, &scratch.mean[i * lanes + first], bytes);
        std::memcpy(&down, &scratch.mean[(m + i) * lanes + first], bytes);
        std::memcpy(&up_s, &scratch.spread[i * lanes + first], bytes);
        std::memcpy(&down_s, &scratch.spread[(m + i) * lanes + first], bytes);
        raise(up_high, up), lower(up_low, up), raise(down_high, down), lower(down_low, down);
        raise<Numbers>(a_up_high, up + up_s), lower<Numbers>(a_up_low, up - up_s);
        raise<Numbers>(a_down_high, down + down_s), lower<Numbers>(a_down_low, down - down_s);
        const Numbers twice_mean = up + down, reversal = up - down;
        raise(mid_high, twice_mean), lower(mid_low, twice_mean);
        const Numbers gap = reversal > -reversal ? reversal : -reversal;
        raise(b_high, gap);
        b_sum += reversal;
        raise(s_up, up_s), raise(s_down, down_s), raise<Numbers>(r_both, up_s + down_s + gap);
    }
    const Numbers r_up = s_up * 2.0, r_down = s_down * 2.0;
    raise(r_both, r_up), raise(r_both, r_down);
    const Numbers e_up = up_high - up_low, e_down = down_high - down_low;
    const Numbers a_up = a_up_high - a_up_low, a_down = a_down_high - a_down_low;
    raise(up_high, down_high), lower(up_low, down_low);
    raise(a_up_high, a_down_high), lower(a_up_low, a_down_low);
    const Numbers all[figure_count]{a_up_high - a_up_low,
                                    a_up,
                                    a_down,
                                    up_high - up_low,
                                    e_up,
                                    e_down,
                                    (mid_high - mid_low) * 0.5,
                                    r_both,
                                    r_up,
                                    r_down,
                                    b_high,
                                    b_sum * (1 / static_cast<double>(m))};
    for (std::size_t f = 0; f < figure_count; ++f)
        std::memcpy(&out[f][first], &all[f], bytes);
}

template <std::size_t bytes>
AXISCAL_LANE_INLINE void evaluate(const SessionModel& model,
                                  const double* draws,
                                  const Common& common,
                                  SessionScratch& scratch,
                                  Figures& out) {
    constexpr std::size_t width = lane::Vector<bytes>::width;
    for (std::size_t first = 0; first < lanes; first += width)
        rows<bytes>(model, draws, common, first, scratch);
    for (std::size_t first = 0; first < lanes; first += width)
        extremes<bytes>(model, scratch, first, out);
}

void evaluate_baseline(const SessionModel& model,
                       const double* draws,
                       const Common& common,
                       SessionScratch& scratch,
                       Figures& out) {
    evaluate<16>(model, draws, common, scratch, out);
}

AXISCAL_LANE_AVX2 void evaluate_avx2(const SessionModel& model,
                                     const double* draws,
                                     const Common& common,
                                     SessionScratch& scratch,
                                     Figures& out) {
    evaluate<32>(model, draws, common, scratch, out);
}

} // namespace

SessionScratch::SessionScratch(const SessionModel& model)
    : mean(2 * model.targets * lanes)
    , spread(2 * model.targets * lanes) {}

void evaluate_sessions(const SessionModel& model,
                       const double* draws,
                       const Common& common,
                       SessionScratch& scratch,
                       Figures& figures,
                       LaneCode code) {
    (code == LaneCode::avx2 ? evaluate_avx2 : evaluate_baseline)(model, draws, common, scratch,
                                                                 figures);
}

} // namespace axiscal
