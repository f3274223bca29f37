#include "acquisition/runfile/record_columns.hpp"
#include "acquisition/runfile/row_values.hpp"
#include "acquisition/runfile/setups/setup_rows.hpp"
#include "acquisition/runfile/window_packing.hpp"

#include <algorithm>
#include <bit>

namespace axiscal {
namespace {

using row_values::chained;
using row_values::optional;
using row_values::si_or_nothing;
using row_values::text;
using row_values::whole;

Value nanoseconds(MonotonicTime at) {
    return nanoseconds_of(at);
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

ChainedRow row_of_rotary(const RotarySetup& rotary) {
    const auto& [method, step_deg, arm, range_deg, turn_time, by_hand, deviations, with_axis,
                 run_out] = rotary;
    return chained("rotary", {text(name_of(method)), step_deg, arm.si(), range_deg,
                              whole(turn_time.count()), whole(by_hand), whole(with_axis), run_out});
}

ChainedRow row_of_scale(const ScaleSetup& scale) {
    const auto& [resolution, coefficient, uncertainty, temperature_width, channels] = scale;
    return chained("linear_scale", {resolution.si(), coefficient.si(), si_or_nothing(uncertainty),
                                    si_or_nothing(temperature_width)});
}

ChainedRow row_of_imported(const ImportedReadings& imported) {
    const auto& [file, form, sha256, measured, remark] = imported;
    return chained("imported", {file, form, sha256, measured, remark});
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

ChainedRow row_of_calibration(const ChannelCalibration& calibration) {
    const auto& [channel, certificate, calibrated, due, expanded, per_m, coverage, corrections] =
        calibration;
    return chained("channel_calibration", {whole(channel), certificate, calibrated, due,
                                           optional(expanded), optional(per_m), coverage});
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

std::vector<ChainedRow> rows_of(const ToleranceRecord& set) {
    const auto& [name, source, unit, rule, to_be_checked, limits] = set;
    std::vector<ChainedRow> rows{
        chained("tolerance_set", {name, source, unit, text(name_of(rule)), whole(to_be_checked)})};
    for (const auto& [parameter, travel_up_to, limit] : limits)
        rows.push_back(chained("tolerance_limit", {parameter, optional(travel_up_to), limit}));
    return rows;
}

} // namespace

std::vector<ChainedRow> rows_of(const TestSetup& setup) {
    const auto kind = static_cast<TestKind>(setup.index());
    std::vector<ChainedRow> all;
    for (const SetupRows* own : setup_rows())
        if (own->kind == kind) std::ranges::move(own->rows(setup), std::back_inserter(all));
    return all;
}

std::vector<ChainedRow> header_rows(const RunRecord& header, const RunAttachments& attachments) {
    const auto& [before, utc_ns, after] = header.opened;
    std::vector<ChainedRow> rows;
    rows.push_back(chained("run", {header.run_id, header.software_version, header.station,
                                   header.station_config, header.config_hash, header.boot_id.text,
                                   nanoseconds(before), utc_ns, nanoseconds(after)}));
    rows.push_back(chained("test", {text(name_of(header.kind))}));
    rows.push_back(row_of_plan(header.plan));
    for (const auto target : header.plan.targets)
        rows.push_back(chained("plan_target", {target.si()}));
    for (const auto& point : header.plan.points)
        rows.push_back(row_of_planned(point));
    rows.push_back(row_of_laser(header.laser));
    rows.push_back(row_of_material(header.material));
    rows.push_back(row_of_air(header.air));
    if (header.rotary) {
        rows.push_back(row_of_rotary(*header.rotary));
        for (const double deviation : header.rotary->deviations_arcsec)
            rows.push_back(chained("rotary_deviation", {deviation}));
    }
    if (header.scale) {
        rows.push_back(row_of_scale(*header.scale));
        for (const int channel : header.scale->channels)
            rows.push_back(chained("linear_scale_sensor", {whole(channel)}));
    }
    if (header.imported) rows.push_back(row_of_imported(*header.imported));
    if (header.uncertainty) {
        rows.push_back(row_of_uncertainty(*header.uncertainty));
        for (const auto& [parameter, limit] : header.uncertainty->targets)
            rows.push_back(chained("uncertainty_target", {parameter, limit.si()}));
    }
    if (header.tolerances) std::ranges::move(rows_of(*header.tolerances), std::back_inserter(rows));
    for (const std::string& name : header.standards)
        rows.push_back(chained("standard", {name}));
    for (const auto& [name, value] : named_statements)
        rows.push_back(chained("statement", {text(name), header.statements.*value}));
    for (const auto& instrument : header.instruments)
        rows.push_back(row_of_instrument(instrument));
    for (const auto& channel : header.channels)
        rows.push_back(row_of_channel(channel));
    for (const auto& calibration : header.calibrations) {
        rows.push_back(row_of_calibration(calibration));
        for (const auto& [reading, correction] : calibration.corrections)
            rows.push_back(
                chained("channel_correction", {whole(calibration.channel), reading, correction}));
    }
    const auto& [alignment, setup, eve_source, synchronisation] = attachments;
    if (alignment) {
        rows.push_back(row_of_alignment(*alignment));
        for (const AlignmentPlace& place : alignment->places)
            rows.push_back(row_of_place(place));
    }
    std::ranges::move(rows_of(setup), std::back_inserter(rows));
    if (!eve_source.empty()) rows.push_back(chained("eve_source", {eve_source}));
    return rows;
}

namespace {

/// u_t_ns and synchronisation_um: the last columns of a datum, of a point those before its samples.
void append_synchronisation(Row& row, const std::optional<Synchronisation>& stated) {
    row.push_back(stated ? whole(stated->time_uncertainty.count()) : Value{});
    row.push_back(stated ? Value{stated->error_um} : Value{});
}

} // namespace

ChainedRow row_of(const DatumRecord& datum, const std::optional<Synchronisation>& stated) {
    const auto& [id, at, coordinate, reading, epoch, spread, slope_um_per_s, n, sequence,
                 device_count] = datum;
    Row row{id,          nanoseconds(at), coordinate.si(), reading.si(),    whole(epoch),
            spread.si(), slope_um_per_s,  whole(n),        whole(sequence), whole(device_count)};
    append_synchronisation(row, stated);
    return chained("datum", std::move(row));
}

ChainedRow row_of(const PointRecord& point, const std::optional<Synchronisation>& stated) {
    const auto& [step, sequence, planned, origin, triggered_at, window_begin, window_end, reading,
                 spread, slope_um_per_s, n, approach_travel, datum_id, live_deviation, samples] =
        point;
    Row row{whole(step),
            whole(sequence),
            whole(planned.step),
            whole(planned.target_index),
            text(name_of(planned.direction)),
            whole(planned.approach),
            text(name_of(origin)),
            nanoseconds(triggered_at),
            nanoseconds(window_begin),
            nanoseconds(window_end),
            reading.si(),
            spread.si(),
            slope_um_per_s,
            whole(n),
            approach_travel.si(),
            datum_id,
            live_deviation.si()};
    append_synchronisation(row, stated);
    // A list in braces would copy all samples once more.
    row.push_back(Blob{packed_window(samples)});
    return chained("point", std::move(row));
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

ChainedRow row_of(const StreamSetup& stream) {
    const auto& [id, channel, name, unit, nominal_rate_hz] = stream;
    return chained("stream", {whole(id), whole(channel), name, unit, nominal_rate_hz});
}

ChainedRow row_of(const StreamBlock& block) {
    const auto& [stream, index, first_count, samples, missing, before, begin, end, low, high,
                 packed, time_uncertainty] = block;
    Value u_t_ns;
    if (time_uncertainty > Duration{}) u_t_ns = whole(time_uncertainty.count());
    return chained("stream_block",
                   {whole(stream), whole(index), whole(first_count), whole(samples), whole(missing),
                    before, nanoseconds(begin), nanoseconds(end), low, high, u_t_ns, Blob{packed}});
}

ChainedRow row_of(const PreflightRecord& check) {
    const auto& [name, passed, warning, verdict, override_reason] = check;
    return chained("preflight", {name, whole(passed), whole(warning), verdict, override_reason});
}

ChainedRow row_of(const ExclusionRecord& exclusion) {
    const auto& [step, at, utc_ns, reason] = exclusion;
    return chained("exclusion", {whole(step), nanoseconds(at), utc_ns, reason});
}

ChainedRow row_of(const AnswerRecord& answer) {
    const auto& [finding, at, utc_ns, text] = answer;
    return chained("answer", {finding, nanoseconds(at), utc_ns, text});
}

ChainedRow row_of(const OrderRecord& order) {
    const auto& [kind, about, at, utc_ns, by] = order;
    Value uid;
    if (by.uid) uid = *by.uid;
    return chained("ordered",
                   {kind, about, nanoseconds(at), utc_ns, by.door, uid, by.user, by.name});
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
    return table.name == "retake" || table.name == "exclusion" || table.name == "answer";
}
} // namespace axiscal
