-- What schema 7 of an axiscal run file adds: signatures of the closings and of the results computed
-- of them. Like `result` it is no table of the chain.
CREATE TABLE signature(id INTEGER PRIMARY KEY, closing INTEGER NOT NULL, closing_hash BLOB NOT NULL,
    result_hash BLOB, public_key BLOB NOT NULL, signature BLOB NOT NULL) STRICT;
-- Who ordered what was decided about the run; a table of the chain.
CREATE TABLE ordered(link INTEGER PRIMARY KEY, kind TEXT NOT NULL, about TEXT NOT NULL,
    at_ns INTEGER NOT NULL, utc_ns INTEGER NOT NULL, door TEXT NOT NULL, uid INTEGER,
    user TEXT NOT NULL, name TEXT NOT NULL, hash BLOB NOT NULL) STRICT;
