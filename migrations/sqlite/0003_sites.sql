-- Every map belongs to a site, named by the id of the site's first map. A later map of a site knows how it lies on an
-- earlier one. A site has one registry: the codes and names of its places, which outlive every map and analysis.

ALTER TABLE maps ADD COLUMN site TEXT NOT NULL DEFAULT '';

UPDATE maps SET site = id;

ALTER TABLE maps ADD COLUMN alignment TEXT; -- JSON, of maps that were uploaded with an earlier one

CREATE INDEX maps_site ON maps (site, id);

CREATE TABLE registries (
    site    TEXT    NOT NULL PRIMARY KEY,
    places  TEXT    NOT NULL, -- JSON
    version INTEGER NOT NULL  -- raised with every change
) STRICT, WITHOUT ROWID;
