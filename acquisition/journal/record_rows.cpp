#include "acquisition/journal/record_rows.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace axiscal {
namespace {

constexpr std::array tables{
    Table{"run",
          "run_id, software_version, station, station_config, config_hash, boot_id, "
          "opened_before_ns, opened_utc_ns, opened_after_ns",
          "ttttttiii"},
    Table{"plan",
          "axis_kind, cycle, pass, remark, approaches, bidirectional, interval_m, seed, overrun_m, "
          "near_tolerance_m, datum_m",
          "ttttiirIrrr"},
    Table{"plan_target", "position_m", "r"},
    Table{"plan_point", "step, target_index, direction, approach", "iiti"},
    Table{"laser",
          "instrument, vacuum_wavelength_m, optical_fold, sign, dead_path_m, beam_walk_m, "
          "beam_walk_travel_m",
          "trrirrr"},
    Table{"material", "coefficient_per_K, standard_uncertainty_per_K, feedback, form", "rRtt"},
    Table{"air", "formula, co2_ppm, oldest_ns", "tri"},
    Table{"uncertainty",
          "device_U_m, device_U_per_m, device_k, device_width_m, device_width_per_m, "
          "misalignment_m, misalignment_rad, temperature_width_K, expansion_width_per_K, eve_m, "
          "eve_model",
          "RRrRRRRRRRt", 2},
    Table{"uncertainty_target", "parameter, limit_m", "tr", 2},
    Table{"statement", "name, value", "tt"},
    Table{"instrument",
          "name, driver, maker, model, serial, firmware, certificate_number, calibrated_on, due_on",
          "ttttttttt"},
    Table{"channel", "id, name, instrument, place, kind, medium, correction", "itttttr"},
    Table{"alignment",
          "began_utc_ns, ended_utc_ns, instrument, serial, travel_m, reached_m, readings, lost, "
          "restarts, far_distance_m, far_highest_m, far_last_m, far_scatter_m, far_blocks, "
          "far_passed_maximum, spot_offset_m",
          "iittrriiiRRRRIIR", 3},
    Table{"alignment_place",
          "begin_m, end_m, readings, weakest_percent, mean_percent, last_percent", "rrirrr", 3},
    Table{"drift", "duration_ns, interval_ns, place_m", "iir", 3},
    Table{"eve_source", "run_id", "t", 3},
    Table{"datum",
          "id, at_ns, coordinate_m, reading_m, epoch, spread_m, slope_um_per_s, n, sequence, "
          "device_count",
          "tirrirriii"},
    Table{"point",
          "step, sequence, planned_step, target_index, direction, approach, origin, triggered_ns, "
          "window_begin_ns, window_end_ns, reading_m, spread_m, slope_um_per_s, n, "
          "approach_travel_m, datum_id, live_deviation_m, samples",
          "iiiititiiirrrirtrb"},
    Table{"environment", "channel, at_ns, value", "iir"},
    Table{"event", "kind, at_ns, utc_ns, text, fault, sequence", "tiitti"},
    Table{"circular",
          "plane, radius_mm, feed_mm_per_s, senses, repeats, warm_up, start_deg, arc_deg, "
          "overshoot_deg, feed_in_mm, feed_in_outside, centre_x_mm, centre_y_mm, centre_z_mm, "
          "tool_offset, work_offset, sample_rate_hz, low_pass_hz, averaged",
          "trrtiirrrrirrrttrRi", 3},
    Table{"circular_bar",
          "instrument, sign, length_mm, bar_alpha_per_K, machine_alpha_per_K, temperature_channel",
          "tirRRI", 3},
    Table{"circular_uncertainty",
          "device_width_um, calibration_U_um, calibration_k, repeatability_um, eve_um, "
          "centre_width_um, machine_temperature_width_K, bar_temperature_width_K, "
          "machine_alpha_width_per_K, bar_alpha_width_per_K, runs",
          "RRRRRRRRRRi", 3},
    Table{"stream", "id, channel, name, unit, nominal_rate_hz", "iittr", 3},
    Table{"stream_block",
          "stream, block, first_count, samples, missing, before, begin_ns, end_ns, low, high, data",
          "iiiiitiirrb", 3},
    Table{"preflight", "name, passed, warning, verdict, override_reason", "tiitt", 3},
    Table{"retake", "number, at_ns, utc_ns, reason", "iiit", 3},
    Table{"retake_point", "step, planned_step", "ii", 3},
    Table{"exclusion", "step, at_ns, utc_ns, reason", "iiit", 3},
    Table{"closing", "complete, reason, closed_before_ns, closed_utc_ns, closed_after_ns", "itiii"},
};

constexpr std::size_t sample_bytes = 24; // at_ns, reading_m, device_count

template <class Integer> Value whole(Integer number) {
    return static_cast<std::int64_t>(number);
}
Value nanoseconds(MonotonicTime at) {
    return nanoseconds_of(at);
}
Value optional(const std::optional<double>& number) {
    return number ? Value{*number} : Value{};
}
Value text(std::string_view words) {
    return std::string{words};
}

Blob pack(const std::vector<WindowSample>& samples) {
    Blob blob;
    blob.bytes.reserve(samples.size() * sample_bytes);
    for (const auto& [at, reading_m, device_count] : samples) {
        put_u64(blob.bytes, static_cast<std::uint64_t>(nanoseconds_of(at)));
        put_u64(blob.bytes, std::bit_cast<std::uint64_t>(reading_m));
        put_u64(blob.bytes, device_count);
    }
    return blob;
}

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

// Statements are stored by name, so that a new one needs no new column.
struct NamedStatement {
    std::string_view name;
    std::string Statements::*value;
};
constexpr std::array named_statements{
    NamedStatement{"certificate_number", &Statements::certificate_number},
    NamedStatement{"customer", &Statements::customer},
    NamedStatement{"place", &Statements::place},
    NamedStatement{"machine", &Statements::machine},
    NamedStatement{"machine_maker", &Statements::machine_maker},
    NamedStatement{"machine_serial", &Statements::machine_serial},
    NamedStatement{"axis", &Statements::axis},
    NamedStatement{"operator_name", &Statements::operator_name},
    NamedStatement{"approver", &Statements::approver},
    NamedStatement{"procedure", &Statements::procedure},
    NamedStatement{"state", &Statements::state},
    NamedStatement{"control_compensation", &Statements::control_compensation},
    NamedStatement{"feed", &Statements::feed},
    NamedStatement{"dwell", &Statements::dwell},
    NamedStatement{"warm_up", &Statements::warm_up},
    NamedStatement{"offsets", &Statements::offsets},
    NamedStatement{"idle_axes", &Statements::idle_axes},
    NamedStatement{"sensor_note", &Statements::sensor_note},
    NamedStatement{"laboratory", &Statements::laboratory},
    NamedStatement{"next_due", &Statements::next_due},
};
static_assert(sizeof(Statements) == named_statements.size() * sizeof(std::string),
              "every statement needs its name in the run file");

ChainedRow chained(std::string_view table, Row row) {
    return {&table_named(table), std::move(row)};
}

ChainedRow row_of_plan(const RunPlan& plan) {
    const auto& [axis_kind, cycle, pass, remark, targets, approaches, bidirectional, interval, seed,
                 overrun, near_tolerance, datum, points] = plan;
    Value seed_value;
    if (seed) seed_value = std::bit_cast<std::int64_t>(*seed);
    return chained("plan", {text(name_of(axis_kind)), text(name_of(cycle)), pass, remark,
                            whole(approaches), whole(bidirectional), interval.si(), seed_value,
                            overrun.si(), near_tolerance.si(), datum.si()});
}

ChainedRow row_of_planned(const PlannedPoint& point) {
    const auto& [step, target_index, direction, approach] = point;
    return chained("plan_point",
                   {whole(step), whole(target_index), text(name_of(direction)), whole(approach)});
}

ChainedRow row_of_laser(const LaserSetup& laser) {
    const auto& [instrument, wavelength, fold, sign, dead_path, walk, walk_travel] = laser;
    return chained("laser", {instrument, wavelength.si(), fold, whole(sign), dead_path.si(),
                             walk.si(), walk_travel.si()});
}

ChainedRow row_of_material(const MaterialSetup& material) {
    const auto& [coefficient, uncertainty, feedback, form] = material;
    Value u;
    if (uncertainty) u = uncertainty->si();
    return chained("material", {coefficient.si(), u, feedback, text(name_of(form))});
}

ChainedRow row_of_air(const AirSetup& air) {
    const auto& [formula, co2_ppm, oldest] = air;
    return chained("air", {text(name_of(formula)), co2_ppm, whole(oldest.count())});
}

template <class Amount> Value si_or_nothing(const std::optional<Amount>& amount) {
    return amount ? Value{amount->si()} : Value{};
}

ChainedRow row_of_uncertainty(const UncertaintySetup& setup) {
    const auto& [device_U, device_k, device_width, misalignment, misalignment_angle,
                 temperature_width, expansion_width, eve, eve_model, targets] = setup;
    return chained("uncertainty",
                   {si_or_nothing(device_U.fixed), si_or_nothing(device_U.per_length), device_k,
                    si_or_nothing(device_width.fixed), si_or_nothing(device_width.per_length),
                    si_or_nothing(misalignment), si_or_nothing(misalignment_angle),
                    si_or_nothing(temperature_width), si_or_nothing(expansion_width),
                    si_or_nothing(eve), text(name_of(eve_model))});
}

ChainedRow row_of_instrument(const InstrumentRecord& instrument) {
    const auto& [name, driver, maker, model, serial, firmware, certificate, calibrated, due] =
        instrument;
    return chained("instrument",
                   {name, driver, maker, model, serial, firmware, certificate, calibrated, due});
}

ChainedRow row_of_channel(const ChannelRecord& channel) {
    const auto& [id, name, instrument, place, kind, medium, correction] = channel;
    return chained("channel", {whole(id), name, instrument, place, text(name_of(kind)),
                               text(name_of(medium)), correction});
}

ChainedRow row_of_alignment(const AlignmentRecord& alignment) {
    const auto& [began, ended, instrument, serial, travel, reached, readings, lost, restarts, far,
                 spot_offset, places] = alignment;
    Row row{began,        ended,           instrument,  serial,         travel.si(),
            reached.si(), whole(readings), whole(lost), whole(restarts)};
    if (far) {
        const auto& [distance, highest, last, scatter, blocks, passed] = *far;
        row.insert(row.end(), {distance.si(), highest.si(), last.si(), scatter.si(), whole(blocks),
                               whole(passed)});
    } else {
        row.resize(row.size() + 6);
    }
    row.push_back(si_or_nothing(spot_offset));
    return chained("alignment", std::move(row));
}

ChainedRow row_of_place(const AlignmentPlace& place) {
    const auto& [begin, end, readings, weakest, mean, last] = place;
    return chained("alignment_place", {begin.si(), end.si(), whole(readings), weakest, mean, last});
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
    measured<read_uncertainty>,
    measured<read_uncertainty_target>,
    measured<read_statement>,
    measured<read_instrument>,
    measured<read_channel>,
    read_alignment,
    read_alignment_place,
    read_drift,
    read_eve_source,
    measured<read_datum>,
    measured<read_point>,
    measured<read_environment>,
    measured<read_event>,
    read_circular,
    read_circular_bar,
    read_circular_uncertainty,
    read_stream,
    read_stream_block,
    read_preflight,
    read_retake,
    read_retake_point,
    read_exclusion,
    read_closing,
};

} // namespace

