#include "acquisition/measurement/positioning/set_up_watch.hpp"

#include "acquisition/capture/sample_summary.hpp"
#include "acquisition/capture/wording.hpp"

#include <utility>

namespace axiscal {
namespace {

constexpr Length reading_slack = mm(0.05); // of two neighbouring readings, beside the axis's speed
constexpr Duration buffer_time = std::chrono::seconds{1}; // older bytes may wait in a USB buffer

} // namespace

void SetUpWatch::take(const Sample& sample, const Run& run) {
    if (!lost_.empty()) return;
    if (!first_) first_ = sample;
    if (!run.known && !settled_ && sample.value() && sample.at - first_->at >= buffer_time)
        settled_ = sample;
    const std::uint32_t epoch = run.known ? run.epoch : first_->epoch;
    const char* const since = run.known && run.of_this_start ? " since the run was closed"
                                                             : " since axiscald was started";
    const std::string of = "the " + reference_ + "'s ";
    if (sample.epoch != epoch)
        lost_ = of + "counter lost its zero" + since;
    else if (sample.quality() == Quality::beam_lost)
        lost_ = of + "beam was interrupted" + since;
    else if (sample.value() && last_ && run.fastest.si() > 0) {
        const auto jump = abs(metre(*sample.value()) - metre(*last_->value()));
        const Duration open = open_between(last_->time_uncertainty, sample.time_uncertainty);
        const auto reach = metre(run.fastest.si() * seconds_of(sample.at - last_->at + open));
        if (jump > reach + reading_slack)
            lost_ =
                of + "reading jumped by " + in_mm(jump) + since + ", faster than the axis can move";
    }
    if (sample.value()) last_ = sample;
}

void SetUpWatch::begin() {
    lost_.clear();
    last_.reset();
}

void SetUpWatch::lose(std::string why) {
    if (lost_.empty()) lost_ = std::move(why);
}

} // namespace axiscal
