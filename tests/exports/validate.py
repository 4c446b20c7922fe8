#!/usr/bin/env python3
"""Checks a folder of exports with the readers and schemas of other people, and fails loudly.

usage: validate.py FOLDER SCHEMAS           checks the exports of one map
       validate.py --prove FOLDER SCHEMAS   breaks each of them and fails where nobody would notice

  FOLDER   written by `stillage export MAP --format all --out FOLDER --set link=https://maps.example/bundle.zip`
  SCHEMAS  lif-1.0.0, lif-official-1.0, lif-official-2.0-dev, vda5050-3.0.0 and vda5050-main-0b2ae43 as folders

needs: pip install -r requirements.txt, and `ogrinfo` of GDAL

The loaders of Nav2 and Open-RMF are no packages: their rules are checked as their sources state them
(geojson_graph_file_loader.cpp, map_io.cpp, vector_object_shapes.cpp; parse_graph.cpp, building_map/level.py).
"""

import csv
import hashlib
import io
import json
import math
import re
import subprocess
import sys
import zipfile
from pathlib import Path

import networkx
import openpyxl
import yaml
from vdma_lif.parser import LIFParser

import schemas

PROBLEMS = []


def check(condition, message):
    if not condition:
        PROBLEMS.append(message)
    return bool(condition)


def valid(document, path, what):
    schema, _ = schemas.read(path)
    for problem in schemas.problems(document, schema):
        check(False, f"{what} under {path.parent.name}: {problem}")


def strict_json(text):
    """JSON without NaN and infinities, which Python would take."""

    def refuse(word):
        raise ValueError(f"{word} is no JSON")

    return json.loads(text, parse_constant=refuse)


# Fleet managers


def lif(folder, kinds):
    for name, official in [
        ("lif.json", ["lif-1.0.0/lif-schema.json", "lif-official-1.0/LIF.schema.json"]),
        ("lif-2.0.json", ["lif-official-2.0-dev/LIF.schema.json"]),
    ]:
        document = strict_json((folder / name).read_text())
        for kind in official:
            valid(document, kinds / kind, name)
        check(re.fullmatch(MILLISECONDS, document["metaInformation"]["exportTimestamp"]), f"{name}: its time has no milliseconds")
        layout = document["layouts"][0]
        nodes = {node["nodeId"] for node in layout["nodes"]}
        check(len(nodes) == len(layout["nodes"]), f"{name}: node ids are not unique")
        unique([edge["edgeId"] for edge in layout["edges"]], f"{name}: edge ids")
        unique([station["stationId"] for station in layout["stations"]], f"{name}: station ids")
        for edge in layout["edges"]:
            check({edge["startNodeId"], edge["endNodeId"]} <= nodes, f"{name}: edge {edge['edgeId']} leads nowhere")
        for station in layout["stations"]:
            # The text forbids an empty list; the schema of VDMA does not.
            served = station["interactionNodeIds"]
            check(served and set(served) <= nodes, f"{name}: station {station['stationId']} has no node")
        check(layout["stations"] and layout["edges"], f"{name}: no stations or no edges")
    check(LIFParser.from_file(str(folder / "lif.json")).layouts, "lif.json: vdma-lif reads no layout")


MILLISECONDS = r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z"


def unique(values, what):
    check(len(set(values)) == len(values), f"{what} are not unique")


def crosses(first, second):
    """Whether two segments cross in a point inside both."""

    def side(a, b, c):
        return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])

    (a, b), (c, d) = first, second
    return side(a, b, c) * side(a, b, d) < -1e-9 and side(c, d, a) * side(c, d, b) < -1e-9


