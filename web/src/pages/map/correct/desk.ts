/** The corrections of a map while they are worked on: what is drawn, the list, the chosen one, saving. */

import type Feature from "ol/Feature";
import type { Geometry } from "ol/geom";
import VectorImageLayer from "ol/layer/VectorImage";
import VectorSource from "ol/source/Vector";
import type Style from "ol/style/Style";

import { h, replace } from "../../../dom";
import type { Corrections } from "../../../corrections/corrections";
import { pointsOf, type Correction } from "../../../corrections/correction";
import { distance } from "../../../corrections/geometry";
import { lastAdded, withAdded, withChanged, withRemoved } from "../../../corrections/draft";
import { boxAround, type Point } from "../../../map/frame";
import { COLORS } from "../../../map/look";
import type { OpenTool, Workspace } from "../workspace";
import { correctBar } from "./correct_bar";
import { correctionForm } from "./correction_form";
import { correctionList } from "./correction_list";
import { importFile } from "./import_file";
import { MODES, type Mode, type Settings } from "./modes";
import { outcome } from "./outcome";
import { pen } from "./pen";
import { palette } from "./palette";
import { drawn, outline } from "./shapes";
import { snapping } from "./snapping";
import { vertexEditor } from "./vertices";

/** Metres around a correction that is flown to. */
const MARGIN = 3;
/** How near a click has to be to a correction, pixels. */
const NEAR = 6;
/** What a new row begins with: distance from place to place, metres. */
const PITCH_M = 1;

