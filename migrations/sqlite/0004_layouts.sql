-- A decision says how the locations of its map are cut and numbered, too: JSON, positions in the frame of the site.

ALTER TABLE semantics_versions ADD COLUMN layout TEXT NOT NULL DEFAULT '{}';
