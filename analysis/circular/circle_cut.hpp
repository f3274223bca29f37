#pragma once
// Circles cut out of the stream of a bar: begin and end by the radial steps of feed-in and
// feed-out, or by the controller's words; the angle by the programmed feed. Pure.

#include "analysis/circular/circular_run.hpp"
#include "analysis/record/stream_record.hpp"

#include <span>
#include <vector>

namespace axiscal {

/// The controller's word that a circle comes next; number 0, or the one after the last, ends it.
struct CircleMark {
    int number = 0; ///< PlannedCircle::number
    MonotonicTime at;
    /// Of StartMethod::trigger: its words at both ends of the arc, overshoot included.
    std::optional<MonotonicTime> arc_begin = {}, arc_end = {};
};
/// The requests that a run file keeps as notes. Of two with one number the last counts: the circle
/// was begun again after an interruption.
std::vector<CircleMark> circle_marks(const CircularPlan& plan, std::span<const EventRecord> events);

/// What a reading stands for: radius - nominal radius, mm, outward positive.
///   sign * reading + (calibrated length - R), or sign * reading while no length is known.
double radial_deviation_mm(const CircularSetup& setup, double reading_m);

/// How far the reading lies beyond half of the feed-in, mm: positive beside the circle, negative on
/// its side. Its zeros are begin and end of a circle.
double height_above_step_mm(const CircularSetup& setup, double reading_m);

/// Path from half the feed-in to half the feed-out, mm; by words that of the arc.
double programmed_path_mm(const CircularPlan& plan);

/// Circles in the order of the plan. Marks tell which stretch of the stream holds which circle;
/// without any, every stretch that fits is a circle and they must be as many as planned.
///
/// Begin and end are where the reading crosses half the feed-in, between two samples linearly. The
/// middle of the circle lies half way between them, whatever time braking takes at both ends as
/// long as it is the same; from there the angle is counted at the programmed feed. A feed that is
/// wrong by a share e puts the ends of the arc wrong by e (arc / 2). By words it is the same, with
/// the words' times, less plan.trigger_delay_s, in place of the crossings: a word that comes d
/// later than stated turns the circle by d * feed / radius, which the form does not show.
/// @errors Fault::incomplete_run naming the circle: no step in its stretch, a step that the gauge
/// did not see, a time that differs by more than 2 % from the programmed one.
Result<std::vector<CircleCapture>> cut_circles(const CircularSetup& setup,
                                               const StreamSamples& stream,
                                               std::span<const CircleMark> marks);

/// One circle alone, between its mark and the next. @errors as cut_circles.
Result<CircleCapture> cut_circle(const CircularSetup& setup,
                                 const StreamSamples& stream,
                                 std::span<const CircleMark> marks,
                                 const PlannedCircle& circle);

} // namespace axiscal
