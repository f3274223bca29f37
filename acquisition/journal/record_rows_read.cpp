#include "acquisition/journal/record_columns.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace axiscal {
namespace {

std::vector<WindowSample> unpack(RowReader& in) {
    const std::string bytes = in.blob();
    if (bytes.size() % sample_bytes != 0) in.reject("is not a whole number of samples");
    std::vector<WindowSample> samples;
    samples.reserve(bytes.size() / sample_bytes);
    std::string_view rest = bytes;
    for (; rest.size() >= sample_bytes; rest.remove_prefix(sample_bytes))
        samples.push_back({monotonic_from_ns(static_cast<std::int64_t>(get_u64(rest))),
                           std::bit_cast<double>(get_u64(rest.substr(8))),
                           get_u64(rest.substr(16))});
    if (!std::ranges::all_of(samples, [](const auto& s) { return std::isfinite(s.reading_m); }))
        in.reject("holds a reading that is not a number");
    return samples;
}
Direction read_direction(RowReader& in) {
    return in.choice({Direction::positive, Direction::negative});
}

ClockTie read_tie(RowReader& in) {
    ClockTie tie;
    tie.before = in.time();
    tie.utc_ns = in.integer();
    tie.after = in.time();
    return tie;
}

void read_run(RunRecord& run, RowReader& in) {
    run.run_id = in.text();
    run.software_version = in.text();
    run.station = in.text();
    run.station_config = in.text();
    run.config_hash = in.text();
    run.boot_id = in.text();
    run.opened = read_tie(in);
}

void read_plan(RunRecord& run, RowReader& in) {
    auto& plan = run.plan;
    plan.axis_kind = in.choice({AxisKind::linear, AxisKind::rotary});
    plan.cycle = in.choice({CycleKind::standard, CycleKind::step});
    plan.pass = in.text();
    plan.remark = in.text();
    plan.approaches = in.number<int>();
    plan.bidirectional = in.flag();
    plan.interval = in.length();
    const auto seed = in.optional_integer();
    plan.seed = seed ? std::optional{std::bit_cast<std::uint64_t>(*seed)} : std::nullopt;
    plan.overrun = in.length();
    plan.near_tolerance = in.length();
    plan.datum = in.length();
}

void read_target(RunRecord& run, RowReader& in) {
    run.plan.targets.push_back(in.length());
}

PlannedPoint read_planned(RowReader& in) {
    PlannedPoint point;
    point.step = in.number<int>();
    point.target_index = in.number<int>();
    point.direction = read_direction(in);
    point.approach = in.number<int>();
    return point;
}

void read_plan_point(RunRecord& run, RowReader& in) {
    run.plan.points.push_back(read_planned(in));
}

void read_laser(RunRecord& run, RowReader& in) {
    auto& laser = run.laser;
    laser.instrument = in.text();
    laser.vacuum_wavelength = in.length();
    laser.optical_fold = in.real();
    laser.sign = in.number<int>();
    laser.dead_path = in.length();
    laser.beam_walk = in.length();
    laser.beam_walk_travel = in.length();
}

void read_material(RunRecord& run, RowReader& in) {
    auto& material = run.material;
    material.coefficient = Expansion::from_si(in.real());
    const auto u = in.optional_real();
    material.standard_uncertainty = u ? std::optional{Expansion::from_si(*u)} : std::nullopt;
    material.feedback = in.text();
    material.form = in.choice({ExpansionForm::first_order, ExpansionForm::exact});
}

void read_air(RunRecord& run, RowReader& in) {
    run.air.formula = in.choice({AirFormula::ciddor, AirFormula::edlen});
    run.air.co2_ppm = in.real();
    run.air.oldest = Duration{in.integer()};
}

void read_rotary(RunRecord& run, RowReader& in) {
    RotarySetup rotary;
    rotary.method = in.choice({AngleMethod::indexing_table, AngleMethod::polygon});
    rotary.step_deg = in.real();
    rotary.arm = in.length();
    rotary.range_deg = in.real();
    rotary.turn_time = Duration{in.integer()};
    rotary.by_hand = in.flag();
    rotary.certificate_with_axis = in.flag();
    rotary.run_out = in.text();
    if (run.rotary) return in.reject("stands there twice");
    run.rotary = std::move(rotary);
}

void read_rotary_deviation(RunRecord& run, RowReader& in) {
    if (!run.rotary) run.rotary.emplace(); // the writer checks each row by itself
    run.rotary->deviations_arcsec.push_back(in.real());
}

template <class Amount> void read_optional(std::optional<Amount>& amount, RowReader& in) {
    if (const auto si = in.optional_real()) amount = Amount::from_si(*si);
}

void read_uncertainty(RunRecord& run, RowReader& in) {
    UncertaintySetup setup;
    read_optional(setup.device_U.fixed, in);
    read_optional(setup.device_U.per_length, in);
    setup.device_k = in.real();
    read_optional(setup.device_width.fixed, in);
    read_optional(setup.device_width.per_length, in);
    read_optional(setup.misalignment, in);
    read_optional(setup.misalignment_angle, in);
    read_optional(setup.temperature_width, in);
    read_optional(setup.expansion_width, in);
    read_optional(setup.eve, in);
    setup.eve_model = in.choice({EveModel::mean, EveModel::difference});
    if (run.uncertainty) return in.reject("stands there twice");
    run.uncertainty = std::move(setup);
}

void read_uncertainty_target(RunRecord& run, RowReader& in) {
    TargetUncertainty target;
    target.parameter = in.text();
    target.limit = in.length();
    if (!run.uncertainty) run.uncertainty.emplace(); // the writer checks each row by itself
    run.uncertainty->targets.push_back(std::move(target));
}

void read_statement(RunRecord& run, RowReader& in) {
    const std::string name = in.text();
    const auto known = std::ranges::find(named_statements, name, &NamedStatement::name);
    if (known == named_statements.end()) return in.reject("\"" + name + "\" is not known");
    run.statements.*known->value = in.text();
}

void read_instrument(RunRecord& run, RowReader& in) {
    InstrumentRecord instrument;
    for (auto field : {&InstrumentRecord::name, &InstrumentRecord::driver, &InstrumentRecord::maker,
                       &InstrumentRecord::model, &InstrumentRecord::serial,
                       &InstrumentRecord::firmware, &InstrumentRecord::certificate_number,
                       &InstrumentRecord::calibrated_on, &InstrumentRecord::due_on})
        instrument.*field = in.text();
    run.instruments.push_back(std::move(instrument));
}

void read_channel(RunRecord& run, RowReader& in) {
    ChannelRecord channel;
    channel.id = in.number<int>();
    channel.name = in.text();
    channel.instrument = in.text();
    channel.place = in.text();
    channel.kind =
        in.choice({ChannelKind::displacement, ChannelKind::temperature, ChannelKind::pressure,
                   ChannelKind::humidity, ChannelKind::carbon_dioxide, ChannelKind::strength});
    channel.medium = in.choice({Medium::none, Medium::air, Medium::material});
    channel.correction = in.real();
    run.channels.push_back(std::move(channel));
}

void read_channel_calibration(RunRecord& run, RowReader& in) {
    ChannelCalibration calibration;
    calibration.channel = in.number<int>();
    for (auto field : {&ChannelCalibration::certificate_number, &ChannelCalibration::calibrated_on,
                       &ChannelCalibration::due_on})
        calibration.*field = in.text();
    calibration.expanded_uncertainty = in.optional_real();
    calibration.expanded_uncertainty_per_m = in.optional_real();
    calibration.coverage = in.real();
    run.calibrations.push_back(std::move(calibration));
}

void read_channel_correction(RunRecord& run, RowReader& in) {
    const int channel = in.number<int>();
    CorrectionPoint point;
    point.reading = in.real();
    point.correction = in.real();
    if (run.calibrations.empty()) // the writer checks each row by itself
        run.calibrations.emplace_back().channel = channel;
    if (run.calibrations.back().channel != channel)
        return in.reject("belongs to a channel whose calibration does not stand before it");
    run.calibrations.back().corrections.push_back(point);
}

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
    DriftSetup drift;
    drift.duration = Duration{in.integer()};
    drift.interval = Duration{in.integer()};
    drift.place = in.length();
    if (run.attachments.drift) return in.reject("stands there twice");
    run.attachments.drift = drift;
}