export function desk(workspace: Workspace, corrections: Corrections, angles: readonly number[]): OpenTool {
  const { canvas, labels, collections } = workspace;
  const source = new VectorSource();
  // Thousands of corrections are drawn once for a view, not again with every move of the pen.
  const layer = new VectorImageLayer({
    source,
    imageRatio: 1.5,
    zIndex: 85,
    style: (feature) => feature.get("look") as Style[],
  });
  canvas.map.addLayer(layer);
  const snap = snapping(workspace, angles, () => corrections.wanted);
  const storage = labels.ruleSet.labels.find(({ functionality }) => functionality?.includes("storage"));
  let settings: Settings = {
    label: storage?.id ?? labels.ruleSet.labels[0]?.id ?? "",
    pitchM: PITCH_M,
    layers: 1,
    isOpen: true,
    direction: snap.directions.find((angle) => angle < Math.PI / 2) ?? 0,
  };
  let chosen: string | undefined;
  const content = h("div", {});
  const drawing = pen(canvas, snap, {
    direction: () => settings.direction,
    done: add,
    changed: () => show(),
  });
  const vertices = vertexEditor(canvas, snap, (correction) => change(correction));
  const effect = outcome(workspace, corrections, () => show());
  const bar = correctBar(workspace, corrections, saved);
  const file = importFile(workspace, corrections, async () => {
    await corrections.reread();
    await saved();
  });

  /** Reads what follows from the corrections that are in force now. */
  async function saved(): Promise<void> {
    chosen = undefined;
    await Promise.all([labels.reread(), collections.refresh()]);
    show();
  }

  function add(mode: Mode, points: readonly Point[]): void {
    corrections.change(withAdded(corrections.draft, [mode.make(points, settings)]));
    drawing.take(undefined);
    choose(lastAdded(corrections.draft));
    if (mode.id === "name") document.getElementById("correction-name")?.focus();
  }

  function change(correction: Correction): void {
    if (chosen === undefined) return;
    remember(correction);
    corrections.change(withChanged(corrections.draft, chosen, correction));
  }

  /** What was chosen last is what the next one begins with. */
  function remember(correction: Correction): void {
    if ("label" in correction && correction.label !== undefined) settings = { ...settings, label: correction.label };
    if (correction.kind === "row")
      settings = { ...settings, layers: correction.layers, pitchM: correction.pitchM ?? settings.pitchM };
    if (correction.kind === "door") settings = { ...settings, isOpen: correction.isOpen };
  }

  function remove(key: string): void {
    if (key === chosen || key.startsWith("new ")) chosen = undefined;
    corrections.change(withRemoved(corrections.draft, key));
    show();
  }

  function choose(key: string | undefined, isFlown = false): void {
    chosen = key;
    const one = corrections.wanted.find((wanted) => wanted.key === key);
    if (one && isFlown) {
      const [left, low, right, high] = boxAround(pointsOf(one.correction));
      canvas.fit([left - MARGIN, low - MARGIN, right + MARGIN, high + MARGIN], 300);
    }
    show();
  }

  function draw(): void {
    source.clear();
    for (const { key, correction, isDrafted } of corrections.wanted) {
      const color = key === chosen ? COLORS.chosen : isDrafted ? COLORS.route : COLORS.door;
      source.addFeatures(drawn(correction, color, key === chosen));
    }
  }

  function show(): void {
    const focused = document.activeElement?.id;
    const isOpen = content.querySelector<HTMLDetailsElement>("details.points")?.open ?? false;
    const wanted = corrections.wanted;
    const one = wanted.find(({ key }) => key === chosen);
    if (!one) chosen = undefined;
    replace(
      content,
      palette({
        mode: drawing.mode(),
        snap,
        direction: settings.direction,
        begin,
        turn: (direction) => void (settings = { ...settings, direction }),
      }),
      one &&
        correctionForm(one.correction, {
          labels: labels.ruleSet.labels,
          directions: snap.directions,
          change,
          remove: () => remove(one.key),
        }),
      correctionList(wanted, {
        chosen,
        misfit: effect.misfit,
        labelName: (id) => labels.label(id)?.name ?? id,
        choose: (key) => choose(key, true),
        remove,
      }),
    );
    const points = content.querySelector<HTMLDetailsElement>("details.points");
    if (points) points.open = isOpen;
    if (!drawing.mode()) vertices.edit(one?.correction);
    else vertices.edit(undefined);
    draw();
    bar.update();
    if (focused) document.getElementById(focused)?.focus();
  }

  /** Begins to draw; the map has the focus, so that keys set points. */
  function begin(mode: Mode | undefined): void {
    chosen = undefined;
    drawing.take(mode);
    if (mode) canvas.target.focus({ preventScroll: true });
  }

  function key(event: KeyboardEvent): void {
    const isOnButton = event.target instanceof HTMLElement && event.target.matches("button, summary, a");
    if (event.key === "Enter" && isOnButton) return;
    if (drawing.key(event)) return;
    const mode = MODES.find((one) => one.key === event.key.toLowerCase());
    const one = corrections.wanted.find((wanted) => wanted.key === chosen);
    const label = labels.ruleSet.labels[Number(event.key) - 1];
    if (mode) begin(mode);
    else if (event.key === "Escape") choose(undefined);
    else if (event.key === "Delete" && chosen !== undefined) remove(chosen);
    else if (one && label && "label" in one.correction) change({ ...one.correction, label: label.id });
  }

  /** Undo and redo as everywhere; what is typed in a field is the field's own. */
  const shortcuts = (event: KeyboardEvent): void => {
    const isInField =
      event.target instanceof HTMLElement && event.target.matches("input[type=text], input[type=number]");
    if (isInField || !(event.ctrlKey || event.metaKey)) return;
    const name = event.key.toLowerCase();
    if (name !== "z" && name !== "y" && name !== "s") return;
    event.preventDefault();
    if (name === "s") {
      if (corrections.count > 0) bar.save();
    } else bar.step(name === "y" || event.shiftKey ? "redo" : "undo");
  };
  addEventListener("keydown", shortcuts);

  function click(point: Point, features: readonly Feature[]): void {
    if (drawing.mode()) return drawing.click(point);
    const near = corrections.wanted.findLast(({ correction }) => isNear(outline(correction), point));
    choose(near?.key);
    if (!near) workspace.choose(features);
  }

  function isNear(shape: Geometry, point: Point): boolean {
    if (shape.intersectsCoordinate([...point])) return true;
    const [x = 0, y = 0] = shape.getClosestPoint([...point]);
    return distance([x, y], point) <= NEAR * (canvas.map.getView().getResolution() ?? 1);
  }

  const stop = corrections.onChange(show);
  show();
  return {
    element: h("div", {}, content, file, h("div", { class: "bar" }, effect.element, bar.element)),
    click,
    key,
    close: () => {
      stop();
      removeEventListener("keydown", shortcuts);
      drawing.close();
      vertices.close();
      effect.close();
      canvas.map.removeLayer(layer);
    },
  };
}
