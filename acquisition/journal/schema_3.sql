-- What schema 3 of an axiscal run file adds: checks before the run, points taken again, readings
-- left out. A row of retake or exclusion may follow a closing row; the run is then closed again.
CREATE TABLE preflight(link INTEGER PRIMARY KEY, name TEXT NOT NULL, passed INTEGER NOT NULL,
    warning INTEGER NOT NULL, verdict TEXT NOT NULL, override_reason TEXT NOT NULL, hash BLOB NOT NULL) STRICT;
CREATE TABLE retake(link INTEGER PRIMARY KEY, number INTEGER NOT NULL UNIQUE, at_ns INTEGER NOT NULL,
    utc_ns INTEGER NOT NULL, reason TEXT NOT NULL, hash BLOB NOT NULL) STRICT;
CREATE TABLE retake_point(link INTEGER PRIMARY KEY, step INTEGER NOT NULL UNIQUE,
    planned_step INTEGER NOT NULL, hash BLOB NOT NULL) STRICT;
CREATE TABLE exclusion(link INTEGER PRIMARY KEY, step INTEGER NOT NULL UNIQUE, at_ns INTEGER NOT NULL,
    utc_ns INTEGER NOT NULL, reason TEXT NOT NULL, hash BLOB NOT NULL) STRICT;