void read_probing(RecordedRun& run, RowReader& in) {
    ProbingRecord probing;
    probing.feed_mm_per_min = in.real();
    probing.probe = in.text();
    probing.signal_path = in.text();
    if (run.attachments.probing) return in.reject("stands there twice");
    run.attachments.probing = std::move(probing);
}

void read_probing_touch(RecordedRun& run, RowReader& in) {
    ProbingTouch touch;
    for (double& component : touch.direction)
        component = in.real();
    touch.reference = in.flag();
    touch.approach = in.length();
    for (Length& coordinate : touch.latched)
        coordinate = in.length();
    auto& probing = run.attachments.probing;
    if (!probing) probing.emplace(); // the writer checks each row by itself
    probing->touches.push_back(touch);
}

void read_eve_source(RecordedRun& run, RowReader& in) {
    run.attachments.eve_source = in.text();
}

void read_datum(RunRecord& run, RowReader& in) {
    DatumRecord datum;
    datum.id = in.text();
    datum.at = in.time();
    datum.coordinate = in.length();
    datum.reading = in.length();
    datum.epoch = in.number<std::uint32_t>();
    datum.spread = in.length();
    datum.slope_um_per_s = in.real();
    datum.n = in.number<int>();
    datum.sequence = in.number<std::uint16_t>();
    datum.device_count = std::bit_cast<std::uint64_t>(in.integer());
    run.datums.push_back(std::move(datum));
}

