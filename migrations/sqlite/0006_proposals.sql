-- A job says whether the analysis that it makes comes into force at once. Those of earlier releases all did.

ALTER TABLE jobs ADD COLUMN activates INTEGER NOT NULL DEFAULT 1;
