-- What SQLite has at version 9 (migrations/sqlite says what the columns hold), in the types of PostgreSQL. Times are
-- microseconds since 1970-01-01 UTC, ids UUID version 7 in lower-case text, and columns with structured content hold JSON as
-- text, so that both databases answer the same bytes. Names that are sorted are sorted by their bytes.

CREATE TABLE maps (
    id             TEXT COLLATE "C" NOT NULL PRIMARY KEY,
    name           TEXT             NOT NULL,
    created        BIGINT           NOT NULL,
    updated        BIGINT           NOT NULL,
    width          BIGINT           NOT NULL,
    height         BIGINT           NOT NULL,
    resolution     DOUBLE PRECISION NOT NULL,
    georeference   TEXT,
    warnings       TEXT             NOT NULL,
    source         TEXT             NOT NULL,
    analysis       TEXT COLLATE "C",
    analysis_asked TEXT COLLATE "C",
    version        BIGINT           NOT NULL,
    tenant         TEXT             NOT NULL DEFAULT 'local',
    site           TEXT COLLATE "C" NOT NULL DEFAULT '',
    alignment      TEXT,
    decided_before TEXT COLLATE "C",
    hidden         BIGINT,
    hidden_from    TEXT
);

CREATE INDEX maps_source ON maps (source);
CREATE INDEX maps_tenant ON maps (tenant, id);
CREATE INDEX maps_site ON maps (site, id);
CREATE INDEX maps_hidden ON maps (hidden) WHERE hidden IS NOT NULL;

CREATE TABLE analyses (
    id          TEXT COLLATE "C" NOT NULL PRIMARY KEY,
    map         TEXT COLLATE "C" NOT NULL REFERENCES maps (id) ON DELETE CASCADE,
    job         TEXT COLLATE "C" NOT NULL UNIQUE,
    created     BIGINT           NOT NULL,
    options     TEXT             NOT NULL,
    algorithm   BIGINT           NOT NULL,
    address     TEXT             NOT NULL,
    blob        TEXT             NOT NULL,
    stages      TEXT             NOT NULL,
    diagnostics TEXT             NOT NULL,
    UNIQUE (map, address)
);

CREATE INDEX analyses_blob ON analyses (blob);

ALTER TABLE maps
    ADD FOREIGN KEY (analysis) REFERENCES analyses (id) DEFERRABLE INITIALLY DEFERRED,
    ADD FOREIGN KEY (decided_before) REFERENCES analyses (id) DEFERRABLE INITIALLY DEFERRED;

-- Deleting an analysis looks for maps that name it.
CREATE INDEX maps_analysis ON maps (analysis);
CREATE INDEX maps_decided_before ON maps (decided_before);

CREATE TABLE jobs (
    id               TEXT COLLATE "C" NOT NULL PRIMARY KEY,
    tenant           TEXT             NOT NULL,
    map              TEXT COLLATE "C" NOT NULL REFERENCES maps (id) ON DELETE CASCADE,
    process          TEXT             NOT NULL,
    inputs           TEXT             NOT NULL,
    outputs          TEXT,
    state            TEXT             NOT NULL
        CHECK (state IN ('accepted', 'running', 'successful', 'failed', 'dismissed')),
    address          TEXT             NOT NULL,
    progress         BIGINT           NOT NULL DEFAULT 0,
    stage            TEXT,
    stages           TEXT             NOT NULL DEFAULT '[]',
    message          TEXT             NOT NULL DEFAULT '',
    attempt          BIGINT           NOT NULL DEFAULT 0,
    claim            BIGINT           NOT NULL DEFAULT 0,
    run_at           BIGINT           NOT NULL DEFAULT 0,
    lease_until      BIGINT,
    cancel_requested BOOLEAN          NOT NULL DEFAULT FALSE,
    created          BIGINT           NOT NULL,
    started          BIGINT,
    finished         BIGINT,
    updated          BIGINT           NOT NULL,
    activates        BOOLEAN          NOT NULL DEFAULT TRUE
);

CREATE INDEX jobs_waiting ON jobs (id) WHERE state = 'accepted';
CREATE INDEX jobs_running ON jobs (lease_until) WHERE state = 'running';
CREATE INDEX jobs_map ON jobs (map, id);
CREATE INDEX jobs_tenant ON jobs (tenant, id);

-- Processes that wait for jobs, or follow one, are told. Equal words of one transaction are told once.
CREATE FUNCTION tell_of_job() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
    PERFORM pg_notify('stillage_jobs', '');
    RETURN NULL;
END
$$;

CREATE TRIGGER tell_of_job AFTER INSERT OR UPDATE ON jobs FOR EACH ROW EXECUTE FUNCTION tell_of_job();

CREATE TABLE idempotency_keys (
    tenant  TEXT             NOT NULL,
    key     TEXT             NOT NULL,
    content TEXT             NOT NULL,
    job     TEXT COLLATE "C" NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
    created BIGINT           NOT NULL,
    PRIMARY KEY (tenant, key)
);

CREATE INDEX idempotency_keys_created ON idempotency_keys (created);
CREATE INDEX idempotency_keys_job ON idempotency_keys (job);

CREATE TABLE rule_sets (
    tenant  TEXT             NOT NULL,
    id      TEXT COLLATE "C" NOT NULL,
    draft   TEXT             NOT NULL,
    version BIGINT           NOT NULL,
    PRIMARY KEY (tenant, id)
);

CREATE TABLE registries (
    site    TEXT COLLATE "C" NOT NULL PRIMARY KEY,
    places  TEXT             NOT NULL,
    version BIGINT           NOT NULL
);

CREATE TABLE semantics_versions (
    map              TEXT COLLATE "C" NOT NULL REFERENCES maps (id) ON DELETE CASCADE,
    version          BIGINT           NOT NULL,
    analysis         TEXT COLLATE "C" NOT NULL REFERENCES analyses (id) ON DELETE CASCADE,
    rule_set         TEXT             NOT NULL,
    draft            TEXT             NOT NULL,
    assignment       TEXT             NOT NULL,
    layout           TEXT             NOT NULL DEFAULT '{}',
    origin           TEXT             NOT NULL CHECK (origin IN ('suggested', 'assigned', 'carried')),
    carried          TEXT,
    created          BIGINT           NOT NULL,
    corrections      BIGINT,
    correction_count BIGINT           NOT NULL DEFAULT 0,
    restores         BIGINT,
    PRIMARY KEY (map, version),
    CHECK ((origin = 'carried') = (carried IS NOT NULL))
);

CREATE INDEX semantics_versions_analysis ON semantics_versions (analysis, version);

CREATE TABLE correction_lists (
    map         TEXT COLLATE "C" NOT NULL REFERENCES maps (id) ON DELETE CASCADE,
    number      BIGINT           NOT NULL,
    corrections TEXT             NOT NULL,
    newest      BIGINT           NOT NULL,
    PRIMARY KEY (map, number)
);