void read_point(RunRecord& run, RowReader& in) {
    PointRecord point;
    point.step = in.number<int>();
    point.sequence = in.number<std::uint16_t>();
    point.planned = read_planned(in);
    point.origin = in.choice({TriggerOrigin::cnc, TriggerOrigin::dwell, TriggerOrigin::manual});
    point.triggered_at = in.time();
    point.window_begin = in.time();
    point.window_end = in.time();
    point.reading = in.length();
    point.spread = in.length();
    point.slope_um_per_s = in.real();
    point.n = in.number<int>();
    point.approach_travel = in.length();
    point.datum_id = in.text();
    point.live_deviation = in.length();
    point.samples = unpack(in);
    run.points.push_back(std::move(point));
}

void read_environment(RunRecord& run, RowReader& in) {
    EnvironmentReading reading;
    reading.channel = in.number<int>();
    reading.at = in.time();
    reading.value = in.real();
    run.environment.push_back(reading);
}

void read_event(RunRecord& run, RowReader& in) {
    EventRecord event;
    event.kind =
        in.choice({EventKind::opened, EventKind::armed, EventKind::datum, EventKind::refused,
                   EventKind::skipped, EventKind::interrupted, EventKind::resumed,
                   EventKind::aborted, EventKind::closed, EventKind::note, EventKind::instrument});
    event.at = in.time();
    event.utc_ns = in.integer();
    event.text = in.text();
    const std::string fault = in.text();
    event.fault = fault_from_name(fault);
    if (fault_name(event.fault) != fault) in.reject("\"" + fault + "\" is not known");
    event.sequence = in.number<std::uint16_t>();
    run.events.push_back(std::move(event));
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
    CircularSetup& setup = run.circular.emplace();
    setup.plan = std::move(plan);
    setup.capture.sample_rate_hz = in.real();
    setup.capture.low_pass_hz = in.optional_real();
    setup.capture.averaged = in.number<int>();
}

void read_circular_bar(RecordedRun& run, RowReader& in) {
    if (!run.circular) run.circular.emplace(); // the writer checks each row by itself
    CircularSetup& setup = *run.circular;
    setup.bar_instrument = in.text();
    setup.bar_sign = in.number<int>();
    setup.bar_length_mm = in.real();
    setup.bar_alpha_per_K = in.optional_real();
    setup.machine_alpha_per_K = in.optional_real();
    const auto channel = in.optional_integer();
    if (channel) setup.bar_temperature_channel = static_cast<int>(*channel);
}

void read_circular_uncertainty(RecordedRun& run, RowReader& in) {
    if (!run.circular) run.circular.emplace();
    CircularUncertaintyStatement& statement = run.circular->uncertainty;
    for (auto* value :
         {&statement.device_width_um, &statement.calibration_U_um, &statement.calibration_k,
          &statement.repeatability_um, &statement.eve_um, &statement.centre_width_um,
          &statement.machine_temperature_width_K, &statement.bar_temperature_width_K,
          &statement.machine_alpha_width_per_K, &statement.bar_alpha_width_per_K})
        *value = in.optional_real();
    statement.runs = in.number<int>();
}

void read_circular_start(RecordedRun& run, RowReader& in) {
    if (!run.circular) run.circular.emplace();
    run.circular->plan.start = in.choice({StartMethod::feed_step, StartMethod::trigger});
    run.circular->plan.trigger_delay_s = in.real();
}

void read_stream(RecordedRun& run, RowReader& in) {
    StreamSetup stream;
    stream.id = in.number<int>();
    stream.channel = in.number<int>();
    stream.name = in.text();
    stream.unit = in.text();
    stream.nominal_rate_hz = in.real();
    run.streams.push_back(std::move(stream));
}

void read_stream_block(RecordedRun& run, RowReader& in) {
    StreamBlock block;
    block.stream = in.number<int>();
    block.index = in.integer();
    block.first_count = std::bit_cast<std::uint64_t>(in.integer());
    block.samples = in.number<int>();
    block.missing = std::bit_cast<std::uint64_t>(in.integer());
    block.before = in.text();
    block.begin = in.time();
    block.end = in.time();
    block.low = in.real();
    block.high = in.real();
    block.packed = in.blob();
    run.blocks.push_back(std::move(block));
}