def zones(folder, kinds):
    name = "vda5050-zone-set.json"
    document = strict_json((folder / name).read_text())
    for kind in ["vda5050-3.0.0", "vda5050-main-0b2ae43"]:
        valid(document, kinds / kind / "zoneSet.schema", name)
    check(re.fullmatch(MILLISECONDS, document["timestamp"]), f"{name}: its time has no milliseconds")
    all_zones = document["zoneSet"]["zones"]
    unique([zone["zoneId"] for zone in all_zones], f"{name}: zone ids")
    check(all_zones, f"{name}: no zones")
    for zone in all_zones:
        simple_ring([(corner["x"], corner["y"]) for corner in zone["vertices"]], f"{name}: {zone['zoneId']}")
    name = "vda5050-download-map.json"
    action = strict_json((folder / name).read_text())
    for kind in ["vda5050-3.0.0", "vda5050-main-0b2ae43"]:
        valid(action, kinds / kind / "instantActions.schema", name)
    values = {each["key"]: each["value"] for each in action["actions"][0]["actionParameters"]}
    bundle_sum = hashlib.sha256((folder / "bundle.zip").read_bytes()).hexdigest()
    check(values["mapHash"] == bundle_sum, f"{name}: mapHash is not that of bundle.zip")
    check(values["mapDownloadLink"].startswith("http"), f"{name}: mapDownloadLink is no address")


def simple_ring(ring, what):
    sides = list(zip(ring, ring[1:] + ring[:1]))
    check(sum(a[0] * b[1] - a[1] * b[0] for a, b in sides) > 0, f"{what} is not counter-clockwise")
    if len(sides) <= 200:
        pairs = ((one, two) for index, one in enumerate(sides) for two in sides[index + 1 :])
        check(not any(crosses(one, two) for one, two in pairs), f"{what} crosses itself")


# Nav2


def route(folder, _kinds):
    name = "nav2-route.geojson"
    features = strict_json((folder / name).read_text())["features"]
    nodes = [each for each in features if each["geometry"]["type"] == "Point"]
    edges = [each for each in features if each["geometry"]["type"] in ("LineString", "MultiLineString")]
    check(nodes and edges, f"{name}: no nodes or no edges")
    unique([each["properties"]["id"] for each in features], f"{name}: ids")
    places = {each["properties"]["id"]: each["geometry"]["coordinates"] for each in nodes}
    for each in features:
        properties = each["properties"]
        number = properties["id"]
        check(type(number) is int and number >= 0, f"{name}: id {number!r} is no unsigned number")
        for key, value in properties.get("metadata", {}).items():
            # A whole number becomes another type than the scorers cast to; null and lists end the loading.
            check(isinstance(value, (str, float)), f"{name}: {key} of {number} is {value!r}, neither text nor 1.0")
    for each in edges:
        properties, geometry = each["properties"], each["geometry"]
        ends = [places.get(properties["startid"]), places.get(properties["endid"])]
        if check(None not in ends, f"{name}: edge {properties['id']} leads nowhere"):
            # Nav2 drives straight from node to node and reads no course: the course has to be that line.
            course = geometry["coordinates"][0] if geometry["type"] == "MultiLineString" else geometry["coordinates"]
            check(course == ends, f"{name}: edge {properties['id']} is not the straight line between its nodes")
            check(abs(properties["cost"] - math.dist(*ends)) < 1e-3, f"{name}: edge {properties['id']}: wrong cost")


