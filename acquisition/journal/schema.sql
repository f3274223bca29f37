-- Schema 1 of an axiscal run file. docs/run-file.md explains tables, units and the hash chain.
-- Columns of type ANY hold IEEE doubles: STRICT's REAL would turn a negative zero into zero.
CREATE TABLE run(link INTEGER PRIMARY KEY, run_id TEXT NOT NULL, software_version TEXT NOT NULL,
    station TEXT NOT NULL, station_config TEXT NOT NULL, config_hash TEXT NOT NULL,
    boot_id TEXT NOT NULL, opened_before_ns INTEGER NOT NULL, opened_utc_ns INTEGER NOT NULL,
    opened_after_ns INTEGER NOT NULL, hash BLOB NOT NULL) STRICT;
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
CREATE TABLE statement(link INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE, value TEXT NOT NULL,
    hash BLOB NOT NULL) STRICT;
CREATE TABLE instrument(link INTEGER PRIMARY KEY, name TEXT NOT NULL, driver TEXT NOT NULL,
    maker TEXT NOT NULL, model TEXT NOT NULL, serial TEXT NOT NULL, firmware TEXT NOT NULL,
    certificate_number TEXT NOT NULL, calibrated_on TEXT NOT NULL, due_on TEXT NOT NULL,
    hash BLOB NOT NULL) STRICT;
CREATE TABLE channel(link INTEGER PRIMARY KEY, id INTEGER NOT NULL, name TEXT NOT NULL,
    instrument TEXT NOT NULL, place TEXT NOT NULL, kind TEXT NOT NULL, medium TEXT NOT NULL,
    correction ANY NOT NULL, hash BLOB NOT NULL) STRICT;
CREATE TABLE datum(link INTEGER PRIMARY KEY, id TEXT NOT NULL, at_ns INTEGER NOT NULL,
    coordinate_m ANY NOT NULL, reading_m ANY NOT NULL, epoch INTEGER NOT NULL,
    spread_m ANY NOT NULL, slope_um_per_s ANY NOT NULL, n INTEGER NOT NULL,
    sequence INTEGER NOT NULL, device_count INTEGER NOT NULL, hash BLOB NOT NULL) STRICT;
CREATE TABLE point(link INTEGER PRIMARY KEY, step INTEGER NOT NULL UNIQUE,
    sequence INTEGER NOT NULL, planned_step INTEGER NOT NULL, target_index INTEGER NOT NULL,
    direction TEXT NOT NULL, approach INTEGER NOT NULL, origin TEXT NOT NULL,
    triggered_ns INTEGER NOT NULL, window_begin_ns INTEGER NOT NULL,
    window_end_ns INTEGER NOT NULL, reading_m ANY NOT NULL, spread_m ANY NOT NULL,
    slope_um_per_s ANY NOT NULL, n INTEGER NOT NULL, approach_travel_m ANY NOT NULL,
    datum_id TEXT NOT NULL, live_deviation_m ANY NOT NULL, samples BLOB NOT NULL,
    hash BLOB NOT NULL) STRICT;
CREATE TABLE environment(link INTEGER PRIMARY KEY, channel INTEGER NOT NULL,
    at_ns INTEGER NOT NULL, value ANY NOT NULL, hash BLOB NOT NULL) STRICT;
CREATE TABLE event(link INTEGER PRIMARY KEY, kind TEXT NOT NULL, at_ns INTEGER NOT NULL,
    utc_ns INTEGER NOT NULL, text TEXT NOT NULL, fault TEXT NOT NULL, sequence INTEGER NOT NULL,
    hash BLOB NOT NULL) STRICT;
CREATE TABLE closing(link INTEGER PRIMARY KEY, complete INTEGER NOT NULL, reason TEXT NOT NULL,
    closed_before_ns INTEGER NOT NULL, closed_utc_ns INTEGER NOT NULL,
    closed_after_ns INTEGER NOT NULL, hash BLOB NOT NULL) STRICT;
CREATE TABLE result(id INTEGER PRIMARY KEY, digest TEXT NOT NULL, document TEXT NOT NULL,
    hash BLOB NOT NULL) STRICT;
