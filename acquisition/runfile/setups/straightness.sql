CREATE TABLE straightness(link INTEGER PRIMARY KEY, method TEXT NOT NULL, across TEXT NOT NULL,
    sign INTEGER NOT NULL, factor ANY NOT NULL, resolution_m ANY NOT NULL, mirror TEXT NOT NULL,
    reversal_of TEXT NOT NULL, base_m ANY NOT NULL, angle_resolution_rad ANY NOT NULL,
    place TEXT NOT NULL, hash BLOB NOT NULL) STRICT;
CREATE TABLE straightness_uncertainty(link INTEGER PRIMARY KEY, factor_U ANY, factor_limit ANY,
    factor_k ANY NOT NULL, mirror_limit_um_per_m2 ANY, angle_U_rad ANY, angle_k ANY NOT NULL,
    base_U_m ANY, base_k ANY NOT NULL, eve_m ANY, eve_rad ANY, hash BLOB NOT NULL) STRICT;