class Mask:
    """A mask as map_io.cpp reads it: values from -1 to 100, the first row at the bottom."""

    def __init__(self, archive, name):
        self.metadata = yaml.safe_load(archive.read(f"{name}.yaml"))
        metadata, image = self.metadata, archive.read(self.metadata["image"])
        head = re.match(rb"P5\s+(\d+)\s+(\d+)\s+255\s", image)
        self.width, self.height = int(head[1]), int(head[2])
        pixels = image[head.end() :]
        check(len(pixels) == self.width * self.height, f"{name}.pgm: wrong size")
        for key in ["resolution", "free_thresh", "occupied_thresh"]:
            check(isinstance(metadata[key], float), f"{name}.yaml: {key} is {metadata[key]!r}, no number")
        check(all(isinstance(number, float) for number in metadata["origin"]), f"{name}.yaml: {metadata['origin']}")
        values = bytes.maketrans(bytes(range(256)), bytes(self.value(grey) & 255 for grey in range(256)))
        self.cells = pixels.translate(values)

    def value(self, grey):
        free, occupied = self.metadata["free_thresh"], self.metadata["occupied_thresh"]
        shade = grey / 255 if self.metadata["negate"] else (255 - grey) / 255
        if shade <= free:
            return 0
        if shade >= occupied:
            return 100
        return round(100 * (shade - free) / (occupied - free)) if self.metadata["mode"] == "scale" else -1

    def at(self, x, y):
        """Value at a point of the map frame; 255 is -1, None is outside."""
        left, bottom, yaw = self.metadata["origin"]
        x, y = x - left, y - bottom
        column = math.floor((x * math.cos(yaw) + y * math.sin(yaw)) / self.metadata["resolution"])
        row = math.floor((y * math.cos(yaw) - x * math.sin(yaw)) / self.metadata["resolution"])
        if 0 <= column < self.width and 0 <= row < self.height:
            return self.cells[(self.height - 1 - row) * self.width + column]
        return None


def masks(folder, _kinds):
    found = {}
    for name, mode, allowed in [("nav2-keepout", "trinary", {0, 100}), ("nav2-speed", "scale", set(range(101)))]:
        with zipfile.ZipFile(folder / f"{name}.zip") as archive:
            check(archive.testzip() is None, f"{name}.zip: broken")
            found[name] = mask = Mask(archive, name)
        check(mask.metadata["mode"] == mode, f"{name}.yaml: mode {mask.metadata['mode']}")
        check(set(mask.cells) <= allowed, f"{name}: values {set(mask.cells) - allowed}")
        check(0 in mask.cells, f"{name}: no free cell")
    keepout = found["nav2-keepout"]
    check(len(keepout.cells) == len(found["nav2-speed"].cells), "nav2 masks: two sizes")
    # No edge of the route graph leads through what the mask forbids.
    features = strict_json((folder / "nav2-route.geojson").read_text())["features"]
    step = keepout.metadata["resolution"] / 2
    for each in features:
        if each["geometry"]["type"] != "MultiLineString":
            continue
        (start, end), number = each["geometry"]["coordinates"][0], each["properties"]["id"]
        count = max(1, math.ceil(math.dist(start, end) / step))
        line = ([a + (b - a) * index / count for a, b in zip(start, end)] for index in range(count + 1))
        check(all(keepout.at(*point) == 0 for point in line), f"nav2-route.geojson: edge {number} leads through a forbidden cell")
    lines = (folder / "map.map").read_text().splitlines()
    head = ["type octile", f"height {keepout.height}", f"width {keepout.width}", "map"]
    check(lines[:4] == head, f"map.map: its head is {lines[:4]}")
    check([len(line) for line in lines[4:]] == [keepout.width] * keepout.height, "map.map: wrong size")
    check(set("".join(lines[4:])) <= set(".@"), "map.map: other characters than . and @")
    open_cells = sum(line.count(".") for line in lines[4:])
    check(0 < open_cells <= keepout.cells.count(0), f"map.map: {open_cells} open cells")


def vector_objects(folder, _kinds):
    name = "nav2-vector-objects.yaml"
    parameters = yaml.load((folder / name).read_text(), YAML_LOADER)["vector_object_server"]["ros__parameters"]
    check(parameters["shapes"], f"{name}: no shapes")
    unique(parameters["shapes"], f"{name}: shapes")
    for shape in parameters["shapes"]:
        polygon = parameters[shape]
        points = polygon["points"]
        check(polygon["type"] == "polygon" and polygon["closed"] is True and polygon["value"] == 100, f"{name}: {shape}")
        check(len(points) >= 6 and len(points) % 2 == 0, f"{name}: {shape} has {len(points)} numbers")
        # The parameter is an array of doubles: an integer in it has another type, and the server refuses the shape.
        check(all(type(number) is float for number in points), f"{name}: {shape} has a number without a point")
        simple_ring(list(zip(points[::2], points[1::2])), f"{name}: {shape}")


