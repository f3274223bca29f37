-- Schema of an axiscal run file. docs/run-file.md explains tables, units and the hash chain.
-- Columns of type ANY hold IEEE doubles: STRICT's REAL would turn a negative zero into zero.
-- A line that is the name of a file stands for the tables in it, those of one kind of test.
-- The header: written when the run is armed.
CREATE TABLE run(link INTEGER PRIMARY KEY, run_id TEXT NOT NULL, software_version TEXT NOT NULL,
    station TEXT NOT NULL, station_config TEXT NOT NULL, config_hash TEXT NOT NULL,
    boot_id TEXT NOT NULL, opened_before_ns INTEGER NOT NULL, opened_utc_ns INTEGER NOT NULL,
    opened_after_ns INTEGER NOT NULL, hash BLOB NOT NULL) STRICT;
CREATE TABLE test(link INTEGER PRIMARY KEY, kind TEXT NOT NULL, hash BLOB NOT NULL) STRICT;
CREATE TABLE plan(link INTEGER PRIMARY KEY, axis_kind TEXT NOT NULL, cycle TEXT NOT NULL,
    pass TEXT NOT NULL, remark TEXT NOT NULL, approaches INTEGER NOT NULL,
    bidirectional INTEGER NOT NULL, interval_m ANY NOT NULL, seed INTEGER,
    overrun_m ANY NOT NULL, near_tolerance_m ANY NOT NULL, datum_m ANY NOT NULL,
    hash BLOB NOT NULL) STRICT;
CREATE TABLE plan_target(link INTEGER PRIMARY KEY, position_m ANY NOT NULL,
    hash BLOB NOT NULL) STRICT;
CREATE TABLE plan_point(link INTEGER PRIMARY KEY, step INTEGER NOT NULL,
    target_index INTEGER NOT NULL, direction TEXT NOT NULL, approach INTEGER NOT NULL,
    hash BLOB NOT NULL) STRICT;
CREATE TABLE laser(link INTEGER PRIMARY KEY, instrument TEXT NOT NULL,
    vacuum_wavelength_m ANY NOT NULL, optical_fold ANY NOT NULL, sign INTEGER NOT NULL,
    dead_path_m ANY NOT NULL, beam_walk_m ANY NOT NULL, beam_walk_travel_m ANY NOT NULL,
    hash BLOB NOT NULL) STRICT;
CREATE TABLE material(link INTEGER PRIMARY KEY, coefficient_per_K ANY NOT NULL,
    standard_uncertainty_per_K ANY, feedback TEXT NOT NULL, form TEXT NOT NULL,
    hash BLOB NOT NULL) STRICT;
CREATE TABLE air(link INTEGER PRIMARY KEY, formula TEXT NOT NULL, co2_ppm ANY NOT NULL,
    oldest_ns INTEGER NOT NULL, hash BLOB NOT NULL) STRICT;
-- How the angle of a rotary axis is measured, and what the certificate of its artefact says of each
-- position, that of position 0 first.
CREATE TABLE rotary(link INTEGER PRIMARY KEY, method TEXT NOT NULL, step_deg ANY NOT NULL,
    arm_m ANY NOT NULL, range_deg ANY NOT NULL, turn_time_ns INTEGER NOT NULL,
    by_hand INTEGER NOT NULL, certificate_with_axis INTEGER NOT NULL, run_out TEXT NOT NULL,
    hash BLOB NOT NULL) STRICT;
CREATE TABLE rotary_deviation(link INTEGER PRIMARY KEY, deviation_arcsec ANY NOT NULL,
    hash BLOB NOT NULL) STRICT;
-- The linear scale that measured the axis in the place of a laser, and the channels of the temperatures on it.
CREATE TABLE linear_scale(link INTEGER PRIMARY KEY, resolution_m ANY NOT NULL,
    coefficient_per_K ANY NOT NULL, standard_uncertainty_per_K ANY, temperature_width_K ANY,
    hash BLOB NOT NULL) STRICT;
CREATE TABLE linear_scale_sensor(link INTEGER PRIMARY KEY, channel INTEGER NOT NULL UNIQUE,
    hash BLOB NOT NULL) STRICT;
-- Readings by others: `point.reading_m` is their deviation.
CREATE TABLE imported(link INTEGER PRIMARY KEY, file TEXT NOT NULL, form TEXT NOT NULL,
    sha256 TEXT NOT NULL, measured TEXT NOT NULL, remark TEXT NOT NULL, hash BLOB NOT NULL) STRICT;
CREATE TABLE uncertainty(link INTEGER PRIMARY KEY, device_U_m ANY, device_U_per_m ANY,
    device_k ANY NOT NULL, device_width_m ANY, device_width_per_m ANY, misalignment_m ANY,
    misalignment_rad ANY, temperature_width_K ANY, expansion_width_per_K ANY, eve_m ANY,
    eve_model TEXT NOT NULL, hash BLOB NOT NULL) STRICT;
