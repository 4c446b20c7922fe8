/** The functions of the page that touch no document. */

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after, before, test } from "node:test";

import { createServer } from "vite";

let vite;
const load = (path) => vite.ssrLoadModule(`/src/${path}`);

before(async () => {
  vite = await createServer({
    server: { middlewareMode: true, ws: false, watch: null },
    appType: "custom",
    logLevel: "error",
  });
});
after(() => vite.close());

test("an address names a map, a tool and a view", async () => {
  const { read, ofMap } = await load("address.ts");
  const id = "01a22711-7884-74c4-958b-49286e02bea9";
  const address = ofMap(
    id,
    "routes",
    new Map([
      ["x", "1.50"],
      ["layers", "faces,edges"],
    ]),
  );
  assert.deepEqual(read(address), {
    map: id,
    tool: "routes",
    view: new Map([
      ["x", "1.50"],
      ["layers", "faces,edges"],
    ]),
  });
  assert.equal(read("#/").map, null);
  assert.equal(read("#/maps/../x").map, null);
});

test("pixels of a turned grid lie in the map frame", async () => {
  const { ofPixel, boxOf, lengthOf } = await load("map/frame.ts");
  const grid = { frame: { resolutionM: 0.5, originM: [10, 20], yawRad: Math.PI / 2 }, width: 4, height: 2 };
  const near = (point, wanted) =>
    point.forEach((value, axis) => assert.ok(Math.abs(value - wanted[axis]) < 1e-9, `${point}`));
  near(ofPixel(grid, [0, 2]), [10, 20]);
  near(ofPixel(grid, [4, 2]), [10, 22]);
  near(boxOf(grid), [9, 20, 10, 22]);
  assert.equal(
    lengthOf([
      [0, 0],
      [3, 4],
      [3, 5],
    ]),
    6,
  );
});

test("coordinates of a georeferenced map lead there and back", async () => {
  const { coordinatesOf } = await load("map/coordinates.ts");
  const coordinates = coordinatesOf({ status: "surveyed", lon: 12.8572, lat: 56.6745, heading: 30 });
  assert.equal(coordinates.crs, "CRS84");
  const [x, y] = coordinates.toMap(coordinates.ofMap([120.5, -40.25]));
  assert.ok(Math.hypot(x - 120.5, y + 40.25) < 1e-6);
  // 100 m along the y axis of a map that looks north are 100 m of the meridian.
  const [lon, lat] = coordinatesOf({ status: "surveyed", lon: 12.8572, lat: 56.6745, heading: 0 }).ofMap([0, 100]);
  assert.ok(Math.abs(lon - 12.8572) < 1e-12 && Math.abs(lat - 56.6745 - 100 / 111_350) < 1e-7);
  assert.deepEqual(coordinatesOf({ status: "nominal" }).ofMap([1, 2]), [1, 2]);
});

test("a draft lies over the labels in force", async () => {
  const { labelUnder, patchOf, emptyDraft } = await load("labels/draft.ts");
  const inForce = { ruleSet: "site", assignment: { 3: "co" }, overrides: [{ face: 7, label: "ju" }] };
  const draft = { ...emptyDraft(1), assignment: { 3: "pc" } };
  const label = (draft, id, read) => labelUnder(draft, inForce, { id, category: 3 }, read);
  assert.equal(label(draft, 8, "co"), "pc");
  assert.equal(label(draft, 7, "ju"), "ju", "its own label is stronger than that of its category");
  assert.equal(label({ ...draft, overrides: { 7: null } }, 7, "ju"), "pc");
  assert.equal(label({ ...emptyDraft(1), overrides: { 7: null } }, 7, "ju"), "co");
  assert.equal(label({ ...draft, overrides: { 8: "ro" } }, 8, "co"), "ro");
  assert.deepEqual(patchOf(draft), { assignment: { 3: "pc" } });
});

