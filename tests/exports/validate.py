#!/usr/bin/env python3
"""Checks a folder of exports with the readers and schemas of other people, and fails loudly.

usage: validate.py FOLDER SCHEMAS
  FOLDER   the exports of one map, under the names of `exports::list()`; write one with
           STILLAGE_EXPORTS=FOLDER cargo test -p stillage --lib exports_for_the_validator
  SCHEMAS  the JSON schemas: lif-1.0.0, lif-official-1.0, lif-official-2.0-dev, vda5050-3.0.0, vda5050-main-0b2ae43
needs: pip install jsonschema vdma-lif networkx PyYAML openpyxl
"""

import csv
import hashlib
import io
import json
import math
import re
import sys
import zipfile
from pathlib import Path

import jsonschema
import networkx
import openpyxl
import yaml

PROBLEMS = []


def check(condition, message):
    if not condition:
        PROBLEMS.append(message)


def mended_schema(path):
    """A schema as JSON: the drafts have quotes in descriptions or lack the last one, and commas too many or too few."""
    lines = []
    for line in path.read_text(encoding="utf-8").splitlines():
        match = re.match(r'^(\s*"description"\s*:\s*)"(.*?)"?(\s*,?\s*)$', line)
        if match:
            text = json.dumps(match[2].replace('\\"', '"'))
            line = match[1] + text + match[3]
        lines.append(line)
    text = "\n".join(lines)
    text = re.sub(r",(\s*[}\]])", r"\1", text)
    text = re.sub(r'([}\]])(\s*\n\s*")', r"\1,\2", text)
    bare = re.sub(r'"(\\.|[^"\\])*"', "", text)
    return json.loads(text + "}" * (bare.count("{") - bare.count("}")))


def valid(document, schema, what):
    validator = jsonschema.validators.validator_for(schema, jsonschema.Draft7Validator)(schema)
    for error in list(validator.iter_errors(document))[:5]:
        check(False, f"{what}: {error.json_path}: {error.message[:200]}")


def lif(folder, schemas):
    for name, kinds in [
        ("lif.json", ["lif-1.0.0/lif-schema.json", "lif-official-1.0/LIF.schema.json"]),
        ("lif-2.0.json", ["lif-official-2.0-dev/LIF.schema.json"]),
    ]:
        document = json.loads((folder / name).read_text())
        for kind in kinds:
            valid(document, mended_schema(schemas / kind), f"{name} under {kind}")
        layout = document["layouts"][0]
        nodes = {node["nodeId"] for node in layout["nodes"]}
        check(len(nodes) == len(layout["nodes"]), f"{name}: node ids are not unique")
        edges = [edge["edgeId"] for edge in layout["edges"]]
        check(len(set(edges)) == len(edges), f"{name}: edge ids are not unique")
        for edge in layout["edges"]:
            check({edge["startNodeId"], edge["endNodeId"]} <= nodes, f"{name}: edge {edge['edgeId']} leads nowhere")
        for station in layout["stations"]:
            check(set(station["interactionNodeIds"]) <= nodes, f"{name}: {station['stationId']} has no node")
        check(layout["stations"], f"{name}: no stations")
    from vdma_lif.parser import LIFParser

    check(LIFParser.from_file(str(folder / "lif.json")) is not None, "lif.json: vdma-lif does not read it")


def crosses(first, second):
    """Whether two segments cross in a point inside both."""

    def side(a, b, c):
        return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])

    (a, b), (c, d) = first, second
    return side(a, b, c) * side(a, b, d) < -1e-9 and side(c, d, a) * side(c, d, b) < -1e-9