YAML_LOADER = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


# Open-RMF


def rmf(folder, _kinds):
    graph = yaml.load((folder / "rmf-nav-graph.yaml").read_text(), YAML_LOADER)
    building = yaml.load((folder / "rmf.building.yaml").read_text(), YAML_LOADER)
    check(graph["building_name"] == building["name"], "Open-RMF: two names")
    check(graph["doors"] == {} and graph["lifts"] == {}, "rmf-nav-graph.yaml: doors and lifts are no maps")
    for level in graph["levels"].values():
        vertices, lanes = level["vertices"], level["lanes"]
        unique([vertex[2]["name"] for vertex in vertices if "name" in vertex[2]], "rmf-nav-graph.yaml: names")
        for vertex in vertices:
            check(len(vertex) == 3 and all(type(number) is float for number in vertex[:2]), f"rmf-nav-graph.yaml: {vertex}")
        for lane in lanes:
            ends = lane[:2]
            check(len(lane) == 3 and all(type(end) is int and 0 <= end < len(vertices) for end in ends), f"rmf-nav-graph.yaml: lane {lane}")
        unique([tuple(lane[:2]) for lane in lanes], "rmf-nav-graph.yaml: lanes")
        check(lanes, "rmf-nav-graph.yaml: no lanes")
    check(building["coordinate_system"] == "cartesian_meters", "rmf.building.yaml: wrong system")
    for level, other in zip(building["levels"].values(), graph["levels"].values()):
        vertices = level["vertices"]
        check(all(len(vertex) == 5 and isinstance(vertex[3], str) for vertex in vertices), "rmf.building.yaml: a vertex has no 5 members")
        check([vertex[:2] for vertex in vertices] == [vertex[:2] for vertex in other["vertices"]], "Open-RMF: two graphs")
        directed = set()
        for lane in level["lanes"]:
            check(max(lane[:2]) < len(vertices), "rmf.building.yaml: a lane leads nowhere")
            kinds = {1: str, 2: int, 3: float, 4: bool}
            check(all(type(value) is kinds[kind] for kind, value in lane[2].values()), f"rmf.building.yaml: {lane[2]}")
            directed.add(tuple(lane[:2]))
            if lane[2]["bidirectional"][1]:
                directed.add((lane[1], lane[0]))
        check(directed == {tuple(lane[:2]) for lane in other["lanes"]}, "Open-RMF: other lanes in the building")


def same_graph(folder, _kinds):
    """LIF, Nav2 and Open-RMF tell the same straight edges."""
    layout = strict_json((folder / "lif.json").read_text())["layouts"][0]
    places = {node["nodeId"]: tuple(node["nodePosition"].values()) for node in layout["nodes"]}
    of_lif = {(places[edge["startNodeId"]], places[edge["endNodeId"]]) for edge in layout["edges"]}
    features = strict_json((folder / "nav2-route.geojson").read_text())["features"]
    lines = [each["geometry"]["coordinates"][0] for each in features if each["geometry"]["type"] == "MultiLineString"]
    of_nav2 = {tuple(tuple(point) for point in line) for line in lines}
    level = yaml.load((folder / "rmf-nav-graph.yaml").read_text(), YAML_LOADER)["levels"]["L1"]
    of_rmf = {tuple(tuple(level["vertices"][end][:2]) for end in lane[:2]) for lane in level["lanes"]}
    check(of_lif == of_nav2 == of_rmf, "LIF, Nav2 and Open-RMF tell different edges")


# Inventory systems, tools for graphs and maps


