-- What schema 5 of an axiscal run file adds: the linear scale that measured the axis in the place of
-- a laser, and which channels are the temperatures on it.
CREATE TABLE linear_scale(link INTEGER PRIMARY KEY, resolution_m ANY NOT NULL,
    coefficient_per_K ANY NOT NULL, standard_uncertainty_per_K ANY, temperature_width_K ANY,
    hash BLOB NOT NULL) STRICT;
CREATE TABLE linear_scale_sensor(link INTEGER PRIMARY KEY, channel INTEGER NOT NULL UNIQUE,
    hash BLOB NOT NULL) STRICT;
