/** What the address of the page says after its `#`: a page, and what is open on it. */

export interface Address {
  /** Id of the map that is open; the list of maps where there is none. */
  readonly map: string | null;
  /** The tool that is open. */
  readonly tool: string;
  /** Everything else: where the map is looked at, which layers are shown. */
  readonly view: ReadonlyMap<string, string>;
}

/** Reads `#/maps/ID/TOOL?name=value`. */
export function read(hash: string): Address {
  const [path = "", query = ""] = hash.replace(/^#/, "").split("?");
  const [, maps, map, tool] = path.split("/");
  const isMap = maps === "maps" && map !== undefined && /^[0-9a-f-]{36}$/.test(map);
  return {
    map: isMap ? map : null,
    tool: isMap && tool ? tool : "look",
    view: new Map(new URLSearchParams(query)),
  };
}

/** A view in which one name has another value, or none. */
export function withValue(view: ReadonlyMap<string, string>, name: string, value?: string): Map<string, string> {
  const changed = new Map(view);
  if (value === undefined) changed.delete(name);
  else changed.set(name, value);
  return changed;
}

/** The address of a map with a tool. */
export function ofMap(map: string, tool = "look", view: ReadonlyMap<string, string> = new Map()): string {
  const query = new URLSearchParams([...view]).toString();
  return `#/maps/${map}/${tool}${query && `?${query}`}`;
}
