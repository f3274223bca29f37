-- What schema 3 of an axiscal run file adds: how the beam was aligned, if it was watched;
-- what makes a run a drift test; the drift test that a budget's E_VE comes from.
CREATE TABLE alignment(link INTEGER PRIMARY KEY, began_utc_ns INTEGER NOT NULL,
    ended_utc_ns INTEGER NOT NULL, instrument TEXT NOT NULL, serial TEXT NOT NULL,
    travel_m ANY NOT NULL, reached_m ANY NOT NULL, readings INTEGER NOT NULL, lost INTEGER NOT NULL,
    restarts INTEGER NOT NULL, far_distance_m ANY, far_highest_m ANY, far_last_m ANY,
    far_scatter_m ANY, far_blocks INTEGER, far_passed_maximum INTEGER, spot_offset_m ANY,
    hash BLOB NOT NULL) STRICT;
CREATE TABLE alignment_place(link INTEGER PRIMARY KEY, begin_m ANY NOT NULL, end_m ANY NOT NULL,
    readings INTEGER NOT NULL, weakest_percent ANY NOT NULL, mean_percent ANY NOT NULL,
    last_percent ANY NOT NULL, hash BLOB NOT NULL) STRICT;
CREATE TABLE drift(link INTEGER PRIMARY KEY, duration_ns INTEGER NOT NULL,
    interval_ns INTEGER NOT NULL, place_m ANY NOT NULL, hash BLOB NOT NULL) STRICT;
CREATE TABLE eve_source(link INTEGER PRIMARY KEY, run_id TEXT NOT NULL, hash BLOB NOT NULL) STRICT;
