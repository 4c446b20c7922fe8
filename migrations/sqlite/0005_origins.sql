-- A version of the labels says whether a person decided, or went back to the suggestion.

ALTER TABLE semantics_versions ADD COLUMN origin TEXT NOT NULL DEFAULT 'assigned'
    CHECK (origin IN ('suggested', 'assigned'));