def zones(folder, schemas):
    document = json.loads((folder / "vda5050-zone-set.json").read_text())
    for kind in ["vda5050-3.0.0", "vda5050-main-0b2ae43"]:
        valid(document, mended_schema(schemas / kind / "zoneSet.schema"), f"vda5050-zone-set.json under {kind}")
    seen = set()
    for zone in document["zoneSet"]["zones"]:
        check(zone["zoneId"] not in seen, f"zone {zone['zoneId']} twice")
        seen.add(zone["zoneId"])
        ring = [(corner["x"], corner["y"]) for corner in zone["vertices"]]
        sides = list(zip(ring, ring[1:] + ring[:1]))
        twice_area = sum(a[0] * b[1] - a[1] * b[0] for a, b in sides)
        check(twice_area > 0, f"zone {zone['zoneId']} is not counter-clockwise")
        if len(sides) <= 200:
            pairs = ((one, two) for index, one in enumerate(sides) for two in sides[index + 1 :])
            check(not any(crosses(one, two) for one, two in pairs), f"zone {zone['zoneId']} crosses itself")
    action = json.loads((folder / "vda5050-download-map.json").read_text())
    valid(action, mended_schema(schemas / "vda5050-main-0b2ae43" / "instantActions.schema"), "vda5050-download-map.json")
    values = {each["key"]: each["value"] for each in action["actions"][0]["actionParameters"]}
    bundle = hashlib.sha256((folder / "bundle.zip").read_bytes()).hexdigest()
    check(values["mapHash"] == bundle, "vda5050-download-map.json: mapHash is not that of bundle.zip")


def route(folder, _schemas):
    """The rules of Nav2's loader: unsigned ids, no null, no list in metadata, no dangling edge."""
    text = (folder / "nav2-route.geojson").read_text()
    check("null" not in re.sub(r'"(\\.|[^"\\])*"', "", text), "nav2-route.geojson: null")
    features = json.loads(text)["features"]
    nodes = [each for each in features if each["geometry"]["type"] == "Point"]
    edges = [each for each in features if each["geometry"]["type"] == "MultiLineString"]
    check(nodes and edges, "nav2-route.geojson: no nodes or no edges")
    ids = [each["properties"]["id"] for each in features]
    check(len(set(ids)) == len(ids), "nav2-route.geojson: ids are not unique")
    known = {each["properties"]["id"] for each in nodes}
    for each in features:
        properties = each["properties"]
        check(isinstance(properties["id"], int) and properties["id"] >= 0, "nav2-route.geojson: id is no unsigned number")
        for key, value in properties["metadata"].items():
            check(isinstance(value, (str, float)), f"nav2-route.geojson: {key} is {value!r}: neither text nor 1.0")
    for each in edges:
        ends = {each["properties"]["startid"], each["properties"]["endid"]}
        check(ends <= known, f"nav2-route.geojson: edge {each['properties']['id']} leads nowhere")


def masks(folder, _schemas):
    for name, mode in [("nav2-keepout", "trinary"), ("nav2-speed", "scale")]:
        with zipfile.ZipFile(folder / f"{name}.zip") as archive:
            check(archive.testzip() is None, f"{name}.zip: broken")
            metadata = yaml.safe_load(archive.read(f"{name}.yaml"))
            check(metadata["mode"] == mode and len(metadata["origin"]) == 3, f"{name}.yaml: {metadata}")
            image = archive.read(metadata["image"])
            head = re.match(rb"P5\n(\d+) (\d+)\n255\n", image)
            check(head and len(image) == len(head[0]) + int(head[1]) * int(head[2]), f"{name}.pgm: wrong size")
    lines = (folder / "drivable.map").read_text().splitlines()
    sizes = [int(lines[1].removeprefix("height ")), int(lines[2].removeprefix("width "))]
    check(lines[0] == "type octile" and lines[3] == "map", "drivable.map: wrong head")
    check(len(lines) == 4 + sizes[0] and all(len(line) == sizes[1] for line in lines[4:]), "drivable.map: wrong size")


