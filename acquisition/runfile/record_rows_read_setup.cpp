// Rows that say what is to be measured, and with what.
#include "acquisition/runfile/record_readers.hpp"

#include "acquisition/runfile/record_columns.hpp"

#include <algorithm>
#include <bit>

namespace axiscal::record_readers {
namespace {

Direction read_direction(RowReader& in) {
    return in.choice({Direction::positive, Direction::negative});
}

} // namespace

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
    run.boot_id.text = in.text();
    run.opened = read_tie(in);
}

void read_test(RunRecord& run, RowReader& in) {
    run.kind = in.one_of(all_test_kinds);
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

void read_linear_scale(RunRecord& run, RowReader& in) {
    ScaleSetup scale;
    scale.resolution = in.length();
    scale.coefficient = Expansion::from_si(in.real());
    read_optional(scale.standard_uncertainty, in);
    read_optional(scale.temperature_width, in);
    if (run.scale) return in.reject("stands there twice");
    run.scale = std::move(scale);
}

void read_imported(RunRecord& run, RowReader& in) {
    ImportedReadings imported;
    imported.file = in.text();
    imported.form = in.text();
    imported.sha256 = in.text();
    imported.measured = in.text();
    imported.remark = in.text();
    if (run.imported) return in.reject("stands there twice");
    run.imported = std::move(imported);
}

void read_linear_scale_sensor(RunRecord& run, RowReader& in) {
    if (!run.scale) run.scale.emplace(); // the writer checks each row by itself
    run.scale->channels.push_back(in.number<int>());
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

void read_tolerance_set(RunRecord& run, RowReader& in) {
    ToleranceRecord set;
    set.name = in.text();
    set.source = in.text();
    set.unit = in.text();
    set.rule = in.choice({DecisionRule::none, DecisionRule::iso_14253_1_2017, DecisionRule::guard_U,
                          DecisionRule::simple});
    set.to_be_checked = in.flag();
    if (run.tolerances) return in.reject("stands there twice");
    run.tolerances = std::move(set);
}

void read_tolerance_limit(RunRecord& run, RowReader& in) {
    ToleranceLimit limit;
    limit.parameter = in.text();
    limit.travel_up_to = in.optional_real();
    limit.limit = in.real();
    if (!run.tolerances) run.tolerances.emplace(); // the writer checks each row by itself
    run.tolerances->limits.push_back(std::move(limit));
}

void read_standard(RunRecord& run, RowReader& in) {
    run.standards.push_back(in.text());
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
                   ChannelKind::humidity, ChannelKind::carbon_dioxide, ChannelKind::strength,
                   ChannelKind::angle});
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

} // namespace axiscal::record_readers
