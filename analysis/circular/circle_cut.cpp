#include "analysis/circular/circle_cut.hpp"

#include "analysis/quantity/counted.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace axiscal {
namespace {

constexpr double one_degree = std::numbers::pi / 180;
constexpr double largest_time_error = 0.02; ///< of the programmed path
/// The machine halts this long after an arc at least; readings may end with its feed-out.
constexpr Duration shortest_halt = std::chrono::milliseconds{500};
/// Two samples between which a step may be interpolated lie no further apart than this share of
/// the feed-in: beyond it the crossing is known to a tenth of the step only.
constexpr double widest_share_of_step = 0.2;

std::string in_mm(double value_mm) {
    char text[40];
    std::snprintf(text, sizeof text, "%.2f mm", value_mm);
    return text;
}

std::string in_ms(double value_s) {
    char text[40];
    std::snprintf(text, sizeof text, "%.1f ms", value_s * 1e3);
    return text;
}

/// Samples first ... last - 1 lie on the circle's side of the step.
struct Stay {
    std::size_t first = 0, last = 0;
};

/// Sees the samples of an arc one after the other.
class RadialSpeed {
public:
    explicit RadialSpeed(const StreamSamples& stream)
        : stream_{stream} {}

    void see(std::size_t i) {
        const bool hole = std::ranges::binary_search(stream_.gaps, i, {}, &StreamGap::at);
        if (!begun_ || hole) back_ = i;
        begun_ = true;
        const Duration uncertainty = time_uncertainty(i);
        stated_ = stated_ && uncertainty > Duration{};
        while (back_ + 1 < i && stream_.at[i] - stream_.at[back_ + 1] >= least)
            ++back_;
        const Duration span = stream_.at[i] - stream_.at[back_];
        if (span < least) return;
        const double way_um = (stream_.value[i] - stream_.value[back_]) * 1e6;
        const auto here = synchronisation_of(way_um / seconds_of(span), uncertainty);
        if (here && (!worst_ || here->error_um > worst_->error_um)) worst_ = here;
    }
    [[nodiscard]] std::optional<Synchronisation> worst() const {
        return stated_ ? worst_ : std::nullopt;
    }

private:
    /// Shorter steps would tell noise, not speed.
    static constexpr Duration least = std::chrono::microseconds{999};

    [[nodiscard]] Duration time_uncertainty(std::size_t i) const {
        const auto next = std::ranges::upper_bound(stream_.times, i, {}, &StreamTime::from);
        return next == stream_.times.begin() ? Duration{} : std::prev(next)->time_uncertainty;
    }

    const StreamSamples& stream_;
    std::size_t back_ = 0;
    bool begun_ = false, stated_ = true;
    std::optional<Synchronisation> worst_;
};

class Cutter {
public:
    Cutter(const CircularSetup& setup, const StreamSamples& stream)
        : setup_{setup}
        , plan_{setup.plan}
        , stream_{stream}
        , path_mm_{programmed_path_mm(setup.plan)} {}

    [[nodiscard]] bool by_words() const { return plan_.start == StartMethod::trigger; }

    [[nodiscard]] double time_error(const Stay& stay) const {
        const double found = seconds_of(stream_.at[stay.last - 1] - stream_.at[stay.first]);
        return found * plan_.feed_mm_per_s / path_mm_ - 1;
    }

    /// Every stretch on the circle's side of the step within samples [first, last).
    [[nodiscard]] std::vector<Stay> stays(std::size_t first, std::size_t last) const {
        std::vector<Stay> found;
        bool inside = false;
        for (std::size_t i = first; i < last; ++i) {
            const bool now = height_mm(i) < 0;
            if (now && !inside) found.push_back({i, i});
            if (now) found.back().last = i + 1;
            inside = now;
        }
        return found;
    }

    [[nodiscard]] Result<CircleCapture> cut(const PlannedCircle& circle, const Stay& stay) const {
        AXISCAL_TRY(const double begin_s, crossing_s(stay.first, "feed-in", circle));
        AXISCAL_TRY(const double end_s, crossing_s(stay.last, "feed-out", circle));
        return timed(circle, stay, begin_s, end_s);
    }

    /// By the controller's words at both ends of the arc.
    [[nodiscard]] Result<CircleCapture> cut_by_words(const PlannedCircle& circle,
                                                     const CircleMark& mark) const {
        if (!mark.arc_begin || !mark.arc_end)
            return fail(Fault::incomplete_run, "the controller gave no word at the " +
                                                   std::string{mark.arc_begin ? "end" : "begin"} +
                                                   " of the arc of " + words(circle) +
                                                   ": is it the program of this station file?");
        if (stream_.at.empty() || stream_.at.back() + shortest_halt < *mark.arc_end)
            return fail(Fault::incomplete_run, "the readings end within " + words(circle));
        const auto said_s = [&](MonotonicTime at) {
            return seconds_of(at - stream_.at.front()) - plan_.trigger_delay_s;
        };
        const double begin_s = said_s(*mark.arc_begin), end_s = said_s(*mark.arc_end);
        const auto index = [&](double second) {
            const MonotonicTime at = stream_.at.front() + from_seconds(second);
            return static_cast<std::size_t>(std::ranges::lower_bound(stream_.at, at) -
                                            stream_.at.begin());
        };
        return timed(circle, {index(begin_s), index(end_s)}, begin_s, end_s);
    }