std::span<const Table> chained_tables() {
    return tables;
}

const Table& table_named(std::string_view name) {
    return *std::ranges::find(tables, name, &Table::name);
}

std::vector<ChainedRow> header_rows(const RunRecord& header, const RunAttachments& attachments) {
    const auto& [before, utc_ns, after] = header.opened;
    std::vector<ChainedRow> rows;
    rows.push_back(chained("run", {header.run_id, header.software_version, header.station,
                                   header.station_config, header.config_hash, header.boot_id,
                                   nanoseconds(before), utc_ns, nanoseconds(after)}));
    rows.push_back(row_of_plan(header.plan));
    for (const auto target : header.plan.targets)
        rows.push_back(chained("plan_target", {target.si()}));
    for (const auto& point : header.plan.points)
        rows.push_back(row_of_planned(point));
    rows.push_back(row_of_laser(header.laser));
    rows.push_back(row_of_material(header.material));
    rows.push_back(row_of_air(header.air));
    if (header.uncertainty) {
        rows.push_back(row_of_uncertainty(*header.uncertainty));
        for (const auto& [parameter, limit] : header.uncertainty->targets)
            rows.push_back(chained("uncertainty_target", {parameter, limit.si()}));
    }
    for (const auto& [name, value] : named_statements)
        rows.push_back(chained("statement", {text(name), header.statements.*value}));
    for (const auto& instrument : header.instruments)
        rows.push_back(row_of_instrument(instrument));
    for (const auto& channel : header.channels)
        rows.push_back(row_of_channel(channel));
    const auto& [alignment, drift, eve_source] = attachments;
    if (alignment) {
        rows.push_back(row_of_alignment(*alignment));
        for (const AlignmentPlace& place : alignment->places)
            rows.push_back(row_of_place(place));
    }
    if (drift)
        rows.push_back(chained("drift", {whole(drift->duration.count()),
                                         whole(drift->interval.count()), drift->place.si()}));
    if (!eve_source.empty()) rows.push_back(chained("eve_source", {eve_source}));
    return rows;
}

