CREATE TABLE squareness(link INTEGER PRIMARY KEY, square TEXT NOT NULL, method TEXT NOT NULL,
    across TEXT NOT NULL, sign INTEGER NOT NULL, factor ANY NOT NULL, resolution_m ANY NOT NULL,
    mirror TEXT NOT NULL, reversal_of TEXT NOT NULL, base_m ANY NOT NULL,
    angle_resolution_rad ANY NOT NULL, place TEXT NOT NULL, first_run_id TEXT NOT NULL,
    first_axis TEXT NOT NULL, first_across TEXT NOT NULL, first_readings INTEGER NOT NULL,
    first_scatter_m ANY NOT NULL, hash BLOB NOT NULL) STRICT;
CREATE TABLE squareness_uncertainty(link INTEGER PRIMARY KEY, factor_U ANY, factor_limit ANY,
    factor_k ANY NOT NULL, mirror_limit_um_per_m2 ANY, angle_U_rad ANY, angle_k ANY NOT NULL,
    base_U_m ANY, base_k ANY NOT NULL, eve_m ANY, eve_rad ANY, error_rad ANY, error_U_rad ANY,
    error_limit_rad ANY, error_k ANY NOT NULL, mount_limit_rad ANY, hash BLOB NOT NULL) STRICT;
CREATE TABLE squareness_other(link INTEGER PRIMARY KEY, first_run_id TEXT NOT NULL,
    first_axis TEXT NOT NULL, first_across TEXT NOT NULL, first_readings INTEGER NOT NULL,
    first_scatter_m ANY NOT NULL, second_run_id TEXT NOT NULL, second_axis TEXT NOT NULL,
    second_across TEXT NOT NULL, second_readings INTEGER NOT NULL, second_scatter_m ANY NOT NULL,
    hash BLOB NOT NULL) STRICT;
CREATE TABLE squareness_line_row(link INTEGER PRIMARY KEY, line TEXT NOT NULL, target_m ANY NOT NULL,
    forward_m ANY NOT NULL, backward_m ANY, hash BLOB NOT NULL) STRICT;
