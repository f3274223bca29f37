CREATE TABLE circular(link INTEGER PRIMARY KEY, plane TEXT NOT NULL, radius_mm ANY NOT NULL,
    feed_mm_per_s ANY NOT NULL, senses TEXT NOT NULL, repeats INTEGER NOT NULL,
    warm_up INTEGER NOT NULL, start_deg ANY NOT NULL, arc_deg ANY NOT NULL,
    overshoot_deg ANY NOT NULL, feed_in_mm ANY NOT NULL, feed_in_outside INTEGER NOT NULL,
    centre_x_mm ANY NOT NULL, centre_y_mm ANY NOT NULL, centre_z_mm ANY NOT NULL,
    tool_offset TEXT NOT NULL, work_offset TEXT NOT NULL, sample_rate_hz ANY NOT NULL,
    low_pass_hz ANY, averaged INTEGER NOT NULL, start_from TEXT NOT NULL,
    trigger_delay_s ANY NOT NULL, hash BLOB NOT NULL) STRICT;
CREATE TABLE circular_bar(link INTEGER PRIMARY KEY, instrument TEXT NOT NULL,
    sign INTEGER NOT NULL, length_mm ANY NOT NULL, bar_alpha_per_K ANY, machine_alpha_per_K ANY,
    temperature_channel INTEGER, hash BLOB NOT NULL) STRICT;
CREATE TABLE circular_uncertainty(link INTEGER PRIMARY KEY, device_width_um ANY,
    calibration_U_um ANY, calibration_k ANY, repeatability_um ANY, eve_um ANY,
    centre_width_um ANY, machine_temperature_width_K ANY, bar_temperature_width_K ANY,
    machine_alpha_width_per_K ANY, bar_alpha_width_per_K ANY, runs INTEGER NOT NULL,
    hash BLOB NOT NULL) STRICT;