ChainedRow row_of(const DatumRecord& datum) {
    const auto& [id, at, coordinate, reading, epoch, spread, slope_um_per_s, n, sequence,
                 device_count] = datum;
    return chained("datum",
                   {id, nanoseconds(at), coordinate.si(), reading.si(), whole(epoch), spread.si(),
                    slope_um_per_s, whole(n), whole(sequence), whole(device_count)});
}

ChainedRow row_of(const PointRecord& point) {
    const auto& [step, sequence, planned, origin, triggered_at, window_begin, window_end, reading,
                 spread, slope_um_per_s, n, approach_travel, datum_id, live_deviation, samples] =
        point;
    return chained("point",
                   {whole(step), whole(sequence), whole(planned.step), whole(planned.target_index),
                    text(name_of(planned.direction)), whole(planned.approach),
                    text(name_of(origin)), nanoseconds(triggered_at), nanoseconds(window_begin),
                    nanoseconds(window_end), reading.si(), spread.si(), slope_um_per_s, whole(n),
                    approach_travel.si(), datum_id, live_deviation.si(), pack(samples)});
}

ChainedRow row_of(const EnvironmentReading& reading) {
    const auto& [channel, at, value] = reading;
    return chained("environment", {whole(channel), nanoseconds(at), value});
}