    static std::string words(const PlannedCircle& circle) {
        return "circle " + std::to_string(circle.number) + " (" +
               std::string{name_of(circle.sense)} + ")";
    }

private:
    [[nodiscard]] Result<CircleCapture>
    timed(const PlannedCircle& circle, const Stay& stay, double begin_s, double end_s) const {
        CircleCapture capture;
        capture.repeat = circle.repeat;
        capture.warm_up = circle.warm_up;
        capture.start = plan_.start;
        capture.trace.sense = circle.sense;
        capture.residual_mm = (end_s - begin_s) * plan_.feed_mm_per_s - path_mm_;
        capture.speed_residual = capture.residual_mm / path_mm_;
        if (std::fabs(capture.speed_residual) > largest_time_error)
            return fail(Fault::incomplete_run,
                        words(circle) + " took " + in_mm(capture.residual_mm) +
                            " of path more than programmed: is the feed override at 100 %, and is "
                            "the feed that of the station file?");
        take_arc(capture, stay, (begin_s + end_s) / 2);
        if (capture.trace.angle_rad.empty())
            return fail(Fault::incomplete_run, "there are no readings of " + words(circle));
        return capture;
    }

    [[nodiscard]] double height_mm(std::size_t i) const {
        return height_above_step_mm(setup_, stream_.value[i]);
    }
    [[nodiscard]] double seconds(std::size_t i) const {
        return seconds_of(stream_.at[i] - stream_.at.front());
    }
    [[nodiscard]] bool hole_before(std::size_t i) const {
        return std::ranges::binary_search(stream_.gaps, i, {}, &StreamGap::at);
    }

    /// Between samples i - 1 and i.
    [[nodiscard]] Result<double>
    crossing_s(std::size_t i, const char* which, const PlannedCircle& circle) const {
        const auto not_seen = [&](const std::string& where) {
            return fail(Fault::incomplete_run,
                        "the " + std::string{which} + " of " + words(circle) +
                            " was not seen: half of feed_in must lie within the gauge's range, and "
                            "no sample may be missing there (" +
                            where + ")");
        };
        if (i == 0) return not_seen("the readings begin after it");
        if (i == stream_.at.size()) return not_seen("the readings end before it");
        const double between_s = seconds(i) - seconds(i - 1);
        if (between_s * plan_.feed_mm_per_s >= widest_share_of_step * plan_.feed_in_mm)
            return not_seen("there is none for " + in_ms(between_s));
        const double low = height_mm(i - 1), high = height_mm(i);
        return seconds(i - 1) + between_s * low / (low - high);
    }

    void take_arc(CircleCapture& capture, const Stay& stay, double middle_s) const {
        const double half_rad = plan_.arc_deg / 2 * one_degree;
        const double middle_rad = plan_.start_deg * one_degree + half_rad;
        const double speed_rad = plan_.feed_mm_per_s / plan_.nominal_radius_mm;
        const double sense = sign_of(capture.trace.sense);
        RadialSpeed rate{stream_};
        for (std::size_t i = stay.first; i < stay.last; ++i) {
            const double turned = (seconds(i) - middle_s) * speed_rad;
            // the end itself belongs to the next turn: a full circle has every angle once
            if (turned < -half_rad || turned >= half_rad) continue;
            if (capture.trace.angle_rad.empty())
                capture.begin = stream_.at[i];
            else if (hole_before(i))
                count_hole(capture, i);
            capture.end = stream_.at[i];
            rate.see(i);
            capture.trace.angle_rad.push_back(middle_rad + sense * turned);
            capture.trace.radial_deviation_mm.push_back(
                radial_deviation_mm(setup_, stream_.value[i]));
        }
        capture.synchronisation = rate.worst();
    }
    void count_hole(CircleCapture& capture, std::size_t i) const {
        const auto gap = std::ranges::lower_bound(stream_.gaps, i, {}, &StreamGap::at);
        ++capture.gaps;
        capture.missing += gap->missing;
    }