test("labels of single faces follow their ground when faces are numbered anew", async () => {
  const { emptyDraft, renumbered } = await load("labels/draft.ts");
  const draft = { ...emptyDraft(1), overrides: { 7: "ro", 8: null }, places: { 7: [1, 1], 8: [5, 5] } };
  assert.equal(
    renumbered(draft, ([x]) => (x === 1 ? 7 : 8)),
    draft,
  );
  const now = renumbered(draft, ([x]) => (x === 1 ? 9 : undefined));
  assert.deepEqual([now.overrides, now.places], [{ 9: "ro" }, { 9: [1, 1] }]);
});

test("a rule set that is not stored is previewed whole and saved by its id", async () => {
  const { emptyDraft, patchOf, previewOf } = await load("labels/draft.ts");
  const document = { id: "hall", labels: [] };
  const draft = (isStored) => ({ ...emptyDraft(1), rules: { document, isStored } });
  assert.deepEqual(previewOf(draft(false)), { ruleSet: document });
  assert.deepEqual(previewOf(draft(true)), { ruleSet: "hall" });
  assert.deepEqual(patchOf(draft(false)), { ruleSet: "hall" });
});

test("only counts that change are told", async () => {
  const { effectRows } = await load("pages/map/decide/effect_rows.ts");
  const [same, less] = [
    { before: 3, after: 3 },
    { before: 3, after: 2 },
  ];
  const labels = [{ label: "pc", faces: less, locations: same, connectedLinks: same }];
  const rows = effectRows({ labels, edges: { cogent: same, invalid: less }, links: { connected: same } });
  assert.deepEqual(rows, [
    { what: "effectFaces", label: "pc", ...less },
    { what: "effectInvalid", ...less },
  ]);
});

test("what somebody else changed is told", async () => {
  const { differences } = await load("labels/draft.ts");
  const before = { ruleSet: "site", assignment: { 0: "co" }, overrides: [{ face: 1, label: "ju" }] };
  const after = { ruleSet: "hall", assignment: { 0: "pc" }, overrides: [] };
  assert.deepEqual(differences(before, after), [
    { what: "ruleSet", key: "", before: "site", after: "hall" },
    { what: "category", key: "0", before: "co", after: "pc" },
    { what: "face", key: "1", before: "ju", after: "" },
  ]);
});

test("a rule for two labels is stronger than what follows from them", async () => {
  const { cogencyOf, withCogency } = await load("labels/rule_set_draft.ts");
  const derived = {
    labels: [{ id: "a" }, { id: "b" }],
    cogency: [
      ["invalid", "cogent"],
      ["cogent", "invalid"],
    ],
  };
  const draft = { id: "x", labels: [], cogency: [{ when: ["*", "b"], then: "storage-access" }] };
  assert.equal(cogencyOf({ ...draft, cogency: [] }, derived, "a", "b"), "cogent");
  assert.equal(cogencyOf(draft, derived, "b", "a"), "storage-access");
  const ruled = withCogency(draft, "b", "a", "invalid");
  assert.equal(cogencyOf(ruled, derived, "a", "b"), "invalid");
  assert.deepEqual(withCogency(ruled, "a", "b", undefined), draft);
});

test("files are told apart by their names", async () => {
  const { classify } = await load("pages/maps/uploaded_files.ts");
  const file = (name) => new File(["x"], name);
  assert.equal(classify([file("map.PGM"), file("map.yaml")]).kind, "picture");
  assert.equal(classify([file("map.png")]), "missingMetadata");
  assert.equal(classify([file("a.png"), file("b.png")]), "tooManyFiles");
  assert.equal(classify([file("grid.json")]).kind, "message");
  assert.equal(classify([file("notes.txt")]), "missingAll");
});

test("codes that begin as typed come before those that contain it", async () => {
  const { matches } = await load("pages/map/look/matches.ts");
  const all = ["11-010", "01-010", "01-002", "01"].map((name) => ({ names: [name] }));
  assert.deepEqual(
    matches(all, "01", 9).map(({ names }) => names[0]),
    ["01", "01-002", "01-010", "11-010"],
  );
  assert.deepEqual(matches(all, " ", 9), []);
});