CREATE TABLE uncertainty_target(link INTEGER PRIMARY KEY, parameter TEXT NOT NULL UNIQUE,
    limit_m ANY NOT NULL, hash BLOB NOT NULL) STRICT;
-- The limits that were agreed on, in `unit` of the set, and the rule by which figures are held against them.
CREATE TABLE tolerance_set(link INTEGER PRIMARY KEY, name TEXT NOT NULL, source TEXT NOT NULL,
    unit TEXT NOT NULL, rule TEXT NOT NULL, to_be_checked INTEGER NOT NULL,
    hash BLOB NOT NULL) STRICT;
CREATE TABLE tolerance_limit(link INTEGER PRIMARY KEY, parameter TEXT NOT NULL, travel_up_to ANY,
    largest ANY NOT NULL, hash BLOB NOT NULL) STRICT;
-- By which the figures are computed and named, the certificate's own first.
CREATE TABLE standard(link INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE,
    hash BLOB NOT NULL) STRICT;
CREATE TABLE statement(link INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE, value TEXT NOT NULL,
    hash BLOB NOT NULL) STRICT;
CREATE TABLE instrument(link INTEGER PRIMARY KEY, name TEXT NOT NULL, driver TEXT NOT NULL,
    maker TEXT NOT NULL, model TEXT NOT NULL, serial TEXT NOT NULL, firmware TEXT NOT NULL,
    certificate_number TEXT NOT NULL, calibrated_on TEXT NOT NULL, due_on TEXT NOT NULL,
    hash BLOB NOT NULL) STRICT;
CREATE TABLE channel(link INTEGER PRIMARY KEY, id INTEGER NOT NULL, name TEXT NOT NULL,
    instrument TEXT NOT NULL, place TEXT NOT NULL, kind TEXT NOT NULL, medium TEXT NOT NULL,
    correction ANY NOT NULL, hash BLOB NOT NULL) STRICT;
-- The certificates of single channels.
CREATE TABLE channel_calibration(link INTEGER PRIMARY KEY, channel INTEGER NOT NULL UNIQUE,
    certificate_number TEXT NOT NULL, calibrated_on TEXT NOT NULL, due_on TEXT NOT NULL,
    expanded_uncertainty ANY, expanded_uncertainty_per_m ANY, coverage ANY NOT NULL,
    hash BLOB NOT NULL) STRICT;
CREATE TABLE channel_correction(link INTEGER PRIMARY KEY, channel INTEGER NOT NULL,
    reading ANY NOT NULL, correction ANY NOT NULL, hash BLOB NOT NULL) STRICT;
-- How the beam was aligned, if it was watched.
CREATE TABLE alignment(link INTEGER PRIMARY KEY, began_utc_ns INTEGER NOT NULL,
    ended_utc_ns INTEGER NOT NULL, instrument TEXT NOT NULL, serial TEXT NOT NULL,
    travel_m ANY NOT NULL, reached_m ANY NOT NULL, readings INTEGER NOT NULL, lost INTEGER NOT NULL,
    restarts INTEGER NOT NULL, far_distance_m ANY, far_highest_m ANY, far_last_m ANY,
    far_scatter_m ANY, far_blocks INTEGER, far_passed_maximum INTEGER, spot_offset_m ANY,
    hash BLOB NOT NULL) STRICT;
CREATE TABLE alignment_place(link INTEGER PRIMARY KEY, begin_m ANY NOT NULL, end_m ANY NOT NULL,
    readings INTEGER NOT NULL, weakest_percent ANY NOT NULL, mean_percent ANY NOT NULL,
    last_percent ANY NOT NULL, hash BLOB NOT NULL) STRICT;
-- setups/drift.sql
-- setups/probing.sql
-- The drift test that a budget's E_VE comes from.
CREATE TABLE eve_source(link INTEGER PRIMARY KEY, run_id TEXT NOT NULL, hash BLOB NOT NULL) STRICT;
-- The run: what was captured, what was decided, how it ended. u_t_ns: u(t) of the samples;
-- synchronisation_um: what it adds to the reading; NULL: not stated.
CREATE TABLE datum(link INTEGER PRIMARY KEY, id TEXT NOT NULL, at_ns INTEGER NOT NULL,
    coordinate_m ANY NOT NULL, reading_m ANY NOT NULL, epoch INTEGER NOT NULL,
    spread_m ANY NOT NULL, slope_um_per_s ANY NOT NULL, n INTEGER NOT NULL,
    sequence INTEGER NOT NULL, device_count INTEGER NOT NULL, u_t_ns INTEGER,
    synchronisation_um ANY, hash BLOB NOT NULL) STRICT;
