/** The lanes of the navigation graph: what is known of them, and the stretches that the report speaks of. */

import type { Point } from "../../../map/frame";

/** Nodes by their names, and which of them lanes join: each lane once. */
export interface Lanes {
  readonly nodes: ReadonlyMap<string, Point>;
  readonly pairs: readonly (readonly [string, string])[];
}

/** What is read of a layout in the Layout Interchange Format. */
export interface Layouts {
  readonly layouts: readonly {
    readonly nodes: readonly {
      readonly nodeId: string;
      readonly nodePosition: { readonly x: number; readonly y: number };
    }[];
    readonly edges: readonly { readonly startNodeId: string; readonly endNodeId: string }[];
  }[];
}

export function lanesOf({ layouts }: Layouts): Lanes {
  const nodes = new Map<string, Point>();
  const pairs = new Map<string, readonly [string, string]>();
  for (const layout of layouts) {
    for (const { nodeId, nodePosition } of layout.nodes) nodes.set(nodeId, [nodePosition.x, nodePosition.y]);
    for (const { startNodeId, endNodeId } of layout.edges) {
      const pair = startNodeId < endNodeId ? ([startNodeId, endNodeId] as const) : ([endNodeId, startNodeId] as const);
      pairs.set(pair.join("\n"), pair);
    }
  }
  return { nodes, pairs: [...pairs.values()] };
}

/** The lanes from a node to another one, by the fewest lanes; those of all that it reaches where there is no other. */
export function stretch({ pairs }: Lanes, from: string, to: string | null): (readonly [string, string])[] {
  const neighbours = new Map<string, string[]>();
  for (const [left, right] of pairs) {
    neighbours.set(left, [...(neighbours.get(left) ?? []), right]);
    neighbours.set(right, [...(neighbours.get(right) ?? []), left]);
  }
  const before = new Map<string, string>();
  const found = [from];
  const seen = new Set(found);
  for (const node of found) {
    if (node === to) break;
    for (const next of neighbours.get(node) ?? []) {
      if (seen.has(next)) continue;
      seen.add(next);
      before.set(next, node);
      found.push(next);
    }
  }
  if (to === null) return pairs.filter(([left, right]) => seen.has(left) && seen.has(right));
  const way: [string, string][] = [];
  for (let node = to; before.has(node); node = before.get(node) ?? from) way.push([before.get(node) ?? from, node]);
  return way;
}