    const CircularSetup& setup_;
    const CircularPlan& plan_;
    const StreamSamples& stream_;
    double path_mm_;
};

std::size_t index_at(const StreamSamples& stream, MonotonicTime at) {
    return static_cast<std::size_t>(std::ranges::lower_bound(stream.at, at) - stream.at.begin());
}

/// The stay that lasts nearest to as long as programmed.
Result<Stay>
best_of(const Cutter& cutter, const std::vector<Stay>& stays, const PlannedCircle& of) {
    const auto best = std::ranges::min_element(
        stays, {}, [&](const Stay& stay) { return std::fabs(cutter.time_error(stay)); });
    if (best == stays.end())
        return fail(Fault::incomplete_run,
                    "no feed-in is seen in the readings of " + Cutter::words(of) +
                        ": is the bar mounted, and are feed_in and its side those of the program?");
    return *best;
}

Result<CircleCapture> cut_by_mark(const Cutter& cutter,
                                  const StreamSamples& stream,
                                  const PlannedCircle& circle,
                                  std::span<const CircleMark> marks) {
    const auto mark = std::ranges::find(marks, circle.number, &CircleMark::number);
    if (mark == marks.end())
        return fail(Fault::incomplete_run, Cutter::words(circle) + " was never begun");
    if (cutter.by_words()) return cutter.cut_by_words(circle, *mark);
    const auto next = std::next(mark);
    const std::size_t last = next == marks.end() ? stream.at.size() : index_at(stream, next->at);
    AXISCAL_TRY(const Stay stay,
                best_of(cutter, cutter.stays(index_at(stream, mark->at), last), circle));
    return cutter.cut(circle, stay);
}

Result<std::vector<Stay>> stays_by_order(const Cutter& cutter,
                                         const StreamSamples& stream,
                                         const std::vector<PlannedCircle>& circles) {
    std::vector<Stay> stays = cutter.stays(0, stream.at.size());
    std::erase_if(stays, [&](const Stay& stay) {
        return std::fabs(cutter.time_error(stay)) > largest_time_error;
    });
    if (stays.size() == circles.size()) return stays;
    return fail(Fault::incomplete_run,
                counted(static_cast<long>(stays.size()), "circle is", "circles are") +
                    " seen in the readings, " +
                    counted(static_cast<long>(circles.size()), "is", "are") + " planned");
}

} // namespace

std::vector<CircleMark> circle_marks(const CircularPlan& plan,
                                     std::span<const EventRecord> events) {
    const int requests = requests_a_circle(plan);
    std::vector<CircleMark> marks;
    for (const EventRecord& event : events) {
        if (event.kind != EventKind::note || event.sequence == 0) continue;
        const int number = (event.sequence - 1) / requests + 1;
        const int word = (event.sequence - 1) % requests;
        const bool known = !marks.empty() && marks.back().number == number;
        if (word == 0 && known) marks.pop_back();
        if (word == 0) marks.push_back({number, event.at});
        if (word == 1 && known) marks.back().arc_begin = event.at;
        if (word == 2 && known) marks.back().arc_end = event.at;
    }
    return marks;
}

double radial_deviation_mm(const CircularSetup& setup, double reading_m) {
    const double from_nominal =
        setup.bar_length_mm > 0 ? setup.bar_length_mm - setup.plan.nominal_radius_mm : 0;
    return setup.bar_sign * reading_m * 1e3 + from_nominal;
}

double height_above_step_mm(const CircularSetup& setup, double reading_m) {
    const double deviation = radial_deviation_mm(setup, reading_m);
    return (setup.plan.feed_in_outside ? deviation : -deviation) - setup.plan.feed_in_mm / 2;
}

double programmed_path_mm(const CircularPlan& plan) {
    const double arc_mm = driven_deg(plan) * one_degree * plan.nominal_radius_mm;
    return plan.start == StartMethod::trigger ? arc_mm : arc_mm + plan.feed_in_mm;
}

Result<std::vector<CircleCapture>> cut_circles(const CircularSetup& setup,
                                               const StreamSamples& stream,
                                               std::span<const CircleMark> marks) {
    const std::vector<PlannedCircle> circles = planned_circles(setup.plan);
    const Cutter cutter{setup, stream};
    std::vector<Stay> stays;
    if (marks.empty()) {
        AXISCAL_TRY(stays, stays_by_order(cutter, stream, circles));
    }
    std::vector<CircleCapture> captures;
    captures.reserve(circles.size());
    for (std::size_t i = 0; i < circles.size(); ++i) {
        AXISCAL_TRY(auto capture, marks.empty() ? cutter.cut(circles[i], stays[i])
                                                : cut_by_mark(cutter, stream, circles[i], marks));
        captures.push_back(std::move(capture));
    }
    return captures;
}

Result<CircleCapture> cut_circle(const CircularSetup& setup,
                                 const StreamSamples& stream,
                                 std::span<const CircleMark> marks,
                                 const PlannedCircle& circle) {
    return cut_by_mark(Cutter{setup, stream}, stream, circle, marks);
}

} // namespace axiscal
