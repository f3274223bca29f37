#include "acquisition/capture/alignment_watch.hpp"

#include <algorithm>
#include <cmath>

namespace axiscal {
namespace {

constexpr Duration block_length = std::chrono::milliseconds{200};
constexpr int fewest_of_block = 4;
constexpr double places_of_travel = 25;
constexpr std::size_t most_places = 500; ///< a reading that runs away must not take the memory
constexpr double far_share = 0.9;
/// 1 - cos of 10 mrad: a beam that leaves the optics sooner has no signal left.
constexpr double largest_cosine_share = 5e-5;

} // namespace

AlignmentWatch::AlignmentWatch(Length travel, Length spread_limit)
    : travel_{travel}
    , spread_limit_{spread_limit}
    , place_width_m_{std::max(travel.si(), 1e-3) / places_of_travel} {}

void AlignmentWatch::forget() {
    ++restarts_;
    first_m_.reset();
    last_m_.reset();
    nearest_m_ = farthest_m_ = 0;
    places_.clear();
    block_.reset();
    rest_.reset();
    far_.reset();
    at_rest_ = false;
}

void AlignmentWatch::take(const Sample& sample, std::optional<double> strength_percent) {
    const auto value = sample.value();
    if (!value) {
        ++lost_;
        last_m_.reset();
        block_.reset();
        at_rest_ = false;
        return;
    }
    if (epoch_ && *epoch_ != sample.epoch) forget();
    epoch_ = sample.epoch;
    if (!first_m_) first_m_ = *value;
    const double reading_m = *value - *first_m_;
    last_m_ = reading_m;
    ++readings_;
    nearest_m_ = std::min(nearest_m_, reading_m);
    farthest_m_ = std::max(farthest_m_, reading_m);
    if (strength_percent) add_strength(reading_m, *strength_percent);
    add_to_block(sample, reading_m);
}

void AlignmentWatch::add_strength(double reading_m, double strength_percent) {
    const long key = std::lround(std::floor(reading_m / place_width_m_));
    if (!places_.contains(key) && places_.size() >= most_places) return;
    Place& place = places_[key];
    place.weakest =
        place.readings == 0 ? strength_percent : std::min(place.weakest, strength_percent);
    place.sum += strength_percent;
    place.last = strength_percent;
    ++place.readings;
}

void AlignmentWatch::add_to_block(const Sample& sample, double reading_m) {
    if (block_ && sample.at - block_->begin >= block_length) end_block();
    if (!block_) block_ = Block{sample.at, 0, 0, reading_m, reading_m};
    ++block_->readings;
    block_->sum_m += reading_m;
    block_->low_m = std::min(block_->low_m, reading_m);
    block_->high_m = std::max(block_->high_m, reading_m);
}

void AlignmentWatch::end_block() {
    const Block block = *block_;
    block_.reset();
    const double spread_m = block.high_m - block.low_m;
    at_rest_ = block.readings >= fewest_of_block && spread_m <= spread_limit_.si();
    if (at_rest_) rest_at(block.sum_m / block.readings, spread_m);
}

bool AlignmentWatch::is_same_rest(double mean_m) const {
    if (!rest_) return false;
    const double reach_m = rest_->far.highest.si() - nearest_m_;
    const double zone_m = std::max(reach_m * largest_cosine_share, spread_limit_.si());
    return std::fabs(mean_m - rest_->far.highest.si()) <= zone_m;
}

void AlignmentWatch::rest_at(double mean_m, double spread_m) {
    if (!is_same_rest(mean_m)) {
        rest_ = Rest{{}, mean_m, mean_m, spread_m};
        rest_->far.highest = metre(mean_m);
    }
    FarRest& far = rest_->far;
    if (mean_m > far.highest.si()) {
        // Back at a maximum that was passed before, a little higher by chance: it stays passed.
        const bool same = far.passed_maximum && mean_m - far.highest.si() <= 2 * far.scatter.si();
        if (!same) {
            rest_->lowest_before_m = std::min(rest_->lowest_before_m, rest_->lowest_after_m);
            rest_->lowest_after_m = mean_m;
        }
        rest_->spread_of_highest_m = spread_m;
        far.highest = metre(mean_m);
    }
    rest_->lowest_after_m = std::min(rest_->lowest_after_m, mean_m);
    far.last = metre(mean_m);
    far.scatter = metre(std::max(rest_->spread_of_highest_m, spread_m));
    far.distance = far.highest - metre(nearest_m_);
    ++far.blocks;
    const double clear_m = 2 * far.scatter.si(), highest_m = far.highest.si();
    far.passed_maximum =
        highest_m - rest_->lowest_before_m > clear_m && highest_m - rest_->lowest_after_m > clear_m;
    const bool is_far = far.distance >= least_distance &&
                        far.distance.si() >= far_share * (farthest_m_ - nearest_m_);
    if (is_far) far_ = far;
}

std::optional<Length> AlignmentWatch::distance() const {
    if (!last_m_) return std::nullopt;
    return metre(*last_m_ - nearest_m_);
}

AlignmentRecord AlignmentWatch::record() const {
    AlignmentRecord record;
    record.travel = travel_;
    record.reached = metre(farthest_m_ - nearest_m_);
    record.readings = readings_;
    record.lost = lost_;
    record.restarts = restarts_;
    record.far = far_;
    if (record.far && first_m_) {
        record.far->highest += metre(*first_m_);
        record.far->last += metre(*first_m_);
    }
    record.places.reserve(places_.size());
    for (const auto& [key, place] : places_) {
        const double begin_m = static_cast<double>(key) * place_width_m_ - nearest_m_;
        record.places.push_back({metre(std::max(begin_m, 0.0)), metre(begin_m + place_width_m_),
                                 place.readings, place.weakest, place.sum / place.readings,
                                 place.last});
    }
    return record;
}

} // namespace axiscal