def rmf(folder, _schemas):
    """What `parse_graph.cpp` and the building generators ask for."""
    graph = yaml.safe_load((folder / "rmf-nav-graph.yaml").read_text())
    building = yaml.safe_load((folder / "rmf.building.yaml").read_text())
    for level in graph["levels"].values():
        names = [vertex[2]["name"] for vertex in level["vertices"] if "name" in vertex[2]]
        check(len(set(names)) == len(names), "rmf-nav-graph.yaml: names are not unique")
        count = len(level["vertices"])
        check(all(max(lane[:2]) < count for lane in level["lanes"]), "rmf-nav-graph.yaml: a lane leads nowhere")
        check(level["lanes"], "rmf-nav-graph.yaml: no lanes")
    check(building["coordinate_system"] == "cartesian_meters", "rmf.building.yaml: wrong system")
    for level in building["levels"].values():
        check(all(len(vertex) == 5 for vertex in level["vertices"]), "rmf.building.yaml: a vertex has no 5 members")
        for lane in level["lanes"]:
            check(max(lane[:2]) < len(level["vertices"]), "rmf.building.yaml: a lane leads nowhere")
            check(all(len(pair) == 2 for pair in lane[2].values()), "rmf.building.yaml: a parameter is no pair")
    check(graph["building_name"] == building["name"], "Open-RMF: two names")


def tables(folder, _schemas):
    rows = list(csv.reader(io.StringIO((folder / "locations.csv").read_text(encoding="utf-8"))))
    check(all(len(row) == len(rows[0]) for row in rows), "locations.csv: rows of several lengths")
    sheet = openpyxl.load_workbook(folder / "locations.xlsx").active
    cells = list(sheet.iter_rows(values_only=True))
    check([str(name) for name in cells[0]] == rows[0], "locations.xlsx: other columns than the CSV")
    check([row[0] for row in cells[1:]] == [row[0] for row in rows[1:]], "locations.xlsx: other codes than the CSV")
    check(all(cell.data_type != "f" for row in sheet.iter_rows() for cell in row), "locations.xlsx: a formula")
    graph = networkx.read_graphml(folder / "graph.graphml")
    layout = json.loads((folder / "lif.json").read_text())["layouts"][0]
    check(graph.is_directed(), "graph.graphml: not directed")
    check(graph.number_of_nodes() == len(layout["nodes"]), "graph.graphml: other nodes than LIF")
    check(graph.number_of_edges() == len(layout["edges"]), "graph.graphml: other edges than LIF")
    for node in layout["nodes"]:
        position, other = node["nodePosition"], graph.nodes[node["nodeId"]]
        apart = math.hypot(position["x"] - other["x"], position["y"] - other["y"])
        check(apart < 1e-9, f"graph.graphml: {node['nodeId']} lies elsewhere than in LIF")


def bundle(folder, _schemas):
    with zipfile.ZipFile(folder / "bundle.zip") as archive:
        check(archive.testzip() is None, "bundle.zip: broken")
        manifest = json.loads(archive.read("manifest.json"))
        listed = {entry["name"] for entry in manifest["files"]}
        check(listed | {"manifest.json", "SHA256SUMS"} == set(archive.namelist()), "bundle.zip: manifest is not whole")
        for entry in manifest["files"]:
            content = archive.read(entry["name"])
            check(hashlib.sha256(content).hexdigest() == entry["sha256"], f"bundle.zip: {entry['name']}: wrong sum")
            check(len(content) == entry["bytes"], f"bundle.zip: {entry['name']}: wrong size")
            single = folder / entry["name"]
            check(not single.exists() or single.read_bytes() == content, f"bundle.zip: {entry['name']} differs")


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    folder, schemas = Path(sys.argv[1]), Path(sys.argv[2])
    for step in [lif, zones, route, masks, rmf, tables, bundle]:
        before = len(PROBLEMS)
        try:
            step(folder, schemas)
        except Exception as error:  # A reader that fails is what this script is for.
            check(False, f"{step.__name__}: {type(error).__name__}: {error}")
        print(f"{step.__name__}: {'ok' if len(PROBLEMS) == before else 'FAILED'}")
    if PROBLEMS:
        sys.exit("\n".join(PROBLEMS[:50]))


if __name__ == "__main__":
    main()