ChainedRow row_of(const EventRecord& event) {
    const auto& [kind, at, utc_ns, words, fault, sequence] = event;
    return chained("event", {text(name_of(kind)), nanoseconds(at), utc_ns, words,
                             text(fault_name(fault)), whole(sequence)});
}

ChainedRow row_of(const Closing& closing) {
    const auto& [complete, reason, tie] = closing;
    return chained("closing", {whole(complete), reason, nanoseconds(tie.before), tie.utc_ns,
                               nanoseconds(tie.after)});
}

namespace {

ChainedRow row_of_circular(const CircularPlan& plan, const CircularCapture& capture) {
    const auto& [plane, radius_mm, feed_mm_per_s, senses, repeats, warm_up, start_deg, arc_deg,
                 overshoot_deg, feed_in_mm, feed_in_outside, centre_mm, tool_offset, work_offset] =
        plan;
    std::string words;
    for (const Sense sense : senses)
        words += (words.empty() ? "" : " ") + std::string{name_of(sense)};
    return chained("circular", {text(name_of(plane)), radius_mm, feed_mm_per_s, words,
                                whole(repeats), whole(warm_up), start_deg, arc_deg, overshoot_deg,
                                feed_in_mm, whole(feed_in_outside), centre_mm[0], centre_mm[1],
                                centre_mm[2], tool_offset, work_offset, capture.sample_rate_hz,
                                optional(capture.low_pass_hz), whole(capture.averaged)});
}

ChainedRow row_of_statement(const CircularUncertaintyStatement& statement) {
    const auto& [device, calibration_U, calibration_k, repeatability, eve, centre, machine_degC,
                 bar_degC, machine_alpha, bar_alpha, runs] = statement;
    return chained("circular_uncertainty",
                   {optional(device), optional(calibration_U), optional(calibration_k),
                    optional(repeatability), optional(eve), optional(centre),
                    optional(machine_degC), optional(bar_degC), optional(machine_alpha),
                    optional(bar_alpha), whole(runs)});
}

} // namespace

