-- Times are microseconds since 1970-01-01 UTC, ids are UUID version 7 in lower-case text (so that they sort by time),
-- blobs are named by the blake3 hash of their bytes, and columns with structured content hold JSON.

CREATE TABLE maps (
    id             TEXT    NOT NULL PRIMARY KEY,
    name           TEXT    NOT NULL,
    created        INTEGER NOT NULL,
    updated        INTEGER NOT NULL,
    width          INTEGER NOT NULL,
    height         INTEGER NOT NULL,
    resolution     REAL    NOT NULL,
    georeference   TEXT,
    warnings       TEXT    NOT NULL,
    source         TEXT    NOT NULL, -- blob of the upload
    analysis       TEXT    REFERENCES analyses (id) DEFERRABLE INITIALLY DEFERRED, -- the one that answers
    analysis_asked TEXT,             -- the request that put it in force: of two, the later one wins
    version        INTEGER NOT NULL
) STRICT;

CREATE INDEX maps_source ON maps (source);

CREATE TABLE analyses (
    id          TEXT    NOT NULL PRIMARY KEY,
    map         TEXT    NOT NULL REFERENCES maps (id) ON DELETE CASCADE,
    job         TEXT    NOT NULL UNIQUE, -- the job that made it: never two results of one job
    created     INTEGER NOT NULL,
    options     TEXT    NOT NULL,
    algorithm   INTEGER NOT NULL,
    address     TEXT    NOT NULL,        -- hash of source, options and algorithm version
    blob        TEXT    NOT NULL,
    stages      TEXT    NOT NULL,
    diagnostics TEXT    NOT NULL,
    UNIQUE (map, address)
) STRICT;

CREATE INDEX analyses_blob ON analyses (blob);

CREATE TABLE jobs (
    id               TEXT    NOT NULL PRIMARY KEY,
    map              TEXT    NOT NULL REFERENCES maps (id) ON DELETE CASCADE,
    state            TEXT    NOT NULL CHECK (state IN ('accepted', 'running', 'successful', 'failed', 'dismissed')),
    options          TEXT    NOT NULL,
    address          TEXT    NOT NULL,           -- of the analysis it will make
    progress         INTEGER NOT NULL DEFAULT 0,
    stage            TEXT,
    stages           TEXT    NOT NULL DEFAULT '[]',
    message          TEXT    NOT NULL DEFAULT '',
    attempt          INTEGER NOT NULL DEFAULT 0, -- attempts begun; given back when the service is stopped
    claim            INTEGER NOT NULL DEFAULT 0, -- the fencing token: raised by every claim, never lowered
    run_at           INTEGER NOT NULL DEFAULT 0, -- not before; 0 (whatever the clock says) is at once
    lease_until      INTEGER,                    -- while running
    cancel_requested INTEGER NOT NULL DEFAULT 0,
    created          INTEGER NOT NULL,
    started          INTEGER,
    finished         INTEGER,
    updated          INTEGER NOT NULL,
    analysis         TEXT    REFERENCES analyses (id) ON DELETE SET NULL DEFERRABLE INITIALLY DEFERRED
) STRICT;

CREATE INDEX jobs_waiting ON jobs (id) WHERE state = 'accepted';
CREATE INDEX jobs_running ON jobs (lease_until) WHERE state = 'running';
CREATE INDEX jobs_map ON jobs (map, id);
CREATE INDEX jobs_analysis ON jobs (analysis);

-- A repeated upload answers the job of the first one.
CREATE TABLE idempotency_keys (
    key     TEXT    NOT NULL PRIMARY KEY,
    content TEXT    NOT NULL, -- hash of the request
    job     TEXT    NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
    created INTEGER NOT NULL
) STRICT;

CREATE INDEX idempotency_keys_created ON idempotency_keys (created);
CREATE INDEX idempotency_keys_job ON idempotency_keys (job);

CREATE TABLE rule_sets (
    id      TEXT    NOT NULL PRIMARY KEY,
    draft   TEXT    NOT NULL,
    version INTEGER NOT NULL
) STRICT;

-- Human decisions: immutable, each bound to the analysis whose categories it names.
CREATE TABLE semantics_versions (
    map        TEXT    NOT NULL REFERENCES maps (id) ON DELETE CASCADE,
    version    INTEGER NOT NULL,
    analysis   TEXT    NOT NULL REFERENCES analyses (id) ON DELETE CASCADE,
    rule_set   TEXT    NOT NULL,
    draft      TEXT    NOT NULL, -- the rule set as it was
    assignment TEXT    NOT NULL,
    created    INTEGER NOT NULL,
    PRIMARY KEY (map, version)
) STRICT, WITHOUT ROWID;

CREATE INDEX semantics_versions_analysis ON semantics_versions (analysis, version);
