CREATE TABLE straightness_reversal(link INTEGER PRIMARY KEY, axis TEXT NOT NULL, across TEXT NOT NULL,
    readings INTEGER NOT NULL, scatter_m ANY NOT NULL, hash BLOB NOT NULL) STRICT;
CREATE TABLE straightness_reversal_row(link INTEGER PRIMARY KEY, target_m ANY NOT NULL,
    forward_m ANY NOT NULL, backward_m ANY, hash BLOB NOT NULL) STRICT;
