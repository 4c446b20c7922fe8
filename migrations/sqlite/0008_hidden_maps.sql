-- A map that was deleted is kept for a while, so that it can be restored. Until then it and its jobs belong to nobody, which
-- is the tenant without a name, so that nothing that is asked under a tenant finds them.

ALTER TABLE maps ADD COLUMN hidden INTEGER; -- when it was deleted

ALTER TABLE maps ADD COLUMN hidden_from TEXT; -- the tenant it comes back to

CREATE INDEX maps_hidden ON maps (hidden) WHERE hidden IS NOT NULL;
