-- What schema 2 of an axiscal run file adds to schema.sql: the uncertainty statement, if any.
CREATE TABLE uncertainty(link INTEGER PRIMARY KEY, device_U_m ANY, device_U_per_m ANY,
    device_k ANY NOT NULL, device_width_m ANY, device_width_per_m ANY, misalignment_m ANY,
    misalignment_rad ANY, temperature_width_K ANY, expansion_width_per_K ANY, eve_m ANY,
    eve_model TEXT NOT NULL, hash BLOB NOT NULL) STRICT;
CREATE TABLE uncertainty_target(link INTEGER PRIMARY KEY, parameter TEXT NOT NULL UNIQUE,
    limit_m ANY NOT NULL, hash BLOB NOT NULL) STRICT;