def tables(folder, _kinds):
    rows = list(csv.reader(io.StringIO((folder / "locations.csv").read_text(encoding="utf-8"), newline="")))
    check(len(rows) > 1 and all(len(row) == len(rows[0]) for row in rows), "locations.csv: no rows, or of several lengths")
    codes = [row[0] for row in rows[1:]]
    unique(codes, "locations.csv: codes")
    check(all(len(code) <= 18 for code in codes), "locations.csv: a code has more than 18 characters")
    check(not any(cell[:1] in "=+@\t\r" for row in rows for cell in row if cell), "locations.csv: a formula")
    sheet = openpyxl.load_workbook(folder / "locations.xlsx").active
    cells = list(sheet.iter_rows(values_only=True))
    check([str(name) for name in cells[0]] == rows[0], "locations.xlsx: other columns than the CSV")
    check([row[0] for row in cells[1:]] == codes, "locations.xlsx: other codes than the CSV")
    check(all(cell.data_type != "f" for row in sheet.iter_rows() for cell in row), "locations.xlsx: a formula")


def graphml(folder, _kinds):
    graph = networkx.read_graphml(folder / "graph.graphml")
    layout = strict_json((folder / "lif.json").read_text())["layouts"][0]
    places = {node["nodeId"]: node["nodePosition"] for node in layout["nodes"]}
    check(graph.is_directed() and graph.number_of_edges() > 0, "graph.graphml: not directed, or empty")
    check(set(graph.nodes) <= set(places), "graph.graphml: nodes that LIF does not have")
    for name, node in graph.nodes(data=True):
        place = places.get(name, {"x": math.inf, "y": math.inf})
        check(math.hypot(place["x"] - node["x"], place["y"] - node["y"]) < 1e-9, f"graph.graphml: {name} lies elsewhere than in LIF")
    # Lanes are as long as the straight edges that LIF makes of them.
    lengths = networkx.DiGraph()
    for edge in layout["edges"]:
        start, end = places[edge["startNodeId"]], places[edge["endNodeId"]]
        lengths.add_edge(edge["startNodeId"], edge["endNodeId"], length=math.hypot(end["x"] - start["x"], end["y"] - start["y"]))
    whole = [sum(data["length"] for _, _, data in each.edges(data=True)) for each in (graph, lengths)]
    check(abs(whole[0] - whole[1]) < 1e-3 * graph.number_of_edges(), f"graph.graphml: {whole[0]} m, LIF {whole[1]} m")


def flatgeobuf(folder, _kinds):
    def ogrinfo(*options):
        run = subprocess.run(["ogrinfo", "-ro", *options, folder / "faces.fgb"], capture_output=True, text=True)
        warnings = [line for line in run.stderr.splitlines() if "ERROR" in line or "Warning" in line]
        check(run.returncode == 0 and not warnings, f"faces.fgb: GDAL: {warnings or run.stderr[:300]}")
        return run.stdout

    summary, features = ogrinfo("-so", "-al"), ogrinfo("-q", "-al", "-geom=SUMMARY")
    found = re.search(r"Feature Count: (\d+)", summary)
    count = int(found[1]) if found else 0
    zoned = strict_json((folder / "vda5050-zone-set.json").read_text())["zoneSet"]["zones"]
    faces = {zone["zoneId"].split("-")[1] for zone in zoned}
    check(count == len(faces), f"faces.fgb: {count} faces, {len(faces)} in the zone set")
    check(features.count("OGRFeature(faces)") == count, "faces.fgb: GDAL does not read every face")
    check(features.count("MULTIPOLYGON") == count, "faces.fgb: a face has no shape")
    check('ID["EPSG",3857]' in summary, "faces.fgb: GDAL reads another system than EPSG:3857")
    for column in ["id: Integer64", "label: String", "areaM2: Real", "edges: String"]:
        check(column in summary, f"faces.fgb: GDAL reads no column {column}")
    numbers = {int(number) for number in re.findall(r"^  id \(Integer64\) = (\d+)$", features, re.M)}
    check(numbers == set(map(int, faces)), "faces.fgb: other faces than in the zone set")


