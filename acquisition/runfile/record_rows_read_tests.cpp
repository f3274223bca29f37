// Rows of what stands beside positioning: alignment, drift test, probing test, circular test.
#include "acquisition/runfile/record_readers.hpp"

namespace axiscal::record_readers {
namespace {

/// That of this kind, made where none is there yet: the writer checks each row by itself.
template <class Setup> Setup& setup_of(RecordedRun& run, RowReader& in) {
    TestSetup& setup = run.attachments.setup;
    if (!std::holds_alternative<Setup>(setup)) {
        if (!std::holds_alternative<std::monostate>(setup))
            in.reject("stands beside the set-up of another kind of test");
        setup.emplace<Setup>();
    }
    return std::get<Setup>(setup);
}

/// The same, of which a file has one.
template <class Setup> Setup& only_setup_of(RecordedRun& run, RowReader& in) {
    if (std::holds_alternative<Setup>(run.attachments.setup)) in.reject("stands there twice");
    return setup_of<Setup>(run, in);
}

} // namespace

void read_alignment(RecordedRun& run, RowReader& in) {
    AlignmentRecord alignment;
    alignment.began_utc_ns = in.integer();
    alignment.ended_utc_ns = in.integer();
    alignment.instrument = in.text();
    alignment.serial = in.text();
    alignment.travel = in.length();
    alignment.reached = in.length();
    alignment.readings = in.number<int>();
    alignment.lost = in.number<int>();
    alignment.restarts = in.number<int>();
    std::optional<Length> distance, highest, last, scatter;
    for (auto* length : {&distance, &highest, &last, &scatter})
        read_optional(*length, in);
    const auto blocks = in.optional_integer(), passed = in.optional_integer();
    if (distance && highest && last && scatter && blocks && passed)
        alignment.far =
            FarRest{*distance, *highest, *last, *scatter, static_cast<int>(*blocks), *passed != 0};
    else if (distance || highest || last || scatter || blocks || passed)
        in.reject("states a part of the far rest");
    read_optional(alignment.spot_offset, in);
    if (run.attachments.alignment) return in.reject("stands there twice");
    run.attachments.alignment = std::move(alignment);
}

void read_alignment_place(RecordedRun& run, RowReader& in) {
    AlignmentPlace place;
    place.begin = in.length();
    place.end = in.length();
    place.readings = in.number<int>();
    place.weakest_percent = in.real();
    place.mean_percent = in.real();
    place.last_percent = in.real();
    auto& alignment = run.attachments.alignment;
    if (!alignment) alignment.emplace(); // the writer checks each row by itself
    alignment->places.push_back(place);
}

void read_drift(RecordedRun& run, RowReader& in) {
    auto& drift = only_setup_of<DriftSetup>(run, in);
    drift.duration = Duration{in.integer()};
    drift.interval = Duration{in.integer()};
    drift.place = in.length();
    drift.of_bar = in.flag();
}

void read_probing(RecordedRun& run, RowReader& in) {
    auto& probing = only_setup_of<ProbingRecord>(run, in);
    probing.feed_mm_per_min = in.real();
    probing.probe = in.text();
    probing.signal_path = in.text();
}

void read_probing_touch(RecordedRun& run, RowReader& in) {
    ProbingTouch touch;
    for (double& component : touch.direction)
        component = in.real();
    touch.reference = in.flag();
    touch.approach = in.length();
    for (Length& coordinate : touch.latched)
        coordinate = in.length();
    setup_of<ProbingRecord>(run, in).touches.push_back(touch);
}

void read_eve_source(RecordedRun& run, RowReader& in) {
    run.attachments.eve_source = in.text();
}

void read_circular(RecordedRun& run, RowReader& in) {
    CircularPlan plan;
    plan.plane = in.choice({CircularPlane::xy, CircularPlane::yz, CircularPlane::zx});
    plan.nominal_radius_mm = in.real();
    plan.feed_mm_per_s = in.real();
    const std::string senses = in.text();
    plan.senses.clear();
    for (std::size_t at = 0; at < senses.size(); at = senses.find(' ', at) + 1) {
        const std::string word = senses.substr(at, senses.find(' ', at) - at);
        if (word != "ccw" && word != "cw") in.reject("\"" + word + "\" is no sense");
        plan.senses.push_back(word == "cw" ? Sense::cw : Sense::ccw);
        if (senses.find(' ', at) == std::string::npos) break;
    }
    plan.repeats = in.number<int>();
    plan.warm_up = in.number<int>();
    plan.start_deg = in.real();
    plan.arc_deg = in.real();
    plan.overshoot_deg = in.real();
    plan.feed_in_mm = in.real();
    plan.feed_in_outside = in.flag();
    for (double& coordinate : plan.centre_mm)
        coordinate = in.real();
    plan.tool_offset = in.text();
    plan.work_offset = in.text();
    auto& setup = setup_of<CircularSetup>(run, in);
    setup.plan = std::move(plan);
    setup.capture.sample_rate_hz = in.real();
    setup.capture.low_pass_hz = in.optional_real();
    setup.capture.averaged = in.number<int>();
    setup.plan.start = in.choice({StartMethod::feed_step, StartMethod::trigger});
    setup.plan.trigger_delay_s = in.real();
}

void read_circular_bar(RecordedRun& run, RowReader& in) {
    auto& setup = setup_of<CircularSetup>(run, in);
    setup.bar_instrument = in.text();
    setup.bar_sign = in.number<int>();
    setup.bar_length_mm = in.real();
    setup.bar_alpha_per_K = in.optional_real();
    setup.machine_alpha_per_K = in.optional_real();
    const auto channel = in.optional_integer();
    if (channel) setup.bar_temperature_channel = static_cast<int>(*channel);
}

void read_circular_uncertainty(RecordedRun& run, RowReader& in) {
    CircularUncertaintyStatement& statement = setup_of<CircularSetup>(run, in).uncertainty;
    for (auto* value :
         {&statement.device_width_um, &statement.calibration_U_um, &statement.calibration_k,
          &statement.repeatability_um, &statement.eve_um, &statement.centre_width_um,
          &statement.machine_temperature_width_K, &statement.bar_temperature_width_K,
          &statement.machine_alpha_width_per_K, &statement.bar_alpha_width_per_K})
        *value = in.optional_real();
    statement.runs = in.number<int>();
}

} // namespace axiscal::record_readers