void read_stream_block_time(RecordedRun& run, RowReader& in) {
    const int stream = in.number<int>();
    const std::int64_t index = in.integer();
    const auto u_t_ns = in.optional_integer();
    if (u_t_ns && *u_t_ns <= 0) in.reject("states an uncertainty that is none");
    if (run.blocks.empty()) { // the writer checks each row by itself
        run.blocks.emplace_back().stream = stream;
        run.blocks.back().index = index;
    }
    StreamBlock& block = run.blocks.back();
    if (block.stream != stream || block.index != index)
        return in.reject("belongs to a block that does not stand before it");
    block.time_uncertainty = Duration{u_t_ns.value_or(0)};
}

void read_preflight(RecordedRun& run, RowReader& in) {
    PreflightRecord check;
    check.name = in.text();
    check.passed = in.flag();
    check.warning = in.flag();
    check.verdict = in.text();
    check.override_reason = in.text();
    // A disk that failed between writing and syncing may hold them twice.
    std::erase_if(run.revisions.preflight,
                  [&](const PreflightRecord& other) { return other.name == check.name; });
    run.revisions.preflight.push_back(std::move(check));
}

void read_retake(RecordedRun& run, RowReader& in) {
    RetakeRecord retake;
    retake.number = in.number<int>();
    retake.at = in.time();
    retake.utc_ns = in.integer();
    retake.reason = in.text();
    run.revisions.retakes.push_back(std::move(retake));
}

void read_retake_point(RecordedRun& run, RowReader& in) {
    RetakePoint point;
    point.step = in.number<int>();
    point.planned_step = in.number<int>();
    auto& retakes = run.revisions.retakes;
    if (retakes.empty()) retakes.emplace_back(); // the writer checks each row by itself
    retakes.back().points.push_back(point);
}

void read_exclusion(RecordedRun& run, RowReader& in) {
    ExclusionRecord exclusion;
    exclusion.step = in.number<int>();
    exclusion.at = in.time();
    exclusion.utc_ns = in.integer();
    exclusion.reason = in.text();
    run.revisions.exclusions.push_back(std::move(exclusion));
}

void read_synchronisation(RecordedRun& run, RowReader& in) {
    SynchronisationRecord record;
    record.step = in.number<int>();
    record.datum_id = in.text();
    const auto u_t_ns = in.optional_integer();
    const auto error_um = in.optional_real();
    if (u_t_ns.has_value() != error_um.has_value())
        in.reject("states one number without the other");
    if (u_t_ns && error_um) {
        if (*u_t_ns <= 0 || *error_um < 0) in.reject("states an uncertainty that is none");
        record.stated = Synchronisation{Duration{*u_t_ns}, *error_um};
    }
    run.attachments.synchronisation.push_back(std::move(record));
}

void read_closing(RecordedRun& run, RowReader& in) {
    ++run.revisions.closings;
    run.complete = in.flag();
    run.closing_reason = in.text();
    run.closed = read_tie(in);
}

/// What was measured point by point knows nothing of what came with later formats.
template <auto read> void measured(RecordedRun& run, RowReader& in) {
    read(run, in);
}

constexpr std::array<void (*)(RecordedRun&, RowReader&), tables.size()> readers{
    measured<read_run>,
    measured<read_plan>,
    measured<read_target>,
    measured<read_plan_point>,
    measured<read_laser>,
    measured<read_material>,
    measured<read_air>,
    measured<read_rotary>,
    measured<read_rotary_deviation>,
    measured<read_uncertainty>,
    measured<read_uncertainty_target>,
    measured<read_statement>,
    measured<read_instrument>,
    measured<read_channel>,
    measured<read_channel_calibration>,
    measured<read_channel_correction>,
    read_alignment,
    read_alignment_place,
    read_drift,
    read_probing,
    read_probing_touch,
    read_eve_source,
    measured<read_datum>,
    measured<read_point>,
    measured<read_environment>,
    measured<read_event>,
    read_circular,
    read_circular_bar,
    read_circular_uncertainty,
    read_circular_start,
    read_stream,
    read_stream_block,
    read_stream_block_time,
    read_preflight,
    read_retake,
    read_retake_point,
    read_exclusion,
    read_synchronisation,
    read_closing,
};

} // namespace

Result<void> place_row(RecordedRun& run, const Table& table, const Row& row) {
    RowReader in{table, row};
    readers[static_cast<std::size_t>(&table - tables.data())](run, in);
    return in.status();
}

} // namespace axiscal
