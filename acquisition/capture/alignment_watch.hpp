#pragma once
// Watches the laser while its beam is aligned: strength along the travel, and the highest reading
// at the far end. Time comes with the samples.

#include "analysis/record/alignment_record.hpp"
#include "drivers/sample.hpp"

#include <map>
#include <optional>

namespace axiscal {

/// Loop-bound; memory is bounded by the travel (some hundred stretches at most).
///
/// Readings rise away from the interferometer, so the smallest one is the near end. The axis rests
/// where the readings of a block of 0.2 s lie within `spread_limit`. At rest the reading changes
/// only as the beam is steered, and by no more than D (1 - cos 10 mrad): a larger step is motion,
/// and a new rest begins. The rest that counts is the latest one farther away than nine tenths of
/// all that was reached, and than `least_distance`.
class AlignmentWatch {
public:
    static constexpr Length least_distance = mm(50); ///< below it no cosine error can be seen

    AlignmentWatch(Length travel, Length spread_limit);

    /// A sample of the laser, good or bad, and the strength told at that time, if any. A counter
    /// that lost its zero makes all distances before it worthless: they are given up.
    void take(const Sample& sample, std::optional<double> strength_percent);

    /// All but the names and the times, which are left to the one who has them.
    [[nodiscard]] AlignmentRecord record() const;
    /// From the nearest reading; empty while the signal is bad.
    [[nodiscard]] std::optional<Length> distance() const;
    /// The steadiness of the last whole block.
    [[nodiscard]] bool at_rest() const { return at_rest_; }

private:
    struct Place {
        int readings = 0;
        double weakest = 0, sum = 0, last = 0;
    };
    /// Consecutive readings, relative to the first one of all.
    struct Block {
        MonotonicTime begin{};
        int readings = 0;
        double sum_m = 0, low_m = 0, high_m = 0;
    };
    struct Rest {
        FarRest far;
        double lowest_before_m = 0, lowest_after_m = 0; ///< the highest reading
        double spread_of_highest_m = 0;                 ///< within its block
    };

    void forget();
    void add_strength(double reading_m, double strength_percent);
    void add_to_block(const Sample& sample, double reading_m);
    void end_block();
    void rest_at(double mean_m, double spread_m);
    [[nodiscard]] bool is_same_rest(double mean_m) const;

    Length travel_, spread_limit_;
    double place_width_m_;
    std::optional<std::uint32_t> epoch_;
    std::optional<double> first_m_, last_m_; ///< last: none while the signal is bad
    double nearest_m_ = 0, farthest_m_ = 0;  ///< relative to the first reading, as all below
    std::map<long, Place> places_;           ///< by whole stretches from the first reading
    std::optional<Block> block_;
    std::optional<Rest> rest_;
    std::optional<FarRest> far_;
    int readings_ = 0, lost_ = 0, restarts_ = 0;
    bool at_rest_ = false;
};

} // namespace axiscal
