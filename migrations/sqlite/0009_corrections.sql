-- A version of the semantics may have corrections of the map. A list of them never changes and is named by all versions that
-- have it.

CREATE TABLE correction_lists (
    map         TEXT    NOT NULL REFERENCES maps (id) ON DELETE CASCADE,
    number      INTEGER NOT NULL,
    corrections TEXT    NOT NULL, -- JSON, in metres of the map frame, each with the number of its id
    newest      INTEGER NOT NULL, -- the highest number that a correction of the map had when the list was made
    PRIMARY KEY (map, number)
) STRICT;

ALTER TABLE semantics_versions ADD COLUMN corrections INTEGER; -- number of the list
ALTER TABLE semantics_versions ADD COLUMN correction_count INTEGER NOT NULL DEFAULT 0;

-- The version that a version equals because a person went back or forth to it.
ALTER TABLE semantics_versions ADD COLUMN restores INTEGER;