std::vector<ChainedRow> rows_of(const CircularSetup& setup) {
    const auto& [plan, capture, bar_instrument, bar_sign, bar_length_mm, bar_alpha, machine_alpha,
                 temperature_channel, uncertainty] = setup;
    Value channel;
    if (temperature_channel) channel = whole(*temperature_channel);
    std::vector<ChainedRow> rows;
    rows.push_back(row_of_circular(plan, capture));
    rows.push_back(
        chained("circular_bar", {bar_instrument, whole(bar_sign), bar_length_mm,
                                 optional(bar_alpha), optional(machine_alpha), channel}));
    rows.push_back(row_of_statement(uncertainty));
    return rows;
}

ChainedRow row_of(const StreamSetup& stream) {
    const auto& [id, channel, name, unit, nominal_rate_hz] = stream;
    return chained("stream", {whole(id), whole(channel), name, unit, nominal_rate_hz});
}

ChainedRow row_of(const StreamBlock& block) {
    const auto& [stream, index, first_count, samples, missing, before, begin, end, low, high,
                 packed] = block;
    return chained("stream_block",
                   {whole(stream), whole(index), whole(first_count), whole(samples), whole(missing),
                    before, nanoseconds(begin), nanoseconds(end), low, high, Blob{packed}});
}

ChainedRow row_of(const PreflightRecord& check) {
    const auto& [name, passed, warning, verdict, override_reason] = check;
    return chained("preflight", {name, whole(passed), whole(warning), verdict, override_reason});
}

ChainedRow row_of(const ExclusionRecord& exclusion) {
    const auto& [step, at, utc_ns, reason] = exclusion;
    return chained("exclusion", {whole(step), nanoseconds(at), utc_ns, reason});
}

std::vector<ChainedRow> rows_of(const RetakeRecord& retake) {
    const auto& [number, at, utc_ns, reason, points] = retake;
    std::vector<ChainedRow> rows;
    rows.reserve(points.size() + 1);
    rows.push_back(chained("retake", {whole(number), nanoseconds(at), utc_ns, reason}));
    for (const auto& [step, planned_step] : points)
        rows.push_back(chained("retake_point", {whole(step), whole(planned_step)}));
    return rows;
}

bool reopens(const Table& table) {
    return table.name == "retake" || table.name == "exclusion";
}

Result<void> place_row(RecordedRun& run, const Table& table, const Row& row) {
    RowReader in{table, row};
    readers[static_cast<std::size_t>(&table - tables.data())](run, in);
    return in.status();
}

} // namespace axiscal
