-- What is known of a job whose process died: a job that kills its process dies in the same stage each time, one that dies with
-- its machine does not.

ALTER TABLE jobs ADD COLUMN cut_off_in TEXT;                      -- stage of the last death; '' before the first stage
ALTER TABLE jobs ADD COLUMN cut_offs   BIGINT NOT NULL DEFAULT 0;  -- deaths in all

-- Jobs that were cut off wait behind those that were not.
DROP INDEX jobs_waiting;
CREATE INDEX jobs_waiting ON jobs (attempt, id) WHERE state = 'accepted';
