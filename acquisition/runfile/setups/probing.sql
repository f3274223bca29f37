CREATE TABLE probing(link INTEGER PRIMARY KEY, feed_mm_per_min ANY NOT NULL, probe TEXT NOT NULL,
    signal_path TEXT NOT NULL, hash BLOB NOT NULL) STRICT;
CREATE TABLE probing_touch(link INTEGER PRIMARY KEY, direction_x ANY NOT NULL,
    direction_y ANY NOT NULL, direction_z ANY NOT NULL, reference INTEGER NOT NULL,
    approach_m ANY NOT NULL, x_m ANY NOT NULL, y_m ANY NOT NULL, z_m ANY NOT NULL,
    hash BLOB NOT NULL) STRICT;
