-- What schema 4 of an axiscal run file adds: the certificates of single channels, if stated; what
-- makes a run a probing test; what the uncertain time of the samples adds to each captured reading
-- (both numbers are NULL where the instrument's clock states no uncertainty); where begin and end of
-- a circle come from; u(t) of the block that stands before; how the angle of a rotary axis is
-- measured, and what the certificate of its artefact says of each position, that of position 0 first.
CREATE TABLE channel_calibration(link INTEGER PRIMARY KEY, channel INTEGER NOT NULL UNIQUE,
    certificate_number TEXT NOT NULL, calibrated_on TEXT NOT NULL, due_on TEXT NOT NULL,
    expanded_uncertainty ANY, expanded_uncertainty_per_m ANY, coverage ANY NOT NULL,
    hash BLOB NOT NULL) STRICT;
CREATE TABLE channel_correction(link INTEGER PRIMARY KEY, channel INTEGER NOT NULL,
    reading ANY NOT NULL, correction ANY NOT NULL, hash BLOB NOT NULL) STRICT;
CREATE TABLE probing(link INTEGER PRIMARY KEY, feed_mm_per_min ANY NOT NULL, probe TEXT NOT NULL,
    signal_path TEXT NOT NULL, hash BLOB NOT NULL) STRICT;
CREATE TABLE probing_touch(link INTEGER PRIMARY KEY, direction_x ANY NOT NULL,
    direction_y ANY NOT NULL, direction_z ANY NOT NULL, reference INTEGER NOT NULL,
    approach_m ANY NOT NULL, x_m ANY NOT NULL, y_m ANY NOT NULL, z_m ANY NOT NULL,
    hash BLOB NOT NULL) STRICT;
CREATE TABLE synchronisation(link INTEGER PRIMARY KEY, step INTEGER NOT NULL,
    datum_id TEXT NOT NULL, u_t_ns INTEGER, error_um ANY, hash BLOB NOT NULL,
    UNIQUE(step, datum_id)) STRICT;
CREATE TABLE circular_start(link INTEGER PRIMARY KEY, start_from TEXT NOT NULL,
    trigger_delay_s ANY NOT NULL, hash BLOB NOT NULL) STRICT;
CREATE TABLE stream_block_time(link INTEGER PRIMARY KEY, stream INTEGER NOT NULL,
    block INTEGER NOT NULL, u_t_ns INTEGER, hash BLOB NOT NULL) STRICT;
CREATE TABLE rotary(link INTEGER PRIMARY KEY, method TEXT NOT NULL, step_deg ANY NOT NULL,
    arm_m ANY NOT NULL, range_deg ANY NOT NULL, turn_time_ns INTEGER NOT NULL,
    by_hand INTEGER NOT NULL, certificate_with_axis INTEGER NOT NULL, run_out TEXT NOT NULL,
    hash BLOB NOT NULL) STRICT;
CREATE TABLE rotary_deviation(link INTEGER PRIMARY KEY, deviation_arcsec ANY NOT NULL,
    hash BLOB NOT NULL) STRICT;