CREATE TABLE point(link INTEGER PRIMARY KEY, step INTEGER NOT NULL UNIQUE,
    sequence INTEGER NOT NULL, planned_step INTEGER NOT NULL, target_index INTEGER NOT NULL,
    direction TEXT NOT NULL, approach INTEGER NOT NULL, origin TEXT NOT NULL,
    triggered_ns INTEGER NOT NULL, window_begin_ns INTEGER NOT NULL,
    window_end_ns INTEGER NOT NULL, reading_m ANY NOT NULL, spread_m ANY NOT NULL,
    slope_um_per_s ANY NOT NULL, n INTEGER NOT NULL, approach_travel_m ANY NOT NULL,
    datum_id TEXT NOT NULL, live_deviation_m ANY NOT NULL, u_t_ns INTEGER,
    synchronisation_um ANY, samples BLOB NOT NULL, hash BLOB NOT NULL) STRICT;
CREATE TABLE environment(link INTEGER PRIMARY KEY, channel INTEGER NOT NULL,
    at_ns INTEGER NOT NULL, value ANY NOT NULL, hash BLOB NOT NULL) STRICT;
CREATE TABLE event(link INTEGER PRIMARY KEY, kind TEXT NOT NULL, at_ns INTEGER NOT NULL,
    utc_ns INTEGER NOT NULL, text TEXT NOT NULL, fault TEXT NOT NULL, sequence INTEGER NOT NULL,
    hash BLOB NOT NULL) STRICT;
-- setups/circular.sql
-- Channels recorded at their full rate. docs/run-file.md explains the bytes of stream_block.data.
CREATE TABLE stream(link INTEGER PRIMARY KEY, id INTEGER NOT NULL UNIQUE,
    channel INTEGER NOT NULL, name TEXT NOT NULL, unit TEXT NOT NULL,
    nominal_rate_hz ANY NOT NULL, hash BLOB NOT NULL) STRICT;
CREATE TABLE stream_block(link INTEGER PRIMARY KEY, stream INTEGER NOT NULL,
    block INTEGER NOT NULL, first_count INTEGER NOT NULL, samples INTEGER NOT NULL,
    missing INTEGER NOT NULL, before TEXT NOT NULL, begin_ns INTEGER NOT NULL,
    end_ns INTEGER NOT NULL, low ANY NOT NULL, high ANY NOT NULL, u_t_ns INTEGER,
    data BLOB NOT NULL, hash BLOB NOT NULL) STRICT;
-- A row of retake, exclusion or answer may follow a closing row; the run is then closed again.
CREATE TABLE preflight(link INTEGER PRIMARY KEY, name TEXT NOT NULL, passed INTEGER NOT NULL,
    warning INTEGER NOT NULL, verdict TEXT NOT NULL, override_reason TEXT NOT NULL, hash BLOB NOT NULL) STRICT;
CREATE TABLE retake(link INTEGER PRIMARY KEY, number INTEGER NOT NULL UNIQUE, at_ns INTEGER NOT NULL,
    utc_ns INTEGER NOT NULL, reason TEXT NOT NULL, hash BLOB NOT NULL) STRICT;
CREATE TABLE retake_point(link INTEGER PRIMARY KEY, step INTEGER NOT NULL UNIQUE,
    planned_step INTEGER NOT NULL, hash BLOB NOT NULL) STRICT;
CREATE TABLE exclusion(link INTEGER PRIMARY KEY, step INTEGER NOT NULL UNIQUE, at_ns INTEGER NOT NULL,
    utc_ns INTEGER NOT NULL, reason TEXT NOT NULL, hash BLOB NOT NULL) STRICT;
-- What a person answers to a finding about the set-up.
CREATE TABLE answer(link INTEGER PRIMARY KEY, finding TEXT NOT NULL, at_ns INTEGER NOT NULL,
    utc_ns INTEGER NOT NULL, text TEXT NOT NULL, hash BLOB NOT NULL) STRICT;
-- Who ordered what was decided about the run.
CREATE TABLE ordered(link INTEGER PRIMARY KEY, kind TEXT NOT NULL, about TEXT NOT NULL,
    at_ns INTEGER NOT NULL, utc_ns INTEGER NOT NULL, door TEXT NOT NULL, uid INTEGER,
    user TEXT NOT NULL, name TEXT NOT NULL, hash BLOB NOT NULL) STRICT;
CREATE TABLE closing(link INTEGER PRIMARY KEY, complete INTEGER NOT NULL, reason TEXT NOT NULL,
    closed_before_ns INTEGER NOT NULL, closed_utc_ns INTEGER NOT NULL,
    closed_after_ns INTEGER NOT NULL, hash BLOB NOT NULL) STRICT;
-- No tables of the chain: results bear their own hash, signatures sign closings and results.
CREATE TABLE result(id INTEGER PRIMARY KEY, digest TEXT NOT NULL, document TEXT NOT NULL,
    hash BLOB NOT NULL) STRICT;
CREATE TABLE signature(id INTEGER PRIMARY KEY, closing INTEGER NOT NULL, closing_hash BLOB NOT NULL,
    result_hash BLOB, public_key BLOB NOT NULL, signature BLOB NOT NULL) STRICT;
