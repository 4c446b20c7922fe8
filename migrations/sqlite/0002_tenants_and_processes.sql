-- Every map, job, rule set and idempotency key belongs to a tenant; what is there belongs to the local one. A job names
-- its process and holds the inputs and outputs of it; every job so far makes a semantic map.
--
-- Tables whose keys change are built anew. Dropping `jobs` deletes the idempotency keys that refer to it, so the keys
-- are carried over in a table that refers to nothing.

ALTER TABLE maps ADD COLUMN tenant TEXT NOT NULL DEFAULT 'local';

CREATE INDEX maps_tenant ON maps (tenant, id);

CREATE TABLE carried_keys (
    key     TEXT    NOT NULL,
    content TEXT    NOT NULL,
    job     TEXT    NOT NULL,
    created INTEGER NOT NULL
) STRICT;

INSERT INTO carried_keys (key, content, job, created) SELECT key, content, job, created FROM idempotency_keys;

DROP TABLE idempotency_keys;

CREATE TABLE new_jobs (
    id               TEXT    NOT NULL PRIMARY KEY,
    tenant           TEXT    NOT NULL,
    map              TEXT    NOT NULL REFERENCES maps (id) ON DELETE CASCADE, -- what it works on and is deleted with
    process          TEXT    NOT NULL,           -- what computes it
    inputs           TEXT    NOT NULL,           -- what the process is given beside the map, JSON
    outputs          TEXT,                       -- what it made, JSON; an analysis by its id
    state            TEXT    NOT NULL CHECK (state IN ('accepted', 'running', 'successful', 'failed', 'dismissed')),
    address          TEXT    NOT NULL,           -- hash of all that decides the result
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
    updated          INTEGER NOT NULL
) STRICT;

INSERT INTO new_jobs (id, tenant, map, process, inputs, outputs, state, address, progress, stage, stages, message,
    attempt, claim, run_at, lease_until, cancel_requested, created, started, finished, updated)
SELECT id, 'local', map, 'semantic-map', json_object('options', json(options)),
    CASE WHEN analysis IS NOT NULL THEN json_object('analysis', analysis) END, state, address, progress, stage, stages,
    message, attempt, claim, run_at, lease_until, cancel_requested, created, started, finished, updated
FROM jobs;

DROP TABLE jobs;
ALTER TABLE new_jobs RENAME TO jobs;

CREATE INDEX jobs_waiting ON jobs (id) WHERE state = 'accepted';
CREATE INDEX jobs_running ON jobs (lease_until) WHERE state = 'running';
CREATE INDEX jobs_map ON jobs (map, id);
CREATE INDEX jobs_tenant ON jobs (tenant, id);

-- A repeated upload answers the job of the first one.
CREATE TABLE idempotency_keys (
    tenant  TEXT    NOT NULL,
    key     TEXT    NOT NULL,
    content TEXT    NOT NULL, -- hash of the request
    job     TEXT    NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
    created INTEGER NOT NULL,
    PRIMARY KEY (tenant, key)
) STRICT, WITHOUT ROWID;

INSERT INTO idempotency_keys (tenant, key, content, job, created)
SELECT 'local', key, content, job, created FROM carried_keys;

DROP TABLE carried_keys;

CREATE INDEX idempotency_keys_created ON idempotency_keys (created);
CREATE INDEX idempotency_keys_job ON idempotency_keys (job);

CREATE TABLE new_rule_sets (
    tenant  TEXT    NOT NULL,
    id      TEXT    NOT NULL,
    draft   TEXT    NOT NULL,
    version INTEGER NOT NULL,
    PRIMARY KEY (tenant, id)
) STRICT, WITHOUT ROWID;

INSERT INTO new_rule_sets (tenant, id, draft, version) SELECT 'local', id, draft, version FROM rule_sets;

DROP TABLE rule_sets;
ALTER TABLE new_rule_sets RENAME TO rule_sets;
