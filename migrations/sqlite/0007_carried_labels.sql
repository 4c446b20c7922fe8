-- A version of the labels may be carried over from a version on another analysis of the map. SQLite cannot change a CHECK,
-- so that the table is built anew; nothing refers to it.

CREATE TABLE new_semantics_versions (
    map        TEXT    NOT NULL REFERENCES maps (id) ON DELETE CASCADE,
    version    INTEGER NOT NULL,
    analysis   TEXT    NOT NULL REFERENCES analyses (id) ON DELETE CASCADE,
    rule_set   TEXT    NOT NULL,
    draft      TEXT    NOT NULL, -- the rule set as it was
    assignment TEXT    NOT NULL,
    layout     TEXT    NOT NULL DEFAULT '{}',
    origin     TEXT    NOT NULL CHECK (origin IN ('suggested', 'assigned', 'carried')),
    carried    TEXT,             -- JSON: the version it was carried over from, what was kept and what was lost
    created    INTEGER NOT NULL,
    PRIMARY KEY (map, version),
    CHECK ((origin = 'carried') = (carried IS NOT NULL))
) STRICT, WITHOUT ROWID;

INSERT INTO new_semantics_versions (map, version, analysis, rule_set, draft, assignment, layout, origin, created)
SELECT map, version, analysis, rule_set, draft, assignment, layout, origin, created FROM semantics_versions;

DROP TABLE semantics_versions;
ALTER TABLE new_semantics_versions RENAME TO semantics_versions;

CREATE INDEX semantics_versions_analysis ON semantics_versions (analysis, version);

-- Whose labels are carried over: of the analyses with decisions, the one that answered last before the one in force.
ALTER TABLE maps ADD COLUMN decided_before TEXT REFERENCES analyses (id) DEFERRABLE INITIALLY DEFERRED;