def geopackage(folder, _kinds):
    run = subprocess.run(["ogrinfo", "-ro", "-so", "-al", folder / "map.gpkg"], capture_output=True, text=True)
    warnings = [line for line in run.stderr.splitlines() if "ERROR" in line or "Warning" in line]
    check(run.returncode == 0 and not warnings, f"map.gpkg: GDAL: {warnings or run.stderr[:300]}")
    layers = {part.split("\n", 1)[0]: part for part in run.stdout.split("\nLayer name: ")[1:]}
    check(len(layers) == 12, f"map.gpkg: {sorted(layers)}")
    zoned = strict_json((folder / "vda5050-zone-set.json").read_text())["zoneSet"]["zones"]
    faces = {zone["zoneId"].split("-")[1] for zone in zoned}
    locations = list(csv.DictReader((folder / "locations.csv").read_text().splitlines()))
    expected = {
        "faces": (len(faces), ["id: Integer64", "label: String", "areaM2: Real", "edges: String"]),
        "locations": (len(locations), ["code: String", "widthM: Real", "stale: Integer(Boolean)"]),
    }
    for name, (count, columns) in expected.items():
        layer = layers.get(name, "")
        check(f"\nFeature Count: {count}\n" in layer, f"map.gpkg: other than {count} {name}")
        check('ID["EPSG",3857]' in layer, f"map.gpkg: GDAL reads another system than EPSG:3857 for {name}")
        for column in columns:
            check(column in layer, f"map.gpkg: GDAL reads no column {column} of {name}")


def bundle(folder, _kinds):
    with zipfile.ZipFile(folder / "bundle.zip") as archive:
        check(archive.testzip() is None, "bundle.zip: broken")
        manifest = strict_json(archive.read("manifest.json"))
        listed = {entry["name"] for entry in manifest["files"]}
        check(listed | {"manifest.json", "SHA256SUMS"} == set(archive.namelist()), "bundle.zip: the manifest is not whole")
        check(manifest["leftOut"] == [], f"bundle.zip: left out {manifest['leftOut']}")
        for entry in manifest["files"]:
            content = archive.read(entry["name"])
            check(hashlib.sha256(content).hexdigest() == entry["sha256"], f"bundle.zip: {entry['name']}: wrong sum")
            check(len(content) == entry["bytes"], f"bundle.zip: {entry['name']}: wrong size")
            single = folder / entry["name"]
            check(not single.exists() or single.read_bytes() == content, f"bundle.zip: {entry['name']} differs")
        sums = archive.read("SHA256SUMS").decode().splitlines()
        check({line.split("  ")[1] for line in sums} == listed, "bundle.zip: SHA256SUMS is not whole")


STEPS = [lif, zones, route, masks, vector_objects, rmf, same_graph, tables, graphml, flatgeobuf, geopackage, bundle]


def problems_of(step, folder, kinds):
    """What one step finds."""
    PROBLEMS.clear()
    try:
        step(folder, kinds)
    except Exception as error:  # A reader that fails is what this script is for.
        check(False, f"{step.__name__}: {type(error).__name__}: {error}")
    return list(PROBLEMS)


def main():
    if len(sys.argv) == 4 and sys.argv[1] == "--prove":
        import broken

        broken.prove(Path(sys.argv[2]), Path(sys.argv[3]))
        return
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    folder, kinds = Path(sys.argv[1]), Path(sys.argv[2])
    for fault in schemas.read(kinds / "lif-official-2.0-dev/LIF.schema.json")[1]:
        print(f"mended in the schema of LIF 2.0: {fault}")
    found = []
    for step in STEPS:
        problems = problems_of(step, folder, kinds)
        print(f"{step.__name__}: {'FAILED' if problems else 'ok'}")
        found += problems
    if found:
        sys.exit("\n".join(found[:50]))


if __name__ == "__main__":
    main()
