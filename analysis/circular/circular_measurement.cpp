// What a closed run says of its circles, ready to be evaluated.

#include "analysis/circular/circular_certificate.hpp"
#include "analysis/record/certificate_expiry.hpp"
#include "analysis/record/run_clock.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

namespace axiscal {
namespace {

std::string filter_text(const CircularCapture& capture) {
    std::string words;
    std::array<char, 64> text{};
    if (capture.low_pass_hz) {
        std::snprintf(text.data(), text.size(), "low pass, cut-off %.6g Hz", *capture.low_pass_hz);
        words = text.data();
    }
    if (capture.averaged > 1) {
        std::snprintf(text.data(), text.size(), "%d readings averaged into one", capture.averaged);
        words += (words.empty() ? "" : "; ") + std::string{text.data()};
    }
    return words.empty() ? "none" : words;
}

std::string feed_in_text(const CircularPlan& plan) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "radial, %.6g mm from %s the circle", plan.feed_in_mm,
                  plan.feed_in_outside ? "outside" : "inside");
    return text.data();
}

std::string angle_text(const CircularRun& run) {
    const bool step = std::ranges::any_of(run.circles, [](const CircleCapture& circle) {
        return circle.start == StartMethod::feed_step;
    });
    const bool trigger = std::ranges::any_of(run.circles, [](const CircleCapture& circle) {
        return circle.start == StartMethod::trigger;
    });
    if (step && trigger) return "constant feed between feed-in and feed-out, or the trigger's word";
    if (step) return "constant feed between the steps of feed-in and feed-out";
    return trigger ? "programmed feed since the trigger's word" : "";
}

CircularConditions conditions_of(const CircularRun& run) {
    CircularConditions conditions;
    conditions.centre_mm = run.plan.centre_mm;
    conditions.tool_offset = run.plan.tool_offset;
    conditions.work_offset = run.plan.work_offset;
    if (run.capture.sample_rate_hz > 0) conditions.sample_rate_hz = run.capture.sample_rate_hz;
    conditions.filter = filter_text(run.capture);
    conditions.angle_origin = angle_text(run);
    conditions.overshoot_deg = run.plan.overshoot_deg;
    conditions.feed_in = feed_in_text(run.plan);
    conditions.repeats = run.plan.repeats;
    conditions.warm_up = run.plan.warm_up;
    conditions.air = run.air_temperature;
    conditions.bar = run.bar_temperature;
    conditions.machine = run.machine_temperature;
    return conditions;
}

CircularUncertaintyStatement statement_of(const CircularRun& run) {
    CircularUncertaintyStatement stated = run.uncertainty;
    if (!stated.calibration_U_um && run.bar.calibration_U_um && run.bar.calibration_k) {
        stated.calibration_U_um = run.bar.calibration_U_um;
        stated.calibration_k = run.bar.calibration_k;
    }
    stated.runs = std::max(run.plan.repeats, 1);
    return stated;
}

} // namespace

Result<CircularMeasurement> measurement_of(CircularRun run) {
    if (!run.complete)
        return fail(Fault::incomplete_run,
                    "the run was not closed as complete" +
                        (run.closing_reason.empty() ? std::string{} : ": " + run.closing_reason));
    CircularMeasurement measured;
    AXISCAL_TRY(measured.test, mean_test(run));
    for (int repeat = 1; run.plan.repeats > 1 && repeat <= run.plan.repeats; ++repeat) {
        AXISCAL_TRY(CircularTest alone, test_of_repeat(run, repeat));
        measured.repeats.push_back(std::move(alone));
    }
    measured.axes = axes_of(run.plan.plane);
    measured.conditions = conditions_of(run);
    measured.expansion = expansion_of(run);
    measured.stated = statement_of(run);
    std::vector<RetakeRecord> no_retakes; // circles are driven anew instead
    measured.clock_remark =
        remark_on_clock(tell_times_by_one_clock(run.opened, run.events, no_retakes, run.closed));
    tell_orders_by_one_clock(run.opened, run.events, run.orders);
    measured.started_utc = iso8601_utc(run.opened.utc_ns);
    measured.finished_utc = iso8601_utc(run.closed.utc_ns);
    measured.next_due = next_due_of(run.statements, run.closed.utc_ns);
    measured.run = std::move(run);
    return measured;
}

} // namespace axiscal