test("a route is asked for in the coordinates of the service", async () => {
  const { routeQuery } = await load("pages/map/routes/route_request.ts");
  const { coordinatesOf } = await load("map/coordinates.ts");
  const query = new URLSearchParams(
    routeQuery("1.5, -2", "03-012", 0.4, "shortest", coordinatesOf({ status: "nominal" })),
  );
  assert.deepEqual([query.get("from"), query.get("to"), query.get("crs")], ["1.5,-2", "location:03-012", "EPSG:3857"]);
});

test("lanes are drawn once, and a dead end is the way back to where lanes meet", async () => {
  const { lanesOf, stretch } = await load("pages/map/routes/lanes.ts");
  const edge = (startNodeId, endNodeId) => ({ startNodeId, endNodeId });
  const nodes = ["A", "B", "C", "D"].map((nodeId, x) => ({ nodeId, nodePosition: { x, y: 0 } }));
  const edges = [edge("A", "B"), edge("B", "A"), edge("B", "C"), edge("D", "B")];
  const lanes = lanesOf({ layouts: [{ nodes, edges }] });
  assert.equal(lanes.pairs.length, 3);
  assert.deepEqual(lanes.nodes.get("C"), [2, 0]);
  const names = (pairs) => pairs.map((pair) => [...pair].sort().join("")).sort();
  assert.deepEqual(names(stretch(lanes, "A", "C")), ["AB", "BC"]);
  assert.deepEqual(names(stretch(lanes, "A", null)), ["AB", "BC", "BD"]);
});

test("a point that was moved is moved back", async () => {
  const { moved, movedBack } = await load("map/motion.ts");
  const motion = { shiftM: [3, -1], turnDeg: 90 };
  const near = (left, right) => assert.ok(Math.hypot(left[0] - right[0], left[1] - right[1]) < 1e-9, `${left}`);
  near(moved(motion, [1, 0]), [3, 0]);
  near(movedBack(motion, moved(motion, [5, 7])), [5, 7]);
});

test("locations are sorted as people count", async () => {
  const { shownRows } = await load("pages/map/hand_over/table_rows.ts");
  const rows = ["2-10", "2-9", "1-1"].map((code) => ({ code, occupancy: code === "1-1" ? "empty" : "occupied" }));
  const codes = (text, isDescending) => shownRows(rows, text, { column: "code", isDescending }).map(({ code }) => code);
  assert.deepEqual(codes("", false), ["1-1", "2-9", "2-10"]);
  assert.deepEqual(codes("occup", true), ["2-10", "2-9"]);
});

test("whole options are said by what differs from the defaults, and said again they are the same", async () => {
  const { optionDocument, saidOptions } = await load("service/options.ts");
  const fields = [
    { path: ["seed"], standard: "0" },
    { path: ["categorization", "k"], standard: "auto" },
    { path: ["categorization", "maxRangeM"], standard: "" },
    { path: ["annotation", "relaxation", "iterations"], standard: "5" },
  ];
  const said = (options) => optionDocument(saidOptions(fields, options));
  assert.equal(
    said({ seed: 0, categorization: { k: "auto", maxRangeM: null }, annotation: { relaxation: null } }),
    undefined,
  );
  const own = { seed: 7, categorization: { k: 3 }, annotation: { relaxation: { iterations: 5 } } };
  assert.deepEqual(said(own), own, "a group that may be absent is there by its members");
  assert.equal(said(undefined), undefined);
});

test("every text is there in both languages, with the same values to fill in", async () => {
  const { TABLES, texts } = await load("texts/texts.ts");
  const names = TABLES.flatMap((table) => Object.keys(table));
  assert.deepEqual(names.sort(), Object.keys(texts).sort(), "no table is missing or replaces a text of another one");
  const values = (text) => [...text.matchAll(/\{\w+\}/g)].map(String).sort();
  for (const [name, [english, german]] of Object.entries(texts)) {
    assert.ok(english.length > 0 && german.length > 0, name);
    assert.deepEqual(values(english), values(german), name);
  }
});

