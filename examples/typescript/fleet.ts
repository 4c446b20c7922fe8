// A fleet manager: the way of a vehicle to a storage location, and the graph that it loads.
//
//     node build/fleet.js http://127.0.0.1:8080/v1/maps/MAP X,Y CODE [FILE]
//
// X,Y is where the vehicle stands, in metres of the map; CODE is a storage location. FILE receives the Layout Interchange
// Format: lif.json when absent.

import { writeFile } from "node:fs/promises";
import { ask, read } from "./ask.js";

interface Route {
  properties: {
    lengthM: number;
    timeS: number;
    clearanceM: number;
    instructions: { text: string; pose: { x: number; y: number } }[];
  };
}

interface LayoutFile {
  layouts: [{ nodes: unknown[]; edges: unknown[]; stations: unknown[] }];
}

const [mapUrl, start, code, file = "lif.json"] = process.argv.slice(2);

// A vehicle of 0.9 m in width. A map without a georeference has its own metres as EPSG:3857.
const footprintRadiusM = "0.45";
const question = new URLSearchParams({ from: start!, to: `location:${code}`, crs: "EPSG:3857", footprintRadiusM });
const { properties: way } = await read<Route>(`${mapUrl}/routes?${question}`);
console.log(`${way.lengthM.toFixed(1)} m in ${way.timeS.toFixed()} s, ${way.clearanceM} m from the nearest obstacle`);
for (const { text, pose } of way.instructions) {
  console.log(`  (${pose.x.toFixed(2)}, ${pose.y.toFixed(2)})  ${text}`);
}

const text = await (await ask(`${mapUrl}/exports/lif.json?footprintRadiusM=${footprintRadiusM}`)).text();
await writeFile(file, text);
const [{ nodes, edges, stations }] = (JSON.parse(text) as LayoutFile).layouts;
console.log(`${file}: ${nodes.length} nodes, ${edges.length} edges, ${stations.length} stations`);
