/** The form for a route and its answer, on the map and in words. */

import Feature from "ol/Feature";
import { Point as PointGeometry } from "ol/geom";
import VectorSource from "ol/source/Vector";
import type Style from "ol/style/Style";

import { button, choice, field, h, replace } from "../../../dom";
import { number, t } from "../../../language";
import type { Point } from "../../../map/frame";
import { geometryOf, rowOf, type GeoJsonFeature } from "../../../map/geojson";
import { COLORS, dot, label, line } from "../../../map/look";
import { clear, problemBox, show } from "../../../parts/problem";
import { get, Refused } from "../../../service/request";
import type { Route } from "../../../service/types";
import type { Workspace } from "../workspace";
import { endAt, pointOf, routeQuery } from "./route_request";

/** Radii of the slider, metres, and the one that it begins with. */
const RADII = { min: 0, max: 1.5, step: 0.05, value: 0.4 };
/** Milliseconds after the last move of the slider until a route is asked for. */
const PATIENCE_MS = 150;

export interface RouteForm {
  readonly element: HTMLElement;
  click(point: Point, features: readonly Feature[]): void;
  close(): void;
}

export function routeForm(workspace: Workspace): RouteForm {
  const { map, canvas, coordinates } = workspace;
  const source = new VectorSource();
  const layer = canvas.overlay(source, 70, { style: (feature) => feature.get("look") as Style | Style[] });
  const problems = problemBox();
  const answer = h("div", { "aria-live": "polite" });
  const ask = (): void => void request();
  const from = h("input", { type: "text", autocomplete: "off", onchange: ask });
  const to = h("input", { type: "text", autocomplete: "off", onchange: ask });
  const told = h("output", {});
  let timer = 0;
  const radius = h("input", {
    type: "range",
    ...RADII,
    oninput: () => {
      tellRadius();
      clearTimeout(timer);
      timer = setTimeout(ask, PATIENCE_MS);
    },
  });
  let profile = "shortest";
  const profiles = choice(
    [
      ["shortest", t("shortest")],
      ["clearance", t("clearance")],
    ],
    profile,
    (value) => {
      profile = value;
      ask();
    },
  );
  let latest: AbortController | undefined;

  function tellRadius(): void {
    replace(told, t("radius", { metres: number(radius.valueAsNumber, 2) }));
  }

  function draw(geometry: GeoJsonFeature["geometry"], look: Style | Style[]): void {
    const drawn = geometryOf(geometry, coordinates.toMap);
    if (drawn) add(new Feature(drawn), look);
  }

  function mark(point: Point, look: Style | Style[]): void {
    add(new Feature(new PointGeometry([...point])), look);
  }

  function add(feature: Feature, look: Style | Style[]): void {
    feature.set("look", look);
    source.addFeature(feature);
  }

  function drawEnds(): void {
    source.clear();
    for (const [end, name] of [
      [from.value, t("from")],
      [to.value, t("to")],
    ] as const) {
      const point = pointOf(end);
      if (point) mark(point, [dot(COLORS.route, 6), label(name)]);
    }
  }

  async function request(): Promise<void> {
    latest?.abort();
    clear(problems);
    replace(answer);
    drawEnds();
    if (from.value === "" || to.value === "") return;
    latest = new AbortController();
    const query = routeQuery(from.value, to.value, radius.valueAsNumber, profile, coordinates);
    try {
      showRoute(await get<Route>(`v1/maps/${map.id}/routes?${query}`, latest.signal));
    } catch (error) {
      if (error instanceof DOMException) return;
      show(problems, error);
      const position = error instanceof Refused ? error.problem.position : undefined;
      const [x, y] = position ?? [];
      if (x !== undefined && y !== undefined)
        mark(coordinates.toMap([x, y]), [dot(COLORS.chosen, 8), label(t("here"))]);
    }
  }

  function showRoute(route: Route): void {
    const { lengthM, timeS, clearanceM, instructions } = route.properties;
    // The document leaves the shape of geometries to GeoJSON.
    const path = route.geometry as unknown as { type: "LineString"; coordinates: Point[] };
    source.clear();
    draw({ ...path, coordinates: path.coordinates as never }, [line("#ffffff", 7), line(COLORS.route, 4)]);
    const [first, last] = [path.coordinates[0], path.coordinates.at(-1)];
    if (first) mark(coordinates.toMap(first), [dot(COLORS.route, 6), label(t("from"))]);
    if (last) mark(coordinates.toMap(last), [dot(COLORS.route, 6), label(t("to"))]);
    replace(
      answer,
      h(
        "p",
        {},
        h(
          "strong",
          {},
          t("routeFigures", { length: number(lengthM, 1), time: number(timeS, 0), clearance: number(clearanceM, 2) }),
        ),
      ),
      h(
        "ol",
        { class: "steps" },
        ...instructions.map(({ text, pose }) =>
          h(
            "li",
            {},
            button(text, () => showPose(pose)),
          ),
        ),
      ),
    );
  }

  function showPose(pose: unknown): void {
    const { x, y } = pose as { x: number; y: number };
    canvas.map.getView().animate({ center: [x, y], duration: 250 });
  }

  function swap(): void {
    [from.value, to.value] = [to.value, from.value];
    ask();
  }

  function startAgain(): void {
    [from.value, to.value] = ["", ""];
    ask();
  }

  tellRadius();
  const element = h(
    "section",
    { "aria-label": t("routes") },
    h("p", {}, h("small", {}, t("routesMeaning"))),
    field(t("from"), from),
    field(t("to"), to),
    field(t("footprint"), radius),
    told,
    field(t("best"), profiles),
    h("div", { class: "line" }, button(t("swap"), swap), button(t("startAgain"), startAgain)),
    problems,
    answer,
  );
  return {
    element,
    click: (point, features) => {
      const location = features.find((feature) => String(feature.getId()).startsWith("locations/"));
      const end = location ? `location:${String(rowOf(location)["code"])}` : endAt(point);
      // A third click begins a new route.
      if (from.value === "" || to.value !== "") [from.value, to.value] = [end, ""];
      else to.value = end;
      ask();
    },
    close: () => {
      latest?.abort();
      canvas.remove(layer);
    },
  };
}
