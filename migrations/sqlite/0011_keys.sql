-- API keys, the turns of tenants, what tenants take on the disk, and the log of changes.

CREATE TABLE api_keys (
    id      TEXT    NOT NULL PRIMARY KEY, -- the public part of the key
    tenant  TEXT    NOT NULL,
    name    TEXT    NOT NULL,             -- for people
    scopes  TEXT    NOT NULL,             -- words with blanks between them
    hash    TEXT    NOT NULL,             -- keyed blake3 of the whole key
    created INTEGER NOT NULL,
    expires INTEGER,
    revoked INTEGER
) STRICT, WITHOUT ROWID;

-- Of the tenants with jobs that wait, the one with the lowest turn is served next. A claim gives it the time for its turn.
CREATE TABLE tenant_turns (
    tenant TEXT    NOT NULL PRIMARY KEY,
    turn   INTEGER NOT NULL
) STRICT, WITHOUT ROWID;

CREATE INDEX jobs_running_of ON jobs (tenant) WHERE state = 'running';

-- Length of the upload and of the result as they are stored; 0 where an earlier release stored them.
ALTER TABLE maps ADD COLUMN bytes INTEGER NOT NULL DEFAULT 0;
ALTER TABLE analyses ADD COLUMN bytes INTEGER NOT NULL DEFAULT 0;

CREATE TABLE audit_log (
    id        TEXT    NOT NULL PRIMARY KEY, -- of version 7: sorts by time
    tenant    TEXT    NOT NULL,
    time      INTEGER NOT NULL,
    caller    TEXT    NOT NULL,             -- who: the id of a key, the subject of a token, or the command line
    operation TEXT    NOT NULL,             -- operationId of the API
    resource  TEXT    NOT NULL,             -- path of what was asked for, or of what was made
    status    INTEGER NOT NULL,             -- HTTP status of the answer
    request   TEXT    NOT NULL              -- id of the request
) STRICT, WITHOUT ROWID;

CREATE INDEX audit_log_tenant ON audit_log (tenant, id);
CREATE INDEX audit_log_time ON audit_log (time);