test("every option has its name and its meaning in both languages, the English one as the document has it", async () => {
  const { optionFields } = await load("service/options.ts");
  const { optionGroups, optionTexts } = await load("texts/options.ts");
  const { components } = JSON.parse(await readFile(new URL("../../openapi/openapi.json", import.meta.url), "utf8"));
  const fields = optionFields(components.schemas);
  assert.deepEqual(
    fields.map(({ path, meaning }) => [path.join("/"), meaning.replaceAll("\n", " ")]),
    Object.entries(optionTexts).map(([path, { meaning }]) => [path, meaning[0].replaceAll("\n", " ")]),
  );
  assert.deepEqual(
    [...new Set(fields.map(({ path }) => path.slice(0, -1).join(" ")))].sort(),
    Object.keys(optionGroups).sort(),
  );
});

test("options come from the document with their meaning and their range", async () => {
  const { optionFields, optionDocument } = await load("service/options.ts");
  const schemas = {
    AnalysisOptions: {
      properties: {
        seed: { type: "integer", description: "Seed.", default: 1, minimum: 0 },
        grid: { $ref: "#/x/GridOptions" },
      },
    },
    GridOptions: { properties: { mode: { $ref: "#/x/Mode", description: "The `mode`.", default: "a" } } },
    Mode: { type: "string", enum: ["a", "b"] },
  };
  const [seed, mode] = optionFields(schemas);
  assert.deepEqual([seed.kind, seed.standard, seed.minimum], ["number", "1", 0]);
  assert.deepEqual(
    [mode.kind, mode.path, mode.meaning, mode.values],
    ["choice", ["grid", "mode"], "The mode.", ["a", "b"]],
  );
  assert.deepEqual(
    optionDocument(
      new Map([
        ["seed", 7],
        ["grid/mode", "b"],
      ]),
    ),
    { seed: 7, grid: { mode: "b" } },
  );
});

test("only so many jobs are followed that a browser has connections left", async () => {
  const { watchedJobs } = await load("service/jobs.ts");
  const job = (jobID, status) => ({ jobID, status, created: `2026-01-01T00:00:0${jobID}Z` });
  const jobs = [
    job("5", "accepted"),
    job("4", "accepted"),
    job("3", "accepted"),
    job("2", "running"),
    job("1", "successful"),
  ];
  assert.deepEqual([...watchedJobs(jobs)], ["2", "3", "4"]);
});

const near = (points, wanted) =>
  points.forEach((point, index) =>
    point.forEach((value, axis) => assert.ok(Math.abs(value - wanted[index][axis]) < 1e-9, JSON.stringify(points))),
  );

test("a rectangle lies along a direction, and a corner of it is moved against the opposite one", async () => {
  const { alongLongSide, rectangleOf, turned, withCorner } = await load("corrections/geometry.ts");
  const rectangle = rectangleOf([1, 1], [4, 2], 0);
  near(rectangle, [
    [1, 1],
    [4, 1],
    [4, 2],
    [1, 2],
  ]);
  near(alongLongSide(turned(rectangle)), [
    [4, 2],
    [1, 2],
    [1, 1],
    [4, 1],
  ]);
  near(withCorner(rectangle, 2, [6, 3]), [
    [1, 1],
    [6, 1],
    [6, 3],
    [1, 3],
  ]);
  near(withCorner(rectangle, 1, [6, 0]), [
    [1, 0],
    [6, 0],
    [6, 2],
    [1, 2],
  ]);
  const diagonal = rectangleOf([0, 0], [0, 2], Math.PI / 4);
  near(diagonal, [
    [0, 0],
    [1, 1],
    [0, 2],
    [-1, 1],
  ]);
});

test("a row is cut into as many places as are asked for, or as its pitch allows", async () => {
  const { placeCount, rectangleOf, rowPlaces } = await load("corrections/geometry.ts");
  const rectangle = rectangleOf([0, 0], [10, 2], 0);
  assert.equal(placeCount({ rectangle, places: 7 }), 7);
  assert.equal(placeCount({ rectangle, pitchM: 1.2 }), 8);
  const places = rowPlaces(rectangle, 5, 2);
  assert.equal(places.length, 10);
  near(places[6], [
    [2, 1],
    [4, 1],
    [4, 2],
    [2, 2],
  ]);
});

test("a point is drawn to a corner, else to where a direction meets an edge, else to an edge, else along a direction", async () => {
  const { snapped } = await load("corrections/snap.ts");
  const targets = {
    corners: [[5, 5]],
    edges: [
      [
        [0, 3],
        [10, 3],
      ],
    ],
    directions: [0, Math.PI / 2],
  };
  assert.deepEqual(snapped([5.1, 4.9], undefined, targets, 0.2), { point: [5, 5], to: "corner" });
  const meeting = snapped([2.05, 2.9], [2, 0], targets, 0.2);
  near([meeting.point], [[2, 3]]);
  assert.deepEqual(snapped([7, 2.9], undefined, targets, 0.2), { point: [7, 3], to: "edge" });
  const along = snapped([8, 0.1], [2, 0], targets, 0.2);
  assert.equal(along.to, "direction");
  near([along.point], [[8, 0]]);
  assert.deepEqual(snapped([8, 1.5], [2, 0], targets, 0.2), { point: [8, 1.5], to: undefined });
  assert.deepEqual(
    snapped([5.1, 5.1], [5, 5], targets, 0.2),
    { point: [5.1, 5.1], to: undefined },
    "two corners stay two",
  );
});

test("a crooked shape is aligned: its sides follow the directions, its size stays", async () => {
  const { aligned, crossesItself } = await load("corrections/geometry.ts");
  const crooked = [
    [0, 0],
    [4, 0.2],
    [4.2, 2.2],
    [0.2, 2],
  ];
  near(aligned(crooked, true, [0, Math.PI / 2]), [
    [0.1, 0.1],
    [4.1, 0.1],
    [4.1, 2.1],
    [0.1, 2.1],
  ]);
  near(
    aligned(
      [
        [0, 0],
        [4, 0.2],
      ],
      false,
      [0],
    ),
    [
      [0, 0.1],
      [4, 0.1],
    ],
  );
  assert.equal(crossesItself(crooked), false);
  assert.equal(crossesItself([crooked[0], crooked[2], crooked[1], crooked[3]]), true);
});

test("a draft of corrections lies over the list, and over a later one nothing of it is lost", async () => {
  const drafts = await load("corrections/draft.ts");
  const listed = [
    { id: "c1", kind: "label", at: [1, 1], label: "pc", isApplied: true, faces: [3] },
    { id: "c2", kind: "erase", ring: [], isApplied: false, reason: "outside" },
  ];
  let draft = drafts.withAdded(drafts.emptyDraft(4), [{ kind: "merge", at: [] }]);
  draft = drafts.withChanged(draft, "c1", { kind: "label", at: [1, 1], label: "co" });
  draft = drafts.withRemoved(draft, "c2");
  assert.equal(drafts.changeCount(draft), 3);
  assert.deepEqual(drafts.bodyOf(drafts.wantedList(listed, draft)), [
    { id: "c1", kind: "label", at: [1, 1], label: "co" },
    { kind: "merge", at: [] },
  ]);
  const later = drafts.rebased(draft, [], 5);
  assert.deepEqual(later, {
    version: 5,
    added: [
      { kind: "label", at: [1, 1], label: "co" },
      { kind: "merge", at: [] },
    ],
    changed: {},
    removed: [],
  });
  const theirs = drafts.theirChanges(listed, [
    { ...listed[0], label: "ju" },
    { id: "c3", kind: "split", line: [] },
  ]);
  assert.deepEqual(
    theirs.map(({ what, correction }) => [what, correction.kind]),
    [
      ["changed", "label"],
      ["added", "split"],
      ["removed", "erase"],
    ],
  );
});

test("two analyses differ in the options that are told", async () => {
  const { differentOptions } = await load("pages/map/analyses/different_options.ts");
  const [before, now] = [
    { seed: 1, grid: { mode: "a" }, range: null },
    { seed: 1, grid: { mode: "b" }, range: [1, 2] },
  ];
  assert.deepEqual(differentOptions(before, now), [
    { path: "grid/mode", before: "a", now: "b" },
    { path: "range", before: "–", now: "[1,2]" },
  ]);
});
